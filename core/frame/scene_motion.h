// SPDX-License-Identifier: MIT
// Motion vectors of a scene: where the surface of each pixel was in the previous frame. A pass over
// the picture computes them from depth and camera; only instances that moved are drawn over it.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "core/frame/attachments.h"
#include "core/frame/scene_resources.h"
#include "core/gpu/device.h"
#include "core/scene/scene.h"
#include "core/scene/view.h"

namespace grisaille::frame {

// A scene as it was in the previous frame.
struct FormerScene {
  uint64_t poses = 0;
  std::vector<glm::dmat4> transforms;  // of its instances
  std::vector<glm::vec3> deformed;     // positions of the rig's runs, one after the other
};

class SceneMotion {
 public:
  // All arguments must outlive this.
  SceneMotion(gpu::Device& device, const scene::Scene& scene, SceneResources& resources)
      : device_(device), scene_(scene), resources_(resources) {}
  ~SceneMotion();
  SceneMotion(const SceneMotion&) = delete;
  SceneMotion& operator=(const SceneMotion&) = delete;

  // Keeps the scene as it is for the motion of the next frame, or drops what was kept.
  void remember();
  void forget() { then_.reset(); }

  // Whether motion since the previous frame can be known, which was drawn in pose number `poses`.
  bool knows(uint64_t poses) const { return then_.has_value() || poses == scene_.poses; }

  // Writes every pixel of `to.texture`. `depth`: clip depth of the same size. Call it outside a
  // pass.
  void record(gpu::Commands& commands, const scene::View& view, gpu::BufferRange viewBlock,
              gpu::Texture depth, const MotionTarget& to, std::string_view passes);

 private:
  void recordCamera(gpu::Commands& commands, const scene::View& view, gpu::BufferRange viewBlock,
                    gpu::Texture depth, const MotionTarget& to);
  void recordMoved(gpu::Commands& commands, const scene::View& view, gpu::Texture depth,
                   const MotionTarget& to);
  std::vector<bool> uploadDeformed(gpu::Commands& commands);
  void makePipelines();

  gpu::Device& device_;
  const scene::Scene& scene_;
  SceneResources& resources_;
  std::optional<FormerScene> then_;
  gpu::GraphicsPipeline camera_, moved_;
  gpu::Sampler nearest_;
  gpu::Buffer thenPositions_;  // as long as the scene's, but only deformed runs are written
};

}  // namespace grisaille::frame
