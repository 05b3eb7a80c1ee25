// SPDX-License-Identifier: MIT
// The geometry of the raster tests: triangles in clip space.
#pragma once

#include "shaders/colored_frag.h"
#include "shaders/colored_vert.h"
#include "shaders/position_vert.h"
#include "shaders/uniform_color_frag.h"
#include "shaders/white_frag.h"
#include "tests/support/devices.h"

namespace grisaille::tests {

class RasterTest : public BackendTest {
 protected:
  static constexpr uint32_t kSize = 32;

  gpu::Texture target(gpu::Format format, uint32_t size = kSize) {
    return makeTexture({.label = "target",
                        .format = format,
                        .width = size,
                        .height = size,
                        .usage = gpu::TextureUsage::kTarget | gpu::TextureUsage::kSampled});
  }

  // A pipeline with positions (three floats) as its only vertex stream.
  gpu::GraphicsPipeline positionPipeline(const gpu::Shader* fragment,
                                         std::span<const gpu::Format> colors,
                                         gpu::Format depth = gpu::Format::kNone) {
    static constexpr uint32_t kStrides[] = {12};
    static constexpr gpu::VertexAttribute kAttributes[] = {{.location = 0}};
    return makeGraphics({.vertex = &grisaille_shader_position_vert,
                         .fragment = fragment,
                         .streamStrides = kStrides,
                         .attributes = kAttributes,
                         .colorFormats = colors,
                         .depthFormat = depth});
  }

  gpu::Buffer vertices(const std::vector<float>& positions) {
    return bufferOf(positions, gpu::BufferUsage::kVertex);
  }

  // One triangle at this depth that covers the whole target.
  gpu::Buffer everything(float depth = 0.5f) {
    return vertices({-1, -3, depth, 3, 1, depth, -1, 1, depth});
  }
};

}  // namespace grisaille::tests
