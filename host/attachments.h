// SPDX-License-Identifier: MIT
// Converts a host's textures to the attachments that effects read: top row first, linear view depth
// in metres, world normals.
#pragma once

#include <array>
#include <string_view>

#include "core/gpu/host_device.h"
#include "grisaille/effect.h"
#include "host/camera.h"

namespace grisaille::host {

// The host's textures; all but depth may be null.
struct Textures {
  gpu::Texture depth, normal, backDepth, nextDepth, baseColour, thickness;
};

// The pipelines that convert them, one set per device; each is created on first use.
class Kernels {
 public:
  explicit Kernels(gpu::HostDevice& device) : device_(device) {}
  ~Kernels();
  Kernels(const Kernels&) = delete;
  Kernels& operator=(const Kernels&) = delete;

  enum Kernel : uint8_t { kDepth, kClipDepth, kNormal, kFacetNormal, kKernels };
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

  // Creates the pipelines that fill the attachments of `reads`. `normals`, `thickness`: whether the
  // host gives these textures.
  static void prepare(Kernels& kernels, uint32_t reads, bool normals, bool thickness);

  // Creates the missing attachments of `reads`, a combination of GRISAILLE_READS, and destroys the
  // others. Throws kOutOfDeviceMemory.
  void prepare(uint32_t reads, const Textures& textures);

  // Fills the prepared attachments. Call it outside a pass.
  void record(gpu::Commands& commands, const SourceBlock& source, const Textures& textures);

  // Copies a picture, and flips its rows if `source` says that the host's rows begin at the bottom.
  // `format` is the format of `to`. Call it outside a pass.
  void copy(gpu::Commands& commands, gpu::BufferRange source, gpu::Texture from, gpu::Texture to,
            gpu::Format format, std::string_view label);

  // Null for an attachment that was not prepared.
  gpu::Texture get(grisaille_attachment attachment) const { return targets_[attachment]; }

 private:
  void drop();
  void dispatch(gpu::Commands& commands, std::string_view label, gpu::ComputePipeline pipeline,
                gpu::BufferRange source, std::array<gpu::Texture, 2> from, gpu::Texture to);

  gpu::HostDevice& device_;
  Kernels& kernels_;
  uint32_t width_ = 0, height_ = 0;
  std::array<gpu::Texture, GRISAILLE_ATTACHMENT_COUNT> targets_;
};

}  // namespace grisaille::host
