// SPDX-License-Identifier: MIT
// A pinhole camera and its files: JSON with `eye`, `target` (metres, world), optional `up` (default
// +y), `fovy_degrees`, optional `size` [width, height] and optional `near` (metres).
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>

#include "core/scene/bounds.h"

namespace grisaille::scene {

struct Camera {
  glm::dvec3 eye = glm::dvec3(0, 0, 1);
  glm::dvec3 target = glm::dvec3(0);
  glm::dvec3 up = glm::dvec3(0, 1, 0);
  double fovyDegrees = 60;          // of the whole height, 0.01 ... 170
  glm::uvec2 size = glm::uvec2(0);  // pixels; 0: not given
  double nearPlane = 0.01;          // metres, over 0
};

// Throws kCameraInvalid with the field's name: non-finite numbers, eye = target, up along the view
// direction, an angle out of range.
void validate(const Camera& camera);

// What a file of cameras holds. Throws kCameraUnreadable where it is no regular file or over 1 MiB.
std::string readCameraText(const std::string& path);

// A camera file's text. Throws kCameraUnreadable, kCameraInvalid, with `name` before the message.
Camera parseCamera(std::string_view text, const std::string& name);

// Throws as parseCamera() does, with the path.
Camera loadCamera(const std::string& path);

// One line that parseCamera() reads back to the same camera, bit by bit.
std::string cameraJson(const Camera& camera);

// Writes the file aside and renames it. Throws kFileUnwritable.
void saveCamera(const Camera& camera, const std::string& path);

// The built-in atrium's own camera.
Camera atriumCamera();

// A camera that sees the whole of any scene, from outside its bounds.
Camera overviewCamera(const Bounds& bounds);

// The pinhole that stands for an orthographic camera, since frames and effects know pinholes alone:
// at the same axes, from so far behind that over the depth between the planes no length is wrong by
// more than about 1 part in 128, and no direction by more than about 0.6 degrees. View depths grow
// by what the near plane does. `height` and `width` of what is seen, metres; `far`: the far plane
// of `camera`, metres, finite. Its angle of view may be less than validate() takes.
Camera orthographicCamera(const Camera& camera, double height, double width, double far);

// Columns are the view axes in world space: right, up, backward.
glm::dmat3 worldFromView(const Camera& camera);

// Reversed depth, infinitely far: clip z = near, clip w = -view z.
glm::dmat4 clipFromView(const Camera& camera, double aspect);

// The world direction through a point of a picture of this size, (0, 0) its top left corner, as
// long as one unit of view depth.
glm::dvec3 pixelDirection(const Camera& camera, uint32_t width, uint32_t height,
                          const glm::dvec2& point);

}  // namespace grisaille::scene
