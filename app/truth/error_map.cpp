// SPDX-License-Identifier: MIT
#include "app/truth/error_map.h"

#include <algorithm>
#include <cmath>

namespace grisaille::app::truth {

glm::vec3 errorColor(float error, float full) {
  if (!std::isfinite(error)) return glm::vec3(0.5f);
  const glm::vec3 dark(0.0f, 0.45f, 0.70f), bright(0.90f, 0.62f, 0.0f);  // Okabe and Ito
  return glm::mix(glm::vec3(1), error < 0 ? dark : bright, std::min(std::abs(error) / full, 1.0f));
}

image::Image errorsOf(const image::Image& shown, const image::Image& truth) {
  image::Image errors = shown;
  for (size_t i = 0; i < errors.pixels.size(); ++i) errors.pixels[i] -= truth.pixels[i];
  return errors;
}

image::Image errorMap(const image::Image& errors, float full) {
  image::Image map{errors.width, errors.height, 3, {}};
  map.pixels.reserve(errors.pixels.size() * 3);
  for (const float error : errors.pixels) {
    const glm::vec3 color = errorColor(error, full);
    map.pixels.insert(map.pixels.end(), {color.r, color.g, color.b});
  }
  return map;
}

}  // namespace grisaille::app::truth
