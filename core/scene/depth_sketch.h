// SPDX-License-Identifier: MIT
// A small picture of view depths, drawn on the CPU: what a camera sees, before any device starts.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/image/image.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"

namespace grisaille::scene {

// A triangle, relative to an origin.
struct Face {
  std::array<glm::dvec3, 3> corners;  // metres; counter-clockwise as seen from the front
  bool bothSides = false;             // false: its back is not drawn
};

// Calls `use` for each triangle of each instance. `origin`: world position, metres.
template <typename Use>
void forEachFace(const Scene& scene, const glm::dvec3& origin, Use&& use) {
  for (const Instance& instance : scene.instances) {
    const Primitive& primitive = scene.primitives[instance.primitive];
    glm::dmat4 place = instance.worldFromObject;
    place[3] -= glm::dvec4(origin, 0);
    const bool mirrored = glm::determinant(glm::dmat3(place)) < 0;
    Face face;
    face.bothSides = scene.materials[primitive.material].doubleSided;
    for (uint32_t i = 0; i < primitive.indexCount; i += 3) {
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t index = scene.indices[primitive.firstIndex + i + k];
        face.corners[mirrored ? 2 - k : k] =
            glm::dvec3(place * glm::dvec4(glm::dvec3(scene.positions[index]), 1));
      }
      use(face);
    }
  }
}

// Draws faces one by one, with the rules of the renderer: the nearest one at a pixel's centre wins,
// and nothing before the near plane is drawn. Masks of materials count as solid.
class DepthSketch {
 public:
  // The origin of the faces is that of the camera's eye and target.
  DepthSketch(const Camera& camera, uint32_t width, uint32_t height);

  void draw(const Face& face);

  // View depths in metres; 0: no surface.
  image::Image depth() const;
  // Share of the pixels with a surface at this view depth, metres, or beyond.
  double covered(double least = 0) const;
  // Share of the pixels where the back of a face, which is not drawn, lies before what is drawn.
  double throughBacks() const;
  // Number of faces that are the nearest at a pixel.
  size_t visibleFaces() const;

 private:
  struct Corner {
    double x, y;     // pixels from the top left corner
    double inverse;  // 1 / view depth
  };
  // Calls `use` with each pixel whose centre lies in the triangle, of positive area, and with the
  // inverse of its view depth there.
  template <typename Use>
  void fill(const Corner& a, const Corner& b, const Corner& c, Use&& use) const;

  glm::dmat3 viewFromWorld_;
  glm::dvec3 eye_;
  double near_;
  glm::dvec2 slope_;  // half the picture's width and height at 1 m view depth, metres
  uint32_t width_, height_;
  std::vector<double> inverse_;  // 1 / view depth; 0: no surface
  std::vector<double> undrawn_;  // the same of the backs that are not drawn
  std::vector<uint32_t> owner_;  // number of the face at each pixel, from 1; 0: no surface
  uint32_t drawn_ = 0;           // number of faces
};

// The view depths of a scene.
image::Image sketchDepth(const Scene& scene, const Camera& camera, uint32_t width, uint32_t height);

}  // namespace grisaille::scene
