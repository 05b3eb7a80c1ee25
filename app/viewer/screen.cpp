// SPDX-License-Identifier: MIT
#include "app/viewer/screen.h"

#include <imgui/imgui.h>

#include "shaders/copy_picture.h"
#include "shaders/show.h"

namespace grisaille::app::viewer {
namespace {

std::array<uint32_t, 3> groupsFor(glm::uvec2 pixels) {
  constexpr uint32_t kGroup = 8;
  return {(pixels.x + kGroup - 1) / kGroup, (pixels.y + kGroup - 1) / kGroup, 1};
}

}  // namespace

Screen::~Screen() {
  for (const gpu::Texture texture : {picture_, window_, blank_}) device_.destroy(texture);
  for (const auto& [kinds, pipeline] : show_) device_.destroy(pipeline);
  device_.destroy(copy_);
  device_.destroy(nearest_);
}

Screen::Shown Screen::wanted(const ScreenDesc& desc) const {
  const bool empty = !desc.sides[0].texture || !desc.sides[1].texture;
  const auto width = static_cast<float>(desc.place.size.x);
  Shown all{};
  all.block.place = desc.place.corner;
  all.block.size = empty ? glm::ivec2(0) : glm::ivec2(desc.place.size);
  const auto scale = static_cast<float>(desc.scale);
  all.block.zoom = desc.zoom * scale;
  const float beyond = 2 * width + 16;
  const bool lined = desc.split && desc.way == SplitWay::kLine;
  const bool right = desc.split && desc.way == SplitWay::kFlicker && desc.turned;
  all.block.line = lined ? desc.line * width : right ? -beyond : beyond;
  all.block.far_depth = desc.farDepth;
  all.block.line_width = desc.lineWidth;
  all.block.full = desc.split && desc.way == SplitWay::kDifference ? desc.full : 0;
  if (empty) {
    all.sides[0].texture = all.sides[1].texture = blank_;
    return all;
  }
  // After a resize, the sides differ in size from `place` until the next frame.
  all.block.centre = desc.centre * glm::vec2(desc.size) / scale;
  all.sides = desc.sides;
  all.revision = desc.revision;
  return all;
}

void Screen::prepare(gpu::Commands& commands, const ScreenDesc& desc) {
  if (!nearest_) {
    nearest_ = device_.createSampler({.label = "nearest"});
    copy_ = device_.createComputePipeline(
        {.label = "copy", .shader = &grisaille_shader_copy_picture, .constants = {}});
    blank_ = device_.createTexture({.label = "blank",
                                    .format = gpu::Format::kRgba8Unorm,
                                    .width = 1,
                                    .height = 1,
                                    .usage = gpu::TextureUsage::kSampled});
    const uint32_t black = 0;
    commands.upload(blank_, 0, 0, std::as_bytes(std::span(&black, 1)));
  }
  if (size_ == desc.pixels) return;
  shown_.reset();
  const auto remake = [&](gpu::Texture& texture, const char* label, gpu::TextureUsage usage) {
    device_.destroy(texture);
    texture = {};
    texture = device_.createTexture({.label = label,
                                     .format = gpu::Format::kRgba8Unorm,
                                     .width = desc.pixels.x,
                                     .height = desc.pixels.y,
                                     .usage = gpu::TextureUsage::kStorage | usage});
  };
  size_ = glm::uvec2(0);  // in case a texture cannot be created
  remake(picture_, "picture", gpu::TextureUsage::kSampled);
  remake(window_, "window", gpu::TextureUsage::kTarget);
  size_ = desc.pixels;
}

gpu::ComputePipeline Screen::showPipeline(const std::array<Kind, 2>& kinds) {
  gpu::ComputePipeline& pipeline = show_[kinds];
  if (!pipeline) {
    const gpu::Specialization constants[] = {{0, static_cast<uint32_t>(kinds[0])},
                                             {1, static_cast<uint32_t>(kinds[1])}};
    pipeline = device_.createComputePipeline(
        {.label = "show", .shader = &grisaille_shader_show, .constants = constants});
  }
  return pipeline;
}

void Screen::show(gpu::Commands& commands, const Shown& wanted) {
  GRISAILLE_CHECK_BLOCK_show_Show(ShowBlock);
  const std::array bindings = {
      gpu::uniformBinding(0, commands.uniform(std::as_bytes(std::span(&wanted.block, 1)))),
      gpu::textureBinding(0, {.texture = wanted.sides[0].texture}, nearest_),
      gpu::textureBinding(1, {.texture = wanted.sides[1].texture}, nearest_),
      gpu::imageBinding(0, picture_)};
  commands.beginPass("viewer/show");
  commands.dispatch({.pipeline = showPipeline({wanted.sides[0].kind, wanted.sides[1].kind}),
                     .bindings = bindings,
                     .groups = groupsFor(size_)});
  commands.endPass();
}

gpu::Texture Screen::draw(const ScreenDesc& desc, const ImDrawData& interfaceData) {
  gpu::Commands& commands = device_.begin();
  try {
    prepare(commands, desc);
    const bool empty = !desc.sides[0].texture || !desc.sides[1].texture;
    const Shown now = shown_ && empty && desc.keeps ? *shown_ : wanted(desc);
    if (!shown_ || !(*shown_ == now)) {
      shown_.reset();
      show(commands, now);
    }
    commands.beginPass("viewer/interface");
    const std::array bindings = {gpu::textureBinding(0, {.texture = picture_}, nearest_),
                                 gpu::imageBinding(0, window_)};
    commands.dispatch({.pipeline = copy_, .bindings = bindings, .groups = groupsFor(size_)});
    interface_.draw(commands, interfaceData, window_, size_.x, size_.y, desc.pictures);
    commands.endPass();
    device_.submit();
    shown_ = now;
  } catch (...) {
    device_.abandon();
    throw;
  }
  return window_;
}

}  // namespace grisaille::app::viewer
