// SPDX-License-Identifier: MIT
// Shows errors of a visibility as colours.
#pragma once

#include <glm/glm.hpp>

#include "core/image/image.h"

namespace grisaille::app::truth {

// The error of visibility, positive or negative, that has the full colour by default.
constexpr float kFullError = 0.25f;

// The sRGB-encoded colour of an error: white for 0, blue for too dark, orange for too bright, grey
// for an unknown error (NaN). `full`: the error of full colour.
glm::vec3 errorColor(float error, float full = kFullError);

// shown - truth, for pictures of one channel and the same size; NaN where either is NaN.
image::Image errorsOf(const image::Image& shown, const image::Image& truth);

// Maps each pixel of `errors` to its errorColor().
image::Image errorMap(const image::Image& errors, float full = kFullError);

}  // namespace grisaille::app::truth
