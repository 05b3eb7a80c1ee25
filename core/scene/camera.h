// SPDX-License-Identifier: MIT
// A camera and its files: JSON with `eye`, `target` (metres, world), optional `up` (default +y),
// `fovy_degrees` or `orthographic_height`, and the optional `shift` [x, y], `size` [width, height],
// `near` and `far`. core/scene/view.h says which position a pixel shows.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>

namespace grisaille::scene {

struct Camera {
  glm::dvec3 eye = glm::dvec3(0, 0, 1);
  glm::dvec3 target = glm::dvec3(0);
  glm::dvec3 up = glm::dvec3(0, 1, 0);
  double fovyDegrees = 60;        // perspective: vertical field of view, 0.01 ... 170
  double orthographicHeight = 0;  // metres that the height spans, up to 1e9; 0: perspective
  // How far the picture's centre lies to the right of the view axis and above it, as shares of the
  // picture's width and height, -10 ... 10: for tiles, for each eye of a headset, or for jitter.
  glm::dvec2 shift = glm::dvec2(0);
  glm::uvec2 size = glm::uvec2(0);  // pixels; 0: not given
  double nearPlane = 0.01;          // metres, above 0, at most 1e9
  double farPlane = 1000;           // orthographic: metres, above nearPlane, at most 1e9

  bool operator==(const Camera&) const = default;
};

// Throws kCameraInvalid with the name of the wrong field: numbers that are not finite, eye equal to
// target, up along the view direction, or a field out of range.
void validate(const Camera& camera);

// Reads the text of a camera or camera path file. Throws kCameraUnreadable if `path` is not a
// regular file or is larger than 1 MiB.
std::string readCameraText(const std::string& path);

// Parses the text of a camera file. Throws kCameraUnreadable, kCameraInvalid. `name` prefixes the
// messages.
Camera parseCamera(std::string_view text, const std::string& name);

// Reads and parses a camera file. Throws the errors of readCameraText() and parseCamera(), with the
// path.
Camera loadCamera(const std::string& path);

// Returns one line of JSON. parseCamera() reads it back to the same camera, bit for bit.
std::string cameraJson(const Camera& camera);

// Writes a temporary file, then renames it to `path`. Throws kFileUnwritable.
void saveCamera(const Camera& camera, const std::string& path);

// The default camera of the built-in atrium.
Camera atriumCamera();

// The columns of the result are the view axes in world space: right, up, backward.
glm::dmat3 worldFromView(const Camera& camera);

}  // namespace grisaille::scene
