// SPDX-License-Identifier: MIT
// Pictures of claims: a magnified crop, with each pixel drawn as a square.
#pragma once

#include "core/image/image.h"
#include "core/trace/flicker.h"
#include "lab/claims/claims.h"

namespace grisaille::lab::claims {

// One channel: `low` is drawn black, `high` white and NaN light blue. Three or four channels:
// linear colour, drawn sRGB encoded.
image::Image8 pictureOf(const image::Image& picture, const PictureDesc& desc);

// The change of the error from one frame to the next at the same point of the world: blue darker,
// orange brighter, full colour at `high`; grey if the point is not seen in both frames.
image::Image8 changePicture(const trace::FlickerFrame& now, const trace::FlickerFrame& then,
                            const PictureDesc& desc);

}  // namespace grisaille::lab::claims
