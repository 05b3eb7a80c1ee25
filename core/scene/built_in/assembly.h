// SPDX-License-Identifier: MIT
// Collects the parts of a built-in scene.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "core/image/image.h"
#include "core/scene/camera.h"
#include "core/scene/mesh_builder.h"
#include "core/scene/scene.h"

namespace grisaille::scene {

// Crease cosines of addPrimitive(): edges are sharp from 35 degrees, from 60, from 75, or never.
constexpr double kCrease35 = 0.819, kCrease60 = 0.5, kCrease75 = 0.259, kNoCrease = -1;

class Assembly {
 public:
  explicit Assembly(const char* name) { scene_.name = name; }

  // Add a material and return its index. `cloth`: of sheets, which show both sides. `foliage`: of
  // cards with holes; its texture has the colour.
  uint32_t plain(const char* name, const glm::vec3& colour);
  uint32_t cloth(const char* name, const glm::vec3& colour);
  uint32_t foliage(const char* name, image::Image8 texels);

  // Adds a primitive and returns its index; place() shows it.
  uint32_t add(const Solid& solid, uint32_t material, double crease = kCrease35);
  void place(uint32_t primitive, const glm::dmat4& transform = glm::dmat4(1));
  // Shows a solid once, where it is.
  void put(const Solid& solid, uint32_t material, double crease = kCrease35) {
    place(add(solid, material, crease));
  }

  Scene finish(const Camera& camera);

 private:
  Scene scene_;
};

}  // namespace grisaille::scene
