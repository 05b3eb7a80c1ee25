// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "core/scene/built_in/atrium_parts.h"

namespace grisaille::scene {
namespace {

constexpr int kSide = 256;  // texels

// Returns how far inside the leaf a point lies, as a fraction of the texture's side; below 0: in a
// hole. `x` is the distance from the midrib, `y` from the tip, both as fractions of the side.
double insideLeaf(double x, double y) {
  const double side = std::abs(x);
  const double rib = 0.012 - side + 0.01 * y;
  // Leaflets grow from the midrib at every tenth of the side and point to the tip.
  double best = y < 0.05 ? -1 : rib;
  for (int i = 1; i <= 9; ++i) {
    const double root = 0.1 * i + 0.04;
    const double reach = 0.46 * (1.15 - std::abs(0.62 - root) * 1.35);
    const double along = (side + 0.55 * (root - y) * 0.6) / reach;  // 0 root ... 1 tip
    if (along < 0 || along > 1) continue;
    const double spine = root - 0.24 * along * reach / 0.46;
    const double half = 0.052 * std::sqrt(along) * (1 - along) * 2.2;
    best = std::max(best, half - std::abs(y - spine));
  }
  // The terminal leaflet.
  const double t = y / 0.2;
  if (t < 1) best = std::max(best, 0.06 * std::sqrt(t) * (1 - t) * 2 - side);
  return best;
}

}  // namespace

image::Image8 leafTexture() {
  image::Image8 picture{.width = kSide, .height = kSide, .pixels = {}};
  picture.pixels.reserve(size_t{4} * kSide * kSide);
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const double x = (column + 0.5) / kSide - 0.5, y = (row + 0.5) / kSide;
      const double inside = insideLeaf(x, y);
      // Alpha is 0.5 at the edge and ramps over one texel to either side, for a smooth cutoff.
      const double alpha = std::clamp(0.5 + inside * kSide / 2, 0.0, 1.0);
      const double shade = 0.75 + 0.25 * hashUnit(static_cast<uint32_t>(row * kSide + column) / 3) -
                           (std::abs(x) < 0.012 ? 0.2 : 0.0);
      for (const double channel : {70 * shade, 118 * shade, 48 * shade, 255 * alpha}) {
        picture.pixels.push_back(static_cast<uint8_t>(std::lround(channel)));
      }
    }
  }
  return picture;
}

}  // namespace grisaille::scene
