// SPDX-License-Identifier: MIT
// Attachments drawn from a scene.
#pragma once

#include "core/frame/attachments.h"
#include "core/frame/scene_motion.h"
#include "core/frame/scene_resources.h"

namespace grisaille::frame {

class SceneAttachments : public AttachmentSource {
 public:
  // Label prefixes of the passes that draw back faces, and what lies behind them; they follow
  // record()'s `passes`.
  static constexpr std::string_view kBackPasses = "back ", kNextPasses = "next ";

  // Device and scene must outlive this. The scene may change only between calls, by scene::pose().
  // matter: as for SceneResources
  SceneAttachments(gpu::Device& device, const scene::Scene& scene,
                   trace::SceneMatter* matter = nullptr)
      : device_(device),
        poses_(scene.poses),
        scene_(device, scene, matter),
        motion_(device, scene, scene_) {}
  ~SceneAttachments() override;

  bool goesBeyond() const override { return true; }
  bool hasMotion() const override { return true; }
  bool hasThickness() const override { return true; }
  uint64_t poses() const override { return poses_; }
  bool knowsMotion(uint64_t poses) const override { return motion_.knows(poses); }
  void finish(bool motion) override;
  void record(gpu::Commands& commands, const scene::View& view, gpu::BufferRange viewBlock,
              const AttachmentTargets& targets, std::string_view passes) override;

 private:
  // Converts clip depth to view depth.
  void viewDepth(gpu::Commands& commands, gpu::Texture clipDepth, gpu::BufferRange viewBlock,
                 gpu::Texture to, glm::uvec2 size, std::string_view passes);

  gpu::Device& device_;
  const uint64_t& poses_;  // of the scene
  SceneResources scene_;
  SceneMotion motion_;
  gpu::ComputePipeline viewDepth_;
  gpu::Sampler nearest_;
};

}  // namespace grisaille::frame
