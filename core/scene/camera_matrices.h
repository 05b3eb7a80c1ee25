// SPDX-License-Identifier: MIT
// Cameras as the matrices that OpenEXR files hold.
#pragma once

#include "core/image/image.h"
#include "core/scene/camera.h"

namespace grisaille::scene {

// Camera space looks along -z with y up; NDC runs from -1 to 1 with y up.
image::ViewMatrices matricesOf(const Camera& camera, uint32_t width, uint32_t height);

// The camera of a picture of this size, from matrices of any renderer: camera space may look either
// way along z, NDC run from -1 or from 0, with y up or down. No size and no near plane. Throws
// kPictureMatrices for what is no pinhole whose axis goes through the picture's centre, or has
// pixels that are not square, or mirrors; `name` is for messages.
Camera cameraOf(const image::ViewMatrices& matrices, uint32_t width, uint32_t height,
                const std::string& name);

}  // namespace grisaille::scene
