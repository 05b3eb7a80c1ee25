// SPDX-License-Identifier: MIT
// The benchmarks' baseline: ambient occlusion as tutorials teach it, on the project's GPU layer. A
// fragment pass takes 64 taps over view-space positions and normals in 16-bit floats, with a bias
// of a twentieth of the radius. A 4 x 4 box blur follows.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string_view>

#include "core/frame/renderer.h"
#include "core/gpu/device.h"
#include "core/image/image.h"
#include "core/scene/camera.h"

namespace grisaille::bench {

class TutorialSsao {
 public:
  // `device` must outlive the object and must not be recording.
  explicit TutorialSsao(gpu::Device& device);
  ~TutorialSsao();
  TutorialSsao(const TutorialSsao&) = delete;
  TutorialSsao& operator=(const TutorialSsao&) = delete;

  // Draws a frame from the outputs `depth` and `normal` that `renderer` drew last, of `camera` and
  // `size`, and submits it. `radius`: metres.
  void draw(frame::Renderer& renderer, const scene::Camera& camera, glm::uvec2 size,
            double radius = 0.5);

  // Visibility of the last draw().
  image::Image read();

  // Whether a pass of a frame counts as cost of the baseline.
  static bool counts(std::string_view pass) { return pass.starts_with("tutorial_"); }

 private:
  struct Inputs {
    gpu::Texture position;  // rgba16f, view space, metres
    gpu::Texture normal;    // rgba16f, view space
  };

  // Pass "inputs_of_tutorial", which does not count as cost of the baseline. Makes transient
  // buffers from the frame's attachments (grisaille_attachment: view depth, world normal).
  // `projection` is clip from view.
  Inputs makeInputs(gpu::Commands& commands, gpu::Texture viewDepth, gpu::Texture worldNormal,
                    const glm::mat4& projection, const glm::mat3& viewFromWorld, uint32_t width,
                    uint32_t height);

  // Passes "tutorial_occlusion" and "tutorial_blur" into `output_`.
  void record(gpu::Commands& commands, gpu::Texture position, gpu::Texture normal,
              const glm::mat4& projection, uint32_t width, uint32_t height, double radius);

  gpu::GraphicsPipeline pipeline(std::string_view label, const gpu::Shader& fragment,
                                 std::span<const gpu::Format> formats);
  void pass(gpu::Commands& commands, std::string_view label, gpu::GraphicsPipeline pipeline,
            std::span<const gpu::Binding> bindings, std::span<const gpu::Texture> targets);

  gpu::Device& device_;
  std::array<glm::vec4, 64> kernel_ = {};
  gpu::Texture noise_;
  gpu::Texture output_;  // r8, 1: open
  glm::uvec2 outputSize_ = glm::uvec2(0);
  gpu::Sampler clamped_;
  gpu::Sampler repeated_;
  gpu::GraphicsPipeline inputs_;
  gpu::GraphicsPipeline occlusion_;
  gpu::GraphicsPipeline blur_;
};

}  // namespace grisaille::bench
