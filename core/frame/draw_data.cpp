// SPDX-License-Identifier: MIT
#include "core/frame/draw_data.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/scene/normal_map.h"

namespace grisaille::frame {
namespace {

// IEC 61966-2-1.
float toLinear(uint8_t value) {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t{};
    for (size_t i = 0; i < t.size(); ++i) {
      const float v = static_cast<float>(i) / 255.0f;
      t[i] = v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
    }
    return t;
  }();
  return table[value];
}

uint8_t toSrgb(float linear) {
  const float v =
      linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
  return static_cast<uint8_t>(std::lround(std::clamp(v, 0.0f, 1.0f) * 255.0f));
}

// A 2x2 box filter. A side of 1 counts its texels twice; an odd side over 1 drops its last texels.
std::vector<uint8_t> halved(const std::vector<uint8_t>& from, uint32_t width, uint32_t height) {
  const uint32_t w = std::max(1u, width / 2), h = std::max(1u, height / 2);
  std::vector<uint8_t> to(size_t{w} * h * 4);
  for (uint32_t y = 0; y < h; ++y) {
    for (uint32_t x = 0; x < w; ++x) {
      const uint32_t xs[2] = {std::min(2 * x, width - 1), std::min(2 * x + 1, width - 1)};
      const uint32_t ys[2] = {std::min(2 * y, height - 1), std::min(2 * y + 1, height - 1)};
      for (uint32_t c = 0; c < 4; ++c) {
        float sum = 0;
        for (const uint32_t sy : ys) {
          for (const uint32_t sx : xs) {
            const uint8_t value = from[(size_t{sy} * width + sx) * 4 + c];
            sum += c == 3 ? static_cast<float>(value) / 255.0f : toLinear(value);
          }
        }
        to[(size_t{y} * w + x) * 4 + c] =
            c == 3 ? static_cast<uint8_t>(std::lround(sum * 255.0f / 4)) : toSrgb(sum / 4);
      }
    }
  }
  return to;
}

}  // namespace

std::vector<std::vector<uint8_t>> mipChain(const image::Image8& image) {
  std::vector<std::vector<uint8_t>> levels = {image.pixels};
  uint32_t width = image.width, height = image.height;
  while (width > 1 || height > 1) {
    levels.push_back(halved(levels.back(), width, height));
    width = std::max(1u, width / 2);
    height = std::max(1u, height / 2);
  }
  return levels;
}

glm::dmat4 normalTransform(const glm::dmat3& linear) {
  const glm::dmat3 map = scene::normalMap(linear);
  // Scale to lengths near 1: the matrices of tiny and huge scenes then fit single precision.
  const double largest = std::max({glm::length(map[0]), glm::length(map[1]), glm::length(map[2])});
  return glm::dmat4(largest > 0 ? map / largest : map);
}

glm::dmat4 clipFromCamera(const scene::View& view) {
  return scene::clipFromView(view) * glm::dmat4(glm::transpose(view.worldFromView));
}

glm::dmat4 cameraFromObject(const glm::dmat4& worldFromObject, const glm::dvec3& eye) {
  glm::dmat4 matrix = worldFromObject;
  matrix[3] -= glm::dvec4(eye, 0);
  return matrix;
}

bool mayBeSeen(const scene::Bounds& bounds, const glm::dmat4& clipFromObject) {
  int outside[4] = {0, 0, 0, 0};
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec4 p =
        clipFromObject * glm::dvec4((corner & 1) != 0 ? bounds.max.x : bounds.min.x,
                                    (corner & 2) != 0 ? bounds.max.y : bounds.min.y,
                                    (corner & 4) != 0 ? bounds.max.z : bounds.min.z, 1);
    outside[0] += p.x > p.w ? 1 : 0;
    outside[1] += p.x < -p.w ? 1 : 0;
    outside[2] += p.y > p.w ? 1 : 0;
    outside[3] += p.y < -p.w ? 1 : 0;
  }
  return std::find(std::begin(outside), std::end(outside), 8) == std::end(outside);
}

gpu::Cull cullOf(const scene::Material& material, const glm::dmat4& worldFromObject) {
  if (material.doubleSided) return gpu::Cull::kNone;
  const bool mirrors = glm::determinant(glm::dmat3(worldFromObject)) < 0;
  return mirrors ? gpu::Cull::kFront : gpu::Cull::kBack;
}

}  // namespace grisaille::frame
