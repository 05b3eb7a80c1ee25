// SPDX-License-Identifier: MIT
// What the host prepares for a draw: texture levels, the transform of normals.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/image/image.h"

namespace grisaille::frame {

// All levels down to 1x1, RGBA with sRGB colour, averaged in linear light; the top one is the
// image.
std::vector<std::vector<uint8_t>> mipChain(const image::Image8& image);

// One level of the alpha channel, one byte a texel.
std::vector<std::vector<uint8_t>> alphaAlone(const image::Image8& image);

// The transform of normals under a linear map: its cofactor matrix, which is the inverse transpose
// up to scale and exists for flat maps too; turned so that a mirror does not flip normals.
glm::dmat4 normalTransform(const glm::dmat3& linear);

}  // namespace grisaille::frame
