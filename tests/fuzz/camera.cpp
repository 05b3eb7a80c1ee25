// SPDX-License-Identifier: MIT
// Camera files: single cameras and camera paths.
#include <cmath>

#include "core/scene/camera.h"
#include "core/scene/camera_path.h"
#include "core/scene/view.h"
#include "tests/fuzz/fuzz.h"

namespace grisaille::fuzz {
namespace {

template <typename Matrix>
void requireFinite(const Matrix& matrix) {
  for (int i = 0; i < Matrix::length(); ++i) {
    for (int j = 0; j < Matrix::length(); ++j) require(std::isfinite(matrix[i][j]));
  }
}

void requireSound(const scene::Camera& camera) {
  scene::validate(camera);
  requireFinite(scene::worldFromView(camera));
  requireFinite(scene::clipFromView(scene::viewOf(camera, {16, 9})));
  const std::string text = scene::cameraJson(camera);
  require(scene::cameraJson(scene::parseCamera(text, "again")) == text);
}

}  // namespace
}  // namespace grisaille::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace grisaille;
  const std::string_view text = fuzz::textOf(data, size);
  fuzz::accepted({ErrorId::kCameraUnreadable, ErrorId::kCameraInvalid},
                 [&] { fuzz::requireSound(scene::parseCamera(text, "input")); });
  scene::CameraPath path;
  const bool isPath = fuzz::accepted({ErrorId::kCameraUnreadable, ErrorId::kCameraInvalid},
                                     [&] { path = scene::parseCameraPath(text, "input"); });
  if (!isPath) return 0;
  const auto cameras = scene::camerasOf(path);
  fuzz::require(cameras.size() == path.frames);
  fuzz::requireSound(cameras.front());
  fuzz::requireSound(cameras.back());
  return 0;
}
