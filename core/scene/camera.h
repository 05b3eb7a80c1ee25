// SPDX-License-Identifier: MIT
// A pinhole camera and its files: JSON with `eye`, `target` (metres, world), optional `up` (default
// +y), `fovy_degrees`, optional `size` [width, height] and optional `near` (metres).
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>

namespace grisaille::scene {

struct Camera {
  glm::dvec3 eye = glm::dvec3(0, 0, 1);
  glm::dvec3 target = glm::dvec3(0);
  glm::dvec3 up = glm::dvec3(0, 1, 0);
  double fovyDegrees = 60;          // vertical field of view, 0.01 ... 170
  glm::uvec2 size = glm::uvec2(0);  // pixels; 0: not given
  double nearPlane = 0.01;          // metres, above 0, at most 1e9
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

// Approximates an orthographic camera by a distant pinhole, since frames and effects support only
// pinholes. The pinhole keeps the axes and moves back. Between the near and the far plane, lengths
// are wrong by at most about 1 part in 128, directions by at most about 0.6 degrees. View depths
// grow by as much as the near plane.
// camera: eye, axes and near plane; its angle of view is not used
// height, width: size of the view, metres
// far: far plane of `camera`, metres, finite
// The angle of view of the result may be below the minimum of validate().
Camera orthographicCamera(const Camera& camera, double height, double width, double far);

// The columns of the result are the view axes in world space: right, up, backward.
glm::dmat3 worldFromView(const Camera& camera);

// Projection with reversed depth and an infinite far plane: clip z = near, clip w = -view z.
glm::dmat4 clipFromView(const Camera& camera, double aspect);

// Returns the world direction through a point of a picture.
// width, height: size of the picture, pixels
// point: pixels from the top left corner
// The length of the direction is such that its view depth is 1.
glm::dvec3 pixelDirection(const Camera& camera, uint32_t width, uint32_t height,
                          const glm::dvec2& point);

}  // namespace grisaille::scene
