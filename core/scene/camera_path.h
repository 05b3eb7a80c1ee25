// SPDX-License-Identifier: MIT
// A camera path and its files: JSON with `cameras`, two or more cameras in the format of camera
// files, and `frames`, the number of pictures from the first camera to the last.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/scene/camera.h"

namespace grisaille::scene {

constexpr uint32_t kMostPathFrames = 10000;

struct CameraPath {
  std::vector<Camera> keys;  // at least 2
  uint32_t frames = 2;       // 2 ... kMostPathFrames
};

// The camera after a share of the path, 0 ... 1. Every pair of neighbouring keys takes an equal
// share; between them eye, target and field of view are interpolated linearly. Other fields come
// from the earlier key. Throws kCameraInvalid for an invalid camera: its eye may meet its target.
// keys: at least 2
Camera cameraAt(const std::vector<Camera>& keys, double share);

// Returns one camera per frame. Frame 0 is the first key, the last frame the last key. Throws
// kCameraInvalid for keys or frames out of range, and for a frame with an invalid camera; the
// message has the frame's number.
std::vector<Camera> camerasOf(const CameraPath& path);

// The text of a camera path file: parseCameraPath() reads it back to the same path, bit for bit.
std::string cameraPathJson(const CameraPath& path);

// Parses the text of a camera path file. Throws kCameraUnreadable, kCameraInvalid. `name` prefixes
// the messages.
CameraPath parseCameraPath(std::string_view text, const std::string& name);

// Reads and parses a camera path file. Throws the errors of readCameraText() and parseCameraPath(),
// with the path.
CameraPath loadCameraPath(const std::string& path);

}  // namespace grisaille::scene
