// SPDX-License-Identifier: MIT
// Data that the CPU prepares for a draw: mip levels, transforms, culling.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/gpu/types.h"
#include "core/image/image.h"
#include "core/scene/scene.h"
#include "core/scene/view.h"

namespace grisaille::frame {

// All mip levels down to 1x1, RGBA with sRGB colour, averaged in linear light. Level 0 is the
// image.
std::vector<std::vector<uint8_t>> mipChain(const image::Image8& image);

// scene::normalMap(), scaled to lengths near 1.
glm::dmat4 normalTransform(const glm::dmat3& linear);

// Transforms in double precision, from world axes with the origin at the camera, and to them.
glm::dmat4 clipFromCamera(const scene::View& view);
glm::dmat4 cameraFromObject(const glm::dmat4& worldFromObject, const glm::dvec3& eye);

// False if all corners of the box lie outside one side plane of the frustum. The clipper handles
// the near plane.
bool mayBeSeen(const scene::Bounds& bounds, const glm::dmat4& clipFromObject);

// The faces of a visible surface that are not drawn.
gpu::Cull cullOf(const scene::Material& material, const glm::dmat4& worldFromObject);

}  // namespace grisaille::frame
