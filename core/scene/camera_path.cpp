// SPDX-License-Identifier: MIT
#include "core/scene/camera_path.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/scene/camera_json.h"

namespace grisaille::scene {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::string& why) {
  throw Error(ErrorId::kCameraInvalid, "{}", why);
}

uint32_t framesOf(const json& value) {
  const double frames = value.is_number() ? value.get<double>() : 0;
  if (!(frames >= 2 && frames <= kMostPathFrames) || frames != std::floor(frames)) {
    refuse(fmt::format("frames is not a whole number from 2 to {}", kMostPathFrames));
  }
  return static_cast<uint32_t>(frames);
}

void setKey(CameraPath& path, const std::string& key, const json& value) {
  if (key == "frames") {
    path.frames = framesOf(value);
  } else if (key == "cameras") {
    if (!value.is_array()) refuse("cameras is not an array");
    for (size_t i = 0; i < value.size(); ++i) {
      path.keys.push_back(cameraFromJson(value[i], fmt::format("cameras[{}]", i)));
    }
  } else {
    refuse(
        fmt::format("\"{}\" is not a key of a camera path; the keys are cameras and frames", key));
  }
}

}  // namespace

Camera cameraAt(const std::vector<Camera>& keys, double share) {
  const size_t last = keys.size() - 1;
  const double at = static_cast<double>(last) * share;
  const size_t before = std::min(static_cast<size_t>(at), last - 1);
  const double part = at - static_cast<double>(before);
  const Camera &a = keys[before], &b = keys[before + 1];
  Camera camera = part == 1 ? b : a;
  camera.eye = glm::mix(a.eye, b.eye, part);
  camera.target = glm::mix(a.target, b.target, part);
  camera.fovyDegrees = glm::mix(a.fovyDegrees, b.fovyDegrees, part);
  // Between cameras of two kinds, the kind changes at the key.
  if (a.orthographicHeight > 0 && b.orthographicHeight > 0) {
    camera.orthographicHeight = glm::mix(a.orthographicHeight, b.orthographicHeight, part);
  }
  camera.shift = glm::mix(a.shift, b.shift, part);
  validate(camera);
  return camera;
}

std::vector<Camera> camerasOf(const CameraPath& path) {
  if (path.keys.size() < 2) refuse("cameras holds fewer than two cameras");
  if (path.frames < 2 || path.frames > kMostPathFrames) {
    refuse(fmt::format("frames is not from 2 to {}", kMostPathFrames));
  }
  std::vector<Camera> cameras;
  for (uint32_t i = 0; i < path.frames; ++i) {
    try {
      cameras.push_back(cameraAt(path.keys, double{1} * i / (path.frames - 1)));
    } catch (const Error& error) {
      throw Error(error.id(), "frame {}: {}", i, error.detail());
    }
  }
  return cameras;
}

std::string cameraPathJson(const CameraPath& path) {
  std::string keys;
  for (const Camera& key : path.keys) keys += (keys.empty() ? "\n " : ",\n ") + cameraJson(key);
  return fmt::format("{{\"frames\": {},\n\"cameras\": [{}]}}\n", path.frames, keys);
}

CameraPath parseCameraPath(std::string_view text, const std::string& name) {
  const json document = json::parse(text, nullptr, false);
  if (document.is_discarded()) {
    throw Error(ErrorId::kCameraUnreadable, "{}: the file is not JSON", name);
  }
  try {
    if (!document.is_object()) refuse("the file does not hold a JSON object");
    CameraPath path;
    for (const auto& [key, value] : document.items()) setKey(path, key, value);
    for (const char* key : {"cameras", "frames"}) {
      if (!document.contains(key)) refuse(fmt::format("{} is missing", key));
    }
    camerasOf(path);
    return path;
  } catch (const Error& error) {
    throw Error(error.id(), "{}: {}", name, error.detail());
  }
}

CameraPath loadCameraPath(const std::string& path) {
  return parseCameraPath(readCameraText(path), path);
}

}  // namespace grisaille::scene
