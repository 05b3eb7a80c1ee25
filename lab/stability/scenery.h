// SPDX-License-Identifier: MIT
// What a case of the sweep looks at: small scenes, of any size and at any place in the world, and
// pictures of depths that no scene has.
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

// Coordinates of a scenery are metres before it is scaled and moved.
struct Scenery {
  enum class Kind {
    kPlane,        // y = 0, facing up, 2000 a side
    kCorner,       // a floor and the wall z = 0 that rises from it
    kRoom,         // the corner with boxes and a pole, which are coloured and have insides
    kWires,        // before a wall, 0.2 mm and 2 mm thick
    kPair,         // a wall, and half before it a sheet 1 micrometre nearer
    kTriangle,     // one, alone
    kSky,          // behind the camera
    kNoNormals,    // the room, its normals of length 0
    kBackNormals,  // the room, its normals turned away
    // Pictures, of the camera's size:
    kAtNear,   // all at depth 1, the near plane
    kAtFar,    // nearly sky: 9e8 m
    kMixed,    // depth 0, depth 1 and what is between, pixel by pixel
    kNormless  // a room's depths with normals of length 0, and depth 0
  };
  Kind kind = Kind::kRoom;
  double scale = 1;
  glm::dvec3 origin = glm::dvec3(0);  // world

  bool isPicture() const { return kind >= Kind::kAtNear; }
  glm::dvec3 placed(const glm::dvec3& local) const { return origin + scale * local; }
};

const char* nameOf(Scenery::Kind kind);

// Of a kind that is no picture.
scene::Scene makeScene(const Scenery& scenery);

// Of a kind that is one. Normals face the camera.
frame::Pictures makePictures(const Scenery& scenery, const scene::Camera& camera,
                             const glm::uvec2& size);

// Shots at a corner or a room from where every muzzle sees the whole of a corner: directions,
// colours, and for some a range of their own.
std::vector<Shot> makeShots(const Scenery& scenery, size_t count, uint32_t seed);

// One shot. `range` in metres, 0: the effect's own.
Shot shotAt(const glm::dvec3& origin, const glm::dvec3& target, const glm::vec3& color,
            double range = 0);

}  // namespace grisaille::lab::stability
