// SPDX-License-Identifier: MIT
#include "core/frame/compositor.h"

#include <array>
#include <cstddef>

#include "shaders/compose.h"

namespace grisaille::frame {
namespace {

constexpr uint32_t kGroup = 8;  // threads per side of a workgroup

// The std140 block of shaders/scene/compose.comp, which documents the fields.
struct ComposeBlock {
  glm::vec4 background;
  glm::vec4 depth;
};
GRISAILLE_CHECK_BLOCK_compose_Compose(ComposeBlock);

uint32_t groups(uint32_t pixels) {
  return (pixels + kGroup - 1) / kGroup;
}

}  // namespace

Compositor::~Compositor() {
  device_.destroy(plain_);
  device_.destroy(tinted_);
  device_.destroy(nearest_);
  device_.destroy(white_);
  device_.destroy(clear_);
}

void Compositor::create(gpu::Commands& commands) {
  const auto pipeline = [&](bool tinted) {
    // Constant 0 of shaders/scene/compose.comp.
    const gpu::Specialization constant[] = {{0, tinted ? 1u : 0u}};
    return device_.createComputePipeline(
        {.label = "compose", .shader = &grisaille_shader_compose, .constants = constant});
  };
  plain_ = pipeline(false);
  tinted_ = pipeline(true);
  const auto neutral = [&](const char* label, uint32_t texel) {
    const gpu::Texture texture = device_.createTexture({.label = label,
                                                        .format = gpu::Format::kRgba8Unorm,
                                                        .width = 1,
                                                        .height = 1,
                                                        .usage = gpu::TextureUsage::kSampled});
    commands.upload(texture, 0, 0, std::as_bytes(std::span(&texel, 1)));
    return texture;
  };
  white_ = neutral("white", 0xffffffffu);
  clear_ = neutral("clear", 0);
  nearest_ = device_.createSampler({.label = "nearest"});
}

void Compositor::record(gpu::Commands& commands, const Composition& composition) {
  if (!nearest_) create(commands);
  const uint32_t width = composition.width, height = composition.height;
  const double guard = composition.guard;
  const glm::dvec2 depthSize = glm::dvec2(width, height) + 2 * guard;
  const ComposeBlock block{
      .background = composition.background,
      .depth = glm::vec4(glm::dvec4(guard, guard, 1 / depthSize.x, 1 / depthSize.y))};
  const gpu::BufferRange uniform = commands.uniform(std::as_bytes(std::span(&block, 1)));
  gpu::Texture surface = composition.surface ? composition.surface : white_;
  gpu::Texture clipDepth = composition.clipDepth ? composition.clipDepth : white_;
  for (const Layer& layer : composition.layers) {
    const bool last = &layer == &composition.layers.back();
    const gpu::Texture to = last ? composition.target
                                 : commands.transient({.label = "layer",
                                                       .format = gpu::Format::kRgba16Float,
                                                       .width = width,
                                                       .height = height,
                                                       .usage = gpu::TextureUsage::kStorage |
                                                                gpu::TextureUsage::kSampled});
    const std::array bindings = {
        gpu::uniformBinding(0, uniform),
        gpu::textureBinding(0, {.texture = surface}, nearest_),
        gpu::textureBinding(1, {.texture = layer.overlay ? layer.overlay : clear_}, nearest_),
        gpu::textureBinding(2, {.texture = layer.visibility ? layer.visibility : white_}, nearest_),
        gpu::textureBinding(3, {.texture = clipDepth}, nearest_),
        gpu::imageBinding(0, to),
    };
    commands.dispatch({.pipeline = layer.tinted ? tinted_ : plain_,
                       .bindings = bindings,
                       .groups = {groups(width), groups(height), 1}});
    surface = to;
    clipDepth = white_;  // the first layer holds the background
  }
}

}  // namespace grisaille::frame
