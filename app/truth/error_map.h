// SPDX-License-Identifier: MIT
// Errors of a visibility as colours.
#pragma once

#include <glm/glm.hpp>

#include "core/image/image.h"

namespace grisaille::app::truth {

// Of visibility, either way: from here on the colour is full, where nothing else is asked for.
constexpr float kFullError = 0.25f;

// White where nothing is wrong, blue where it is too dark, orange where it is too bright; as
// encoded. Grey where the error is not known (NaN).
glm::vec3 errorColor(float error, float full = kFullError);

// shown - truth of pictures of one channel and one size; NaN where either is no number.
image::Image errorsOf(const image::Image& shown, const image::Image& truth);

// The colours of a picture of errors.
image::Image errorMap(const image::Image& errors, float full = kFullError);

}  // namespace grisaille::app::truth
