// SPDX-License-Identifier: MIT
// A host's textures as the attachments that effects read: rows from the top, linear view depth in
// metres, world normals.
#pragma once

#include <array>
#include <string_view>

#include "core/gpu/host_device.h"
#include "grisaille/effect.h"
#include "host/camera.h"

namespace grisaille::host {

// The host's; all but depth may be null.
struct Textures {
  gpu::Texture depth, normal, backDepth, baseColour;
};

// The shaders that read them, one set a device; made when first used.
class Kernels {
 public:
  explicit Kernels(gpu::HostDevice& device) : device_(device) {}
  ~Kernels();
  Kernels(const Kernels&) = delete;
  Kernels& operator=(const Kernels&) = delete;

  enum Kernel : uint8_t { kDepth, kClipDepth, kNormal, kFacetNormal, kKernels };
  gpu::ComputePipeline get(Kernel kernel);
  // Of the picture that is written.
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

  // Of another size from now on; those that there are go.
  void resize(uint32_t width, uint32_t height);

  // Makes those of `reads`, of GRISAILLE_READS, that there are not yet. Throws kOutOfDeviceMemory.
  void prepare(uint32_t reads, bool normalsGiven);

  // Fills those that were prepared. Not inside a pass.
  void record(gpu::Commands& commands, const SourceBlock& source, const Textures& textures);

  // Copies a picture, turning its rows over where the source says that the host's are the other way
  // round. `to` is of this format. Not inside a pass.
  void copy(gpu::Commands& commands, gpu::BufferRange source, gpu::Texture from, gpu::Texture to,
            gpu::Format format, std::string_view label);

  // Null for what was not prepared.
  gpu::Texture get(grisaille_attachment attachment) const { return targets_[attachment]; }

 private:
  void drop();
  void dispatch(gpu::Commands& commands, std::string_view label, gpu::ComputePipeline pipeline,
                gpu::BufferRange source, std::array<gpu::Texture, 2> from, gpu::Texture to);
  gpu::Texture exactDepth(gpu::Commands& commands, SourceBlock source, gpu::Texture depth);

  gpu::HostDevice& device_;
  Kernels& kernels_;
  uint32_t width_ = 0, height_ = 0;
  std::array<gpu::Texture, GRISAILLE_ATTACHMENT_COUNT> targets_;
};

}  // namespace grisaille::host
