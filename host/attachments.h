// SPDX-License-Identifier: MIT
// Converts a host's textures to the attachments that effects read: top row first, linear view depth
// in metres, world normals.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "core/gpu/device.h"
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
  explicit Kernels(gpu::Maker& device) : device_(device) {}
  ~Kernels();
  Kernels(const Kernels&) = delete;
  Kernels& operator=(const Kernels&) = delete;

  enum Kernel : uint8_t { kDepth, kClipDepth, kNormal, kFacetNormal, kMotion, kKernels };
  gpu::ComputePipeline get(Kernel kernel);
  // Copies a texture of the host's to one of the library, or the other way. `format`: of the
  // texture that the pipeline writes.
  enum Way : uint8_t { kIn, kOut, kWays };
  gpu::ComputePipeline turn(gpu::Format format, Way way);
  gpu::Sampler nearest();

 private:
  gpu::Maker& device_;
  std::array<gpu::ComputePipeline, kKernels> kernels_;
  std::array<std::array<gpu::ComputePipeline, kWays>, 16> turns_;  // by format
  gpu::Sampler nearest_;
};

class Attachments {
 public:
  // Both must outlive this.
  Attachments(gpu::Maker& device, Kernels& kernels) : device_(device), kernels_(kernels) {}
  ~Attachments() { drop(); }
  Attachments(const Attachments&) = delete;
  Attachments& operator=(const Attachments&) = delete;

  // Sets the size. If it changes, destroys the attachments of the old size.
  void resize(uint32_t width, uint32_t height);

  // The format of an attachment.
  static gpu::Format formatOf(grisaille_attachment attachment);

  // Creates the pipelines that fill the attachments of `reads` from the textures of `given`; both
  // are combinations of GRISAILLE_READS. `named`: whether the effect reads inputs by name.
  static void prepare(Kernels& kernels, uint32_t reads, uint32_t given, bool named);

  // Creates the missing attachments of `reads`, a combination of GRISAILLE_READS, and destroys the
  // others. Throws kOutOfDeviceMemory.
  void prepare(uint32_t reads, const Textures& textures);

  // Fills the prepared attachments from this layer of the textures. Call it outside a pass.
  void record(gpu::Commands& commands, const SourceBlock& source, const MotionBlock& motion,
              const Textures& textures, uint32_t layer);

  // Copies a picture to the place that `source` describes in a layer of a texture for the host.
  // `format`: of both. Call it outside a pass.
  void copyOut(gpu::Commands& commands, gpu::BufferRange source, gpu::Texture from, gpu::Texture to,
               uint32_t layer, gpu::Format format);

  // Destroys the attachments, so that recordings begin with new ones.
  void drop();

  // Null for an attachment that was not prepared.
  gpu::Texture get(grisaille_attachment attachment) const { return targets_[attachment]; }
  // One per input of the effect's table; null: missing.
  std::span<const gpu::Texture> named() const { return std::span(named_).first(namedCount_); }

 private:
  // A layer of a texture; no texture: none.
  struct Layer {
    gpu::Texture texture = {};
    uint32_t layer = 0;
  };
  void fit(gpu::Texture& target, bool wanted, const char* label, gpu::Format format);
  void dispatch(gpu::Commands& commands, std::string_view label, gpu::ComputePipeline pipeline,
                gpu::BufferRange source, std::array<Layer, 2> from, Layer to,
                gpu::BufferRange second = {});
  void recordNormals(gpu::Commands& commands, gpu::BufferRange source, Layer normals);

  gpu::Maker& device_;
  Kernels& kernels_;
  uint32_t width_ = 0, height_ = 0;
  std::array<gpu::Texture, GRISAILLE_ATTACHMENT_COUNT> targets_;
  std::array<gpu::Texture, kMostInputs> named_;
  size_t namedCount_ = 0;
};

}  // namespace grisaille::host
