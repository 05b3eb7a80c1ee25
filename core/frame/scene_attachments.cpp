// SPDX-License-Identifier: MIT
#include "core/frame/scene_attachments.h"

#include <array>
#include <string>

#include "shaders/view_depth.h"

namespace grisaille::frame {

SceneAttachments::~SceneAttachments() {
  device_.destroy(viewDepth_);
  device_.destroy(nearest_);
}

void SceneAttachments::record(gpu::Commands& commands, const scene::Camera& camera, uint32_t width,
                              uint32_t height, gpu::BufferRange viewBlock,
                              const AttachmentTargets& targets, std::string_view passes) {
  commands.beginPass(std::string(passes) + "geometry");
  scene_.draw(commands, camera, width, height,
              {.depth = targets.depth,
               .normal = targets.normal,
               .baseColour = targets.baseColour,
               .facetNormal = targets.facetNormal});
  commands.endPass();
  if (!targets.viewDepth) return;

  if (!viewDepth_) {
    nearest_ = device_.createSampler({.label = "nearest depth"});
    viewDepth_ = device_.createComputePipeline(
        {.label = "view depth", .shader = &grisaille_shader_view_depth, .constants = {}});
  }
  const std::array bindings = {
      gpu::uniformBinding(0, viewBlock),
      gpu::textureBinding(0, {.texture = targets.depth}, nearest_),
      gpu::imageBinding(0, targets.viewDepth),
  };
  constexpr uint32_t kGroup = 8;  // threads a side
  commands.beginPass(std::string(passes) + "view_depth");
  commands.dispatch({.pipeline = viewDepth_,
                     .bindings = bindings,
                     .groups = {(width + kGroup - 1) / kGroup, (height + kGroup - 1) / kGroup, 1}});
  commands.endPass();
}

}  // namespace grisaille::frame
