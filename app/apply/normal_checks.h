// SPDX-License-Identifier: MIT
// Finds normals that cannot be right, by their lengths, their directions to the camera, and the
// facets that the depth shows.
#pragma once

#include <string>

#include "app/apply/picture_checks.h"

namespace grisaille::app {

struct NormalForm {
  bool view = false;           // --normal-space view
  bool unsignedCodes = false;  // --normal-encoding unsigned
};

// Decodes and turns a picture's normals to world space, with the lengths that they have. Checks a
// sample of the surface pixels first. `file` is for messages.
//
// Throws kPictureNormal if half of the normals
//
// - have a length of 0,
// - are encoded from 0 to 1 without --normal-encoding unsigned, or the other way round,
// - have lengths that vary, as those of colours or positions do,
// - face away from the camera,
//
// and if they fit the depth's facets far better in the other space, or with other axes. Warns if
// they fit somewhat better so, of lengths other than 1, and of normals that fit the facets in no
// way.
void takeNormals(image::Image& normals, const NormalForm& form, const Surfaces& surfaces,
                 const std::string& file, Warnings& warnings);

}  // namespace grisaille::app
