// SPDX-License-Identifier: MIT
// Converts a host's textures to the attachments that effects read: top row first, linear view depth
// in metres, world normals.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "core/gpu/host_device.h"
#include "grisaille/effect.h"
#include "host/camera.h"

namespace grisaille::host {

constexpr size_t kMostInputs = 16;  // of an effect

// The host's textures; all but depth may be null.
struct Textures {
  // By grisaille_attachment; GRISAILLE_DEPTH is depth of any kind.
  std::array<gpu::Texture, GRISAILLE_ATTACHMENT_COUNT> attachments;
  std::array<gpu::Texture, kMostInputs> named;  // by index in the effect's table of inputs
  size_t namedCount = 0;                        // inputs of that table
};

// The pipelines that convert them, one set per device; each is created on first use.
class Kernels {
 public:
  explicit Kernels(gpu::HostDevice& device) : device_(device) {}
  ~Kernels();
  Kernels(const Kernels&) = delete;
  Kernels& operator=(const Kernels&) = delete;

  enum Kernel : uint8_t { kDepth, kClipDepth, kNormal, kFacetNormal, kMotion, kKernels };
  gpu::ComputePipeline get(Kernel kernel);
  // `format`: of the texture that the pipeline writes.
  gpu::ComputePipeline turn(gpu::Format format);
  gpu::Sampler nearest();

 private:
  gpu::HostDevice& device_;
  std::array<gpu::ComputePipeline, kKernels> kernels_;
  std::array<gpu::ComputePipeline, 16> turns_;  // by format
  gpu::Sampler nearest_;
};

class Attachments {
 public:
  Attachments(gpu::HostDevice& device, Kernels& kernels) : device_(device), kernels_(kernels) {}
  ~Attachments() { drop(); }
  Attachments(const Attachments&) = delete;
  Attachments& operator=(const Attachments&) = delete;

  // Sets the size and destroys the attachments of the old size.
  void resize(uint32_t width, uint32_t height);

  // The format of an attachment.
  static gpu::Format formatOf(grisaille_attachment attachment);

  // Creates the pipelines that fill the attachments of `reads` from the textures of `given`; both
  // are combinations of GRISAILLE_READS. `named`: whether the effect reads inputs by name.
  static void prepare(Kernels& kernels, uint32_t reads, uint32_t given, bool named);

  // Creates the missing attachments of `reads`, a combination of GRISAILLE_READS, and destroys the
  // others. Throws kOutOfDeviceMemory.
  void prepare(uint32_t reads, const Textures& textures);

  // Fills the prepared attachments. Call it outside a pass.
  void record(gpu::Commands& commands, const SourceBlock& source, const MotionBlock& motion,
              const Textures& textures);

  // Copies a picture, and flips its rows if `source` says that the host's rows begin at the bottom.
  // `format` is the format of `to`. Call it outside a pass.
  void copy(gpu::Commands& commands, gpu::BufferRange source, gpu::Texture from, gpu::Texture to,
            gpu::Format format, std::string_view label);

  // Null for an attachment that was not prepared.
  gpu::Texture get(grisaille_attachment attachment) const { return targets_[attachment]; }
  // One per input of the effect's table; null: missing.
  std::span<const gpu::Texture> named() const { return std::span(named_).first(namedCount_); }

 private:
  void drop();
  void fit(gpu::Texture& target, bool wanted, const char* label, gpu::Format format);
  void dispatch(gpu::Commands& commands, std::string_view label, gpu::ComputePipeline pipeline,
                gpu::BufferRange source, std::array<gpu::Texture, 2> from, gpu::Texture to,
                gpu::BufferRange second = {});
  void recordNormals(gpu::Commands& commands, gpu::BufferRange source, gpu::Texture normals);

  gpu::HostDevice& device_;
  Kernels& kernels_;
  uint32_t width_ = 0, height_ = 0;
  std::array<gpu::Texture, GRISAILLE_ATTACHMENT_COUNT> targets_;
  std::array<gpu::Texture, kMostInputs> named_;
  size_t namedCount_ = 0;
};

}  // namespace grisaille::host
