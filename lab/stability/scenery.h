// SPDX-License-Identifier: MIT
// Sceneries for the cases of the sweep: small scenes, of any scale and at any place in the world,
// and depth pictures that no scene produces.
#pragma once

#include <glm/glm.hpp>
#include <random>
#include <string>
#include <vector>

#include "core/frame/picture_attachments.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "lab/paint/shot.h"

namespace grisaille::lab::stability {

// Coordinates of a scenery are in metres, before it is scaled and moved.
struct Scenery {
  enum class Kind {
    kPlane,        // the plane y = 0, facing up, 2000 m per side
    kCorner,       // a floor, and the wall z = 0 on it
    kRoom,         // the corner with boxes and a pole, coloured and closed on all sides
    kWires,        // wires 0.2 mm and 2 mm thick, in front of a wall
    kPair,         // a wall, and in front of half of it a sheet 1 micrometre nearer
    kTriangle,     // a single triangle
    kSky,          // a surface behind the camera: only sky is visible
    kNoNormals,    // the room, with normals of length 0
    kBackNormals,  // the room, with reversed normals
    // Pictures, of the camera's size:
    kAtNear,   // depth 1, the near plane, everywhere
    kAtFar,    // 9e8 m everywhere: nearly sky
    kMixed,    // depth 0, depth 1 and depths between, pixel by pixel
    kNormless  // a room's depths with normals of length 0, and depth 0
  };
  Kind kind = Kind::kRoom;
  double scale = 1;
  glm::dvec3 origin = glm::dvec3(0);  // world

  bool isPicture() const { return kind >= Kind::kAtNear; }
  glm::dvec3 placed(const glm::dvec3& local) const { return origin + scale * local; }
};

const char* nameOf(Scenery::Kind kind);

// `scenery` must not be a picture.
scene::Scene makeScene(const Scenery& scenery);

// `scenery` must be a picture. Normals face the camera.
frame::Pictures makePictures(const Scenery& scenery, const scene::Camera& camera,
                             const glm::uvec2& size);

// Random shots at a corner or a room. Each muzzle sees the whole corner. The shots differ in
// direction and colour, and some have their own range.
std::vector<Shot> makeShots(const Scenery& scenery, size_t count, uint32_t seed);

// One shot from `origin` towards `target`. `range` in metres; 0: the value of paint_range.
Shot shotAt(const glm::dvec3& origin, const glm::dvec3& target, const glm::vec3& color,
            double range = 0);

}  // namespace grisaille::lab::stability
