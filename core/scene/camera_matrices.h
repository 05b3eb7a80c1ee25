// SPDX-License-Identifier: MIT
// Converts cameras to and from the view matrices of OpenEXR files.
#pragma once

#include "core/image/image.h"
#include "core/scene/camera.h"

namespace grisaille::scene {

// In the result, camera space looks along -z with y up; NDC runs from -1 to 1 with y up.
// width, height: size of the picture, pixels
image::ViewMatrices matricesOf(const Camera& camera, uint32_t width, uint32_t height);

// Returns the camera of a picture from matrices of any renderer. Camera space may look either way
// along z; NDC may start at -1 or 0, with y up or down. The projection may be orthographic, and its
// axis may pass anywhere through the picture. Size, near and far plane of the result keep their
// defaults.
// width, height: size of the picture, pixels
// name: for messages
// Throws kPictureMatrices if the matrices are no camera's, if the pixels are not square, if the
// picture is mirrored or sheared, or if the axis is so far from the centre that NDC may start at
// either -1 or 0.
Camera cameraOf(const image::ViewMatrices& matrices, uint32_t width, uint32_t height,
                const std::string& name);

}  // namespace grisaille::scene
