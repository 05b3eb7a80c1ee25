// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/scene/built_in/plants.h"
#include "core/scene/built_in/shapes.h"

namespace grisaille::scene {
namespace {

constexpr int kPlantSide = 256;  // texels

// A leaf in a texture; lengths are fractions of its side, y runs down.
struct Leaf {
  glm::dvec2 stem, tip;
  double half;    // half of its width
  double bright;  // factor of its colour
};

// A texel's place in the leaf that covers it most.
struct Cover {
  double inside = -1;  // distance to the edge, fraction of the texture's side; below 0: outside
  double bright = 0;
  bool rib = false;
};

void cover(Cover& best, const Leaf& leaf, const glm::dvec2& point) {
  const glm::dvec2 axis = leaf.tip - leaf.stem;
  const double length = glm::length(axis);
  const glm::dvec2 unit = axis / length, from = point - leaf.stem;
  const double t = glm::dot(from, unit) / length;
  if (t < 0 || t > 1) return;
  const double away = std::abs(from.x * unit.y - from.y * unit.x);
  // Widest at two fifths, pointed at the tip, with a stalk at the stem.
  const double half =
      std::max(leaf.half * 3.0 * std::sqrt(t) * (1 - t) * (1 - 0.35 * t) - 0.004, 0.008 - 0.02 * t);
  const double inside = half - away;
  if (inside <= best.inside) return;
  best = {.inside = inside, .bright = leaf.bright, .rib = away < 0.006};
}

image::Image8 drawn(const std::vector<Leaf>& leaves, const glm::dvec3& colour) {
  image::Image8 picture{.width = kPlantSide, .height = kPlantSide, .pixels = {}};
  picture.pixels.reserve(size_t{4} * kPlantSide * kPlantSide);
  for (int row = 0; row < kPlantSide; ++row) {
    for (int column = 0; column < kPlantSide; ++column) {
      Cover best;
      for (const Leaf& leaf : leaves) {
        cover(best, leaf, {(column + 0.5) / kPlantSide, (row + 0.5) / kPlantSide});
      }
      // Alpha is 0.5 at the edge and ramps over one texel to either side, for a smooth cutoff.
      const double alpha = std::clamp(0.5 + best.inside * kPlantSide / 2, 0.0, 1.0);
      const double shade = best.inside < 0 ? 1 : best.bright * (best.rib ? 1.2 : 1);
      for (int i = 0; i < 3; ++i) {
        picture.pixels.push_back(
            static_cast<uint8_t>(std::lround(std::min(colour[i] * shade, 255.0))));
      }
      picture.pixels.push_back(static_cast<uint8_t>(std::lround(255 * alpha)));
    }
  }
  return picture;
}

}  // namespace

image::Image8 twigTexture() {
  std::vector<Leaf> leaves{{{0.5, 1}, {0.5, 0.02}, 0.007, 0.6}};
  for (uint32_t k = 0; k < 9; ++k) {
    const double y = 0.92 - 0.095 * k;
    const double side = k % 2 == 0 ? 1 : -1;
    const double reach = 0.4 * (1 - 0.3 * (k / 9.0)) * hashBetween(k + 40, 0.85, 1.15);
    leaves.push_back({{0.5, y},
                      {0.5 + side * reach, y - 0.2 * hashBetween(k + 60, 0.5, 1.5)},
                      0.085 * hashBetween(k + 80, 0.85, 1.1),
                      hashBetween(k + 20, 0.8, 1.15)});
  }
  leaves.push_back({{0.5, 0.22}, {0.52, 0.0}, 0.07, 1.05});
  return drawn(leaves, {86, 124, 52});
}

image::Image8 hedgeTexture() {
  std::vector<Leaf> leaves;
  for (uint32_t k = 0; k < 26; ++k) {
    const glm::dvec2 at(hashBetween(k + 300, 0.18, 0.82), hashBetween(k + 340, 0.2, 0.95));
    const double turn = hashBetween(k + 380, -0.2, 0.2) + 0.3 * (at.x - 0.5);
    const double length = hashBetween(k + 420, 0.17, 0.26);
    leaves.push_back({at, at + length * glm::dvec2(sinTurns(turn), -cosTurns(turn)),
                      hashBetween(k + 460, 0.06, 0.085), hashBetween(k + 500, 0.7, 1.15)});
  }
  return drawn(leaves, {62, 104, 44});
}

}  // namespace grisaille::scene
