// SPDX-License-Identifier: MIT
// Pictures of claims: a part, magnified, each pixel a square.
#pragma once

#include "core/image/image.h"
#include "core/trace/flicker.h"
#include "lab/claims/claims.h"

namespace grisaille::lab::claims {

// One channel: `low` is drawn black and `high` white, NaN light blue. Three or four: colour, linear
// light, drawn sRGB encoded.
image::Image8 pictureOf(const image::Image& picture, const PictureDesc& desc);

// What changes from one frame to the next at the same point of the world, against the truth: blue
// darker, orange brighter, full at `high`; grey where the point is not seen twice.
image::Image8 changePicture(const trace::FlickerFrame& now, const trace::FlickerFrame& then,
                            const PictureDesc& desc);

}  // namespace grisaille::lab::claims
