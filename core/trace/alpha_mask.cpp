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

AlphaMask::AlphaMask(const scene::Material& material, const scene::Texture* texture,
                     std::shared_ptr<const image::Alpha8> alpha)
    : alpha_(std::move(alpha)), factor_(material.baseColor.a), cutoff_(material.alphaCutoff) {
  if (texture == nullptr) return;
  wrapU_ = texture->wrapU;
  wrapV_ = texture->wrapV;
}

float AlphaMask::texel(int64_t x, int64_t y) const {
  const int64_t column = wrapped(x, alpha_->width, wrapU_);
  const int64_t row = wrapped(y, alpha_->height, wrapV_);
  return static_cast<float>(alpha_->pixels[static_cast<size_t>(row * alpha_->width + column)]) /
         255.0f;
}

bool AlphaMask::isHole(const glm::vec2& texCoord, float vertexAlpha) const {
  if (!alpha_) return factor_ * vertexAlpha < cutoff_;
  const float x = texCoord.x * static_cast<float>(alpha_->width) - 0.5f;
  const float y = texCoord.y * static_cast<float>(alpha_->height) - 0.5f;
  const float left = std::floor(x);
  const float top = std::floor(y);
  // Larger coordinates have no fractional bits, and even larger ones would overflow an integer.
  if (!(std::abs(left) < 0x1p24f && std::abs(top) < 0x1p24f)) return false;
  const auto i = static_cast<int64_t>(left);
  const auto j = static_cast<int64_t>(top);
  const float above = std::lerp(texel(i, j), texel(i + 1, j), x - left);
  const float below = std::lerp(texel(i, j + 1), texel(i + 1, j + 1), x - left);
  return std::lerp(above, below, y - top) * (factor_ * vertexAlpha) < cutoff_;
}

}  // namespace grisaille::trace
