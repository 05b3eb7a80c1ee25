// SPDX-License-Identifier: MIT
// A camera's way, and its files: JSON with `cameras`, two or more cameras as camera files have
// them, and `frames`, how many pictures are taken from the first to the last.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/scene/camera.h"

namespace grisaille::scene {

constexpr uint32_t kMostPathFrames = 10000;

struct CameraPath {
  std::vector<Camera> keys;  // 2 at least
  uint32_t frames = 2;       // 2 ... kMostPathFrames
};

// One camera a frame. Frame 0 is the first key and the last frame the last one; from key to key, at
// equal shares of the frames, eye, target and field of view run linearly; the rest is of the key
// before. Throws kCameraInvalid for keys or frames out of range and, with its number, for a frame
// whose camera is not valid: its eye may run through its target.
std::vector<Camera> camerasOf(const CameraPath& path);

// A path file's text. Throws kCameraUnreadable, kCameraInvalid, with `name` before the message.
CameraPath parseCameraPath(std::string_view text, const std::string& name);

// Throws as parseCameraPath() does, with the path.
CameraPath loadCameraPath(const std::string& path);

}  // namespace grisaille::scene
