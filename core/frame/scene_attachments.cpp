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

void SceneAttachments::record(gpu::Commands& commands, const scene::View& view,
                              gpu::BufferRange viewBlock, const AttachmentTargets& targets,
                              std::string_view passes) {
  commands.beginPass(std::string(passes) + "geometry");
  scene_.draw(commands, view,
              {.depth = targets.depth,
               .normal = targets.normal,
               .baseColour = targets.baseColour,
               .facetNormal = targets.facetNormal,
               .thickness = targets.thickness});
  commands.endPass();
  if (targets.viewDepth) {
    viewDepth(commands, targets.depth, viewBlock, targets.viewDepth, view.size, passes);
  }
  if (targets.motion.texture) {
    motion_.record(commands, view, viewBlock, targets.depth, targets.motion, passes);
  }
  // Draws the surfaces behind the depth `front`, and returns their clip depth.
  const auto drawBehind = [&](const char* label, gpu::Texture front, SceneSides sides,
                              std::string_view prefix, gpu::Texture metres) {
    const gpu::Texture depth =
        commands.transient({.label = label,
                            .format = gpu::Format::kD32Float,
                            .width = view.size.x,
                            .height = view.size.y,
                            .usage = gpu::TextureUsage::kTarget | gpu::TextureUsage::kSampled});
    const std::string behind = std::string(passes) + std::string(prefix);
    commands.beginPass(behind + "geometry");
    scene_.draw(commands, view, {.depth = depth, .front = front, .sides = sides});
    commands.endPass();
    if (metres) viewDepth(commands, depth, viewBlock, metres, view.size, behind);
    return depth;
  };
  if (targets.backDepth || targets.nextDepth) {
    const gpu::Texture back =
        drawBehind("back", targets.depth, SceneSides::kFar, kBackPasses, targets.backDepth);
    if (targets.nextDepth) {
      drawBehind("next", back, SceneSides::kNear, kNextPasses, targets.nextDepth);
    }
  }
}

void SceneAttachments::finish(bool motion) {
  if (motion) {
    motion_.remember();
  } else {
    motion_.forget();
  }
}

void SceneAttachments::viewDepth(gpu::Commands& commands, gpu::Texture clipDepth,
                                 gpu::BufferRange viewBlock, gpu::Texture to, glm::uvec2 size,
                                 std::string_view passes) {
  if (!viewDepth_) {
    nearest_ = device_.createSampler({.label = "nearest depth"});
    viewDepth_ = device_.createComputePipeline(
        {.label = "view depth", .shader = &grisaille_shader_view_depth, .constants = {}});
  }
  const std::array bindings = {
      gpu::uniformBinding(0, viewBlock),
      gpu::textureBinding(0, {.texture = clipDepth}, nearest_),
      gpu::imageBinding(0, to),
  };
  constexpr uint32_t kViewDepthGroup = 8;  // threads per side of a workgroup
  commands.beginPass(std::string(passes) + "view_depth");
  commands.dispatch({.pipeline = viewDepth_,
                     .bindings = bindings,
                     .groups = {(size.x + kViewDepthGroup - 1) / kViewDepthGroup,
                                (size.y + kViewDepthGroup - 1) / kViewDepthGroup, 1}});
  commands.endPass();
}

}  // namespace grisaille::frame
