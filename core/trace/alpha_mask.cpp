// SPDX-License-Identifier: MIT
#include "core/trace/alpha_mask.h"

#include <algorithm>
#include <cmath>

namespace grisaille::trace {
namespace {

int64_t wrapped(int64_t i, int64_t size, scene::Wrap wrap) {
  const auto modulo = [](int64_t a, int64_t n) { return ((a % n) + n) % n; };
  switch (wrap) {
    case scene::Wrap::kClamp:
      return std::clamp<int64_t>(i, 0, size - 1);
    case scene::Wrap::kMirror: {
      const int64_t m = modulo(i, 2 * size);
      return m < size ? m : 2 * size - 1 - m;
    }
    case scene::Wrap::kRepeat:
      break;
  }
  return modulo(i, size);
}

}  // namespace

AlphaMask::AlphaMask(const scene::Scene& scene, const scene::Material& material)
    : factor_(material.baseColor.a), cutoff_(material.alphaCutoff) {
  if (material.baseColorTexture < 0) return;
  const scene::Texture& texture = scene.textures[static_cast<size_t>(material.baseColorTexture)];
  const image::Image8 image = scene::texelsOf(texture);
  width_ = image.width;
  height_ = image.height;
  wrapU_ = texture.wrapU;
  wrapV_ = texture.wrapV;
  alpha_.resize(size_t{width_} * height_);
  for (size_t i = 0; i < alpha_.size(); ++i) alpha_[i] = image.pixels[4 * i + 3];
}

float AlphaMask::texel(int64_t x, int64_t y) const {
  const int64_t column = wrapped(x, width_, wrapU_);
  const int64_t row = wrapped(y, height_, wrapV_);
  return static_cast<float>(alpha_[static_cast<size_t>(row * width_ + column)]) / 255.0f;
}

bool AlphaMask::isHole(const glm::vec2& texCoord) const {
  const float x = texCoord.x * static_cast<float>(width_) - 0.5f;
  const float y = texCoord.y * static_cast<float>(height_) - 0.5f;
  const float left = std::floor(x);
  const float top = std::floor(y);
  // Larger coordinates have no fractional bits, and even larger ones would overflow an integer.
  if (!(std::abs(left) < 0x1p24f && std::abs(top) < 0x1p24f)) return false;
  const auto i = static_cast<int64_t>(left);
  const auto j = static_cast<int64_t>(top);
  const float above = std::lerp(texel(i, j), texel(i + 1, j), x - left);
  const float below = std::lerp(texel(i, j + 1), texel(i + 1, j + 1), x - left);
  return std::lerp(above, below, y - top) * factor_ < cutoff_;
}

}  // namespace grisaille::trace
