// SPDX-License-Identifier: MIT
// Data that the CPU prepares for a draw: mip levels, the transform of normals.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/image/image.h"

namespace grisaille::frame {

// All mip levels down to 1x1, RGBA with sRGB colour, averaged in linear light. Level 0 is the
// image.
std::vector<std::vector<uint8_t>> mipChain(const image::Image8& image);

// scene::normalMap(), scaled to lengths near 1.
glm::dmat4 normalTransform(const glm::dmat3& linear);

}  // namespace grisaille::frame
