// SPDX-License-Identifier: MIT
// A small world seen by cameras of every kind: a floor, a wall and a ball, traced in double
// precision. The projections that hosts would have drawn it with.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "grisaille/host.hpp"

namespace grisaille::tests {

struct Eye {
  glm::dmat4 viewFromWorld = glm::dmat4(1);
  double angle = 0;   // angle that the height spans, radians; 0: orthographic
  double height = 0;  // metres, if orthographic
  // How far the picture's centre lies right of the view axis and above it, in widths and heights.
  glm::dvec2 shift = glm::dvec2(0);
};

// A renderer's conventions for clip space. y is up.
struct Clip {
  double near = 0.25, far = 0;  // metres; 0: infinite
  bool reversed = false;
  bool fromMinusOne = false;  // clip z from -1 to 1
};

// The matrix from view to clip space.
inline glm::dmat4 projectionOf(const Eye& eye, double aspect, const Clip& clip) {
  const double half = eye.angle > 0 ? std::tan(eye.angle / 2) : eye.height / 2;
  glm::dmat4 matrix(0);
  matrix[0][0] = 1 / (half * aspect);
  matrix[1][1] = 1 / half;
  // Depth from 0 to 1 is a + b / view depth or, orthographic, a + b * view depth.
  double a = 1, b = -clip.near;
  if (eye.angle > 0 && clip.far > 0) {
    a = clip.far / (clip.far - clip.near);
    b = -clip.near * clip.far / (clip.far - clip.near);
  } else if (eye.angle == 0) {
    a = -clip.near / (clip.far - clip.near);
    b = 1 / (clip.far - clip.near);
  }
  if (clip.reversed) a = 1 - a, b = -b;
  if (clip.fromMinusOne) a = 2 * a - 1, b = 2 * b;
  if (eye.angle > 0) {
    matrix[2] = glm::dvec4(2 * eye.shift.x, 2 * eye.shift.y, -a, -1);
    matrix[3] = glm::dvec4(0, 0, b, 0);
  } else {
    matrix[2][2] = -b;
    matrix[3] = glm::dvec4(-2 * eye.shift.x, -2 * eye.shift.y, a, 1);
  }
  return matrix;
}

inline host::Camera cameraOf(const Eye& eye, const glm::dmat4& projection, const Clip& clip) {
  return {
      &eye.viewFromWorld[0][0], &projection[0][0],
      clip.fromMinusOne ? GRISAILLE_HOST_CLIP_MINUS_ONE_TO_ONE : GRISAILLE_HOST_CLIP_ZERO_TO_ONE};
}

// Pictures with rows from the top.
struct Seen {
  uint32_t width = 0, height = 0;
  std::vector<double> view, distance;  // metres; 0: sky
  std::vector<glm::dvec3> normal;      // world
};

// What a depth texture holds at pixel i, if `projection` drew it from `nearer` metres nearer.
inline float depthValue(const Seen& seen, size_t i, grisaille_host_depth kind, const Clip& clip,
                        const glm::dmat4& projection, double nearer = 0) {
  if (kind == GRISAILLE_HOST_DEPTH_VIEW) return static_cast<float>(seen.view[i]);
  if (kind == GRISAILLE_HOST_DEPTH_DISTANCE) return static_cast<float>(seen.distance[i]);
  if (seen.view[i] == 0) return clip.reversed ? 0 : 1;
  const glm::dvec4 p = projection * glm::dvec4(0, 0, nearer - seen.view[i], 1);
  return static_cast<float>(clip.fromMinusOne ? (p.z / p.w + 1) / 2 : p.z / p.w);
}

// First hit of a ray, and its distance in lengths of the ray; 1e30: no hit. The floor is infinite.
struct Met {
  double along = 1e30;
  glm::dvec3 normal = glm::dvec3(0);  // world space, out of the solids
};

inline Met meet(const glm::dvec3& origin, const glm::dvec3& ray) {
  Met met;
  const auto plane = [&](int axis, double at) {
    const double t = (at - origin[axis]) / ray[axis];
    if (!(t > 0 && t < met.along)) return;
    met.along = t;
    met.normal = glm::dvec3(0);
    met.normal[axis] = 1;
  };
  plane(1, 0);
  plane(2, -1);
  const glm::dvec3 centre(0.2, 0.5, -0.2), to = origin - centre;
  const double radius = 0.5, a = glm::dot(ray, ray), b = glm::dot(to, ray),
               c = glm::dot(to, to) - radius * radius, root = b * b - a * c;
  const double t = root > 0 ? (-b - std::sqrt(root)) / a : -1;
  if (t > 0 && t < met.along) met = {t, (origin + t * ray - centre) / radius};
  return met;
}

// `meetWorld`: a function such as meet().
template <typename World>
Seen see(const Eye& eye, uint32_t width, uint32_t height, World&& meetWorld) {
  Seen seen{.width = width, .height = height, .view = {}, .distance = {}, .normal = {}};
  const glm::dmat4 world = glm::inverse(eye.viewFromWorld);
  const double half = eye.angle > 0 ? std::tan(eye.angle / 2) : eye.height / 2;
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const glm::dvec2 place(2 * half / height * (x + 0.5 - 0.5 * width),
                             2 * half / height * (0.5 * height - y - 0.5));
      const glm::dvec2 offset = 2 * half * eye.shift * glm::dvec2(double{1} * width / height, 1);
      const glm::dvec2 at = place + offset;
      const glm::dvec3 from = eye.angle > 0 ? glm::dvec3(0) : glm::dvec3(at, 0);
      const glm::dvec3 along = eye.angle > 0 ? glm::dvec3(at, -1) : glm::dvec3(0, 0, -1);
      const glm::dvec3 origin(world * glm::dvec4(from, 1)), ray(world * glm::dvec4(along, 0));
      const Met met = meetWorld(origin, ray);
      const double best = met.along;
      const bool sky = best > 1e6 || (origin + best * ray).y > 2.5;
      seen.view.push_back(sky ? 0 : best);
      seen.distance.push_back(sky ? 0 : best * glm::length(ray));
      seen.normal.push_back(sky ? glm::dvec3(0) : met.normal);
    }
  }
  return seen;
}

// View-space position of the surface at pixel i.
inline glm::dvec3 placeOf(const Eye& eye, const Seen& seen, size_t i) {
  const double half = eye.angle > 0 ? std::tan(eye.angle / 2) : eye.height / 2;
  const double x = static_cast<double>(i % seen.width) + 0.5;
  const double y = static_cast<double>(i / seen.width) + 0.5;
  const glm::dvec2 at =
      2 * half / seen.height * glm::dvec2(x - 0.5 * seen.width, 0.5 * seen.height - y) +
      2 * half * eye.shift * glm::dvec2(double{1} * seen.width / seen.height, 1);
  return {at * (eye.angle > 0 ? seen.view[i] : 1.0), -seen.view[i]};
}

inline Seen see(const Eye& eye, uint32_t width, uint32_t height) {
  return see(eye, width, height, meet);
}

}  // namespace grisaille::tests
