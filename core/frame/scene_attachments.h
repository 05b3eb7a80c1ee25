// SPDX-License-Identifier: MIT
// Attachments drawn from a scene.
#pragma once

#include "core/frame/attachments.h"
#include "core/frame/scene_resources.h"

namespace grisaille::frame {

class SceneAttachments : public AttachmentSource {
 public:
  // Device and scene outlive this; the scene stays unchanged.
  SceneAttachments(gpu::Device& device, const scene::Scene& scene)
      : device_(device), scene_(device, scene) {}
  ~SceneAttachments() override;

  bool goesBeyond() const override { return true; }
  void record(gpu::Commands& commands, const scene::Camera& camera, uint32_t width, uint32_t height,
              gpu::BufferRange viewBlock, const AttachmentTargets& targets,
              std::string_view passes) override;

 private:
  gpu::Device& device_;
  SceneResources scene_;
  gpu::ComputePipeline viewDepth_;
  gpu::Sampler nearest_;
};

}  // namespace grisaille::frame
