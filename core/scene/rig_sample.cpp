// SPDX-License-Identifier: MIT
// Interpolation of keys: glTF 2.0, appendix C.
#include <algorithm>
#include <cmath>

#include "core/scene/rig.h"

namespace grisaille::scene {
namespace {

void normalise(std::vector<double>& quaternion) {
  double squared = 0;
  for (const double x : quaternion) squared += x * x;
  if (!(squared > 0)) {
    quaternion = {0, 0, 0, 1};
    return;
  }
  for (double& x : quaternion) x /= std::sqrt(squared);
}

// C.3, linear interpolation; C.4 for quaternions.
std::vector<double> linear(std::vector<double> from, std::vector<double> to, double t,
                           bool rotation) {
  double a = 1 - t, b = t;
  if (rotation) {
    normalise(from);
    normalise(to);
    double cosine = 0;
    for (size_t i = 0; i < from.size(); ++i) cosine += from[i] * to[i];
    const double angle = std::acos(std::min(std::abs(cosine), 1.0));
    // The weights of nearly equal quaternions approach those of linear interpolation.
    if (angle > 1e-6) {
      a = std::sin(angle * (1 - t)) / std::sin(angle);
      b = std::sin(angle * t) / std::sin(angle);
    }
    if (cosine < 0) b = -b;
  }
  for (size_t i = 0; i < from.size(); ++i) from[i] = a * from[i] + b * to[i];
  if (rotation) normalise(from);
  return from;
}

}  // namespace

std::vector<double> sample(const Keys& keys, double seconds, bool rotation) {
  const size_t width = keys.width;
  const bool cubic = keys.interpolation == Interpolation::kCubicSpline;
  // `part` of a cubic key: 0 in-tangent, 1 value, 2 out-tangent.
  const auto numbers = [&](size_t key, size_t part) {
    const size_t first = cubic ? (3 * key + part) * width : key * width;
    const float* begin = keys.values.data() + first;
    return std::vector<double>(begin, begin + width);
  };
  const auto after =
      std::ranges::upper_bound(keys.seconds, seconds, {}, [](float key) { return double{key}; });
  const auto next = static_cast<size_t>(after - keys.seconds.begin());
  const bool outside = next == 0 || next == keys.seconds.size();
  const size_t key = next == 0 ? 0 : next - 1;
  std::vector<double> result = numbers(key, 1);
  if (outside || keys.interpolation == Interpolation::kStep) {
    if (rotation) normalise(result);
    return result;
  }
  const double length = double{keys.seconds[next]} - double{keys.seconds[key]};
  const double t = (seconds - double{keys.seconds[key]}) / length;
  if (!cubic) return linear(std::move(result), numbers(next, 1), t, rotation);
  // C.5, cubic spline interpolation.
  const std::vector<double> leaving = numbers(key, 2), entering = numbers(next, 0),
                            to = numbers(next, 1);
  const double t2 = t * t, t3 = t2 * t;
  for (size_t i = 0; i < width; ++i) {
    result[i] = (2 * t3 - 3 * t2 + 1) * result[i] + length * (t3 - 2 * t2 + t) * leaving[i] +
                (-2 * t3 + 3 * t2) * to[i] + length * (t3 - t2) * entering[i];
  }
  if (rotation) normalise(result);
  return result;
}

}  // namespace grisaille::scene
