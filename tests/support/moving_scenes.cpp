// SPDX-License-Identifier: MIT
#include "tests/support/moving_scenes.h"

#include "tests/support/scenes.h"

namespace grisaille::tests {

constexpr size_t kFaces = 6;

scene::Scene boxOnFloor(double x) {
  scene::Scene scene = cornerScene(20);
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      glm::vec3 normal(0), u(0), v(0);
      normal[axis] = side * 0.3f;
      u[(axis + 1) % 3] = 0.3f;
      v[(axis + 2) % 3] = side * 0.3f;
      addQuad(scene, {normal - u - v, normal + u - v, normal + u + v, normal - u + v},
              normal / 0.3f);
    }
  }
  moveBox(scene, x);
  return scene;
}

void moveBox(scene::Scene& scene, double x) {
  for (size_t i = scene.instances.size() - kFaces; i < scene.instances.size(); ++i) {
    scene.instances[i].worldFromObject[3] = glm::dvec4(x, 0.3, 0.5, 1);
  }
  scene::computeBounds(scene);
  ++scene.poses;
}

}  // namespace grisaille::tests
