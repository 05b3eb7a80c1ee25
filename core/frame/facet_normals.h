// SPDX-License-Identifier: MIT
// Normals where there is depth alone.
#pragma once

#include "core/image/image.h"
#include "core/scene/camera.h"

namespace grisaille::frame {

// Unit world normals, facing the camera, of what the pixels of a view depth lie on; three channels;
// 0 where there is sky, and where a pixel's neighbours tell of no surface. On each axis those three
// pixels in a row tell, with the pixel first, in the middle or last, that lie nearest to a plane:
// over a plane the inverse depth is linear.
image::Image facetNormals(const image::Image& viewDepth, const scene::Camera& camera);

}  // namespace grisaille::frame
