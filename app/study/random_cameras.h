// SPDX-License-Identifier: MIT
// Draws random cameras that see what a user would look at.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image/image.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"

namespace grisaille::app::study {

// Visibility below which a pixel counts as occluded.
constexpr float kOccluded = 0.98f;

// Share of the pixels of a picture of visibilities that are occluded; NaN counts as not occluded.
double occludedShare(const image::Image& visibility);

struct RandomCameraDesc {
  scene::Camera like = {};  // gives angle of view and size, and the farthest near plane
  double radius = 0.5;      // how far an occluder counts, metres
  size_t count = 3;
  uint32_t seed = 1;
};

// Returns at most `count` cameras; fewer if some hundred tries per camera find no more. A seed
// always gives the same cameras. Every camera satisfies:
//
// - The eye is in no body: the generalised winding number there is below a half, and most surfaces
//   around it show their front.
// - No surface around the eye is closer than 1/100 of the scene's diagonal, and half of the
//   surfaces in the picture are farther than five times that.
// - At most 5 % of the surfaces in the picture are seen through the back of another surface.
// - At least a third of the pixels have an occluder within `radius`: a visibility below kOccluded.
//
// It first draws eyes inside the scene's bounds, from which half of all directions hit the scene. A
// scene with hardly any such places, such as a single object, is seen from outside.
std::vector<scene::Camera> randomCameras(const scene::Scene& scene, const RandomCameraDesc& desc);

}  // namespace grisaille::app::study
