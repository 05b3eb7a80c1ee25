// SPDX-License-Identifier: MIT
#include "core/scene/camera.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/nearest.h"
#include "core/base/regular_file.h"
#include "core/scene/camera_json.h"

namespace grisaille::scene {
namespace {

using nlohmann::json;

constexpr uint32_t kLargestSize = 16384;  // pixels per side
constexpr uintmax_t kLargestFile = 1 << 20;

[[noreturn]] void refuse(std::string_view field, std::string_view why) {
  throw Error(ErrorId::kCameraInvalid, "{} {}", field, why);
}

double numberOf(const json& value, std::string_view field) {
  if (!value.is_number()) refuse(field, fmt::format("is {}, not a number", value.type_name()));
  return value.get<double>();
}

glm::dvec3 vectorOf(const json& value, std::string_view field) {
  if (!value.is_array() || value.size() != 3) refuse(field, "is not an array of three numbers");
  return {numberOf(value[0], field), numberOf(value[1], field), numberOf(value[2], field)};
}

glm::dvec2 shiftOf(const json& value) {
  if (!value.is_array() || value.size() != 2) refuse("shift", "is not an array of two numbers");
  return {numberOf(value[0], "shift"), numberOf(value[1], "shift")};
}

glm::uvec2 sizeOf(const json& value) {
  if (!value.is_array() || value.size() != 2) refuse("size", "is not an array of two numbers");
  glm::uvec2 size;
  for (int i = 0; i < 2; ++i) {
    const double side = numberOf(value[static_cast<size_t>(i)], "size");
    if (!(side >= 1 && side <= kLargestSize) || side != std::floor(side)) {
      refuse("size", fmt::format("holds {}, not a whole number from 1 to {}", side, kLargestSize));
    }
    size[i] = static_cast<uint32_t>(side);
  }
  return size;
}

json parse(std::string_view text, const std::string& name) {
  try {
    return json::parse(text);
  } catch (const json::exception& error) {
    throw Error(ErrorId::kCameraUnreadable, "{}: {}", name, error.what());
  }
}

[[noreturn]] void refuseKey(const std::string& key) {
  const std::string keys[] = {"eye",   "target", "up",   "fovy_degrees", "orthographic_height",
                              "shift", "size",   "near", "far"};
  const std::string near = nearest(key, keys);
  refuse(fmt::format("\"{}\"", key),
         fmt::format("is not a key of a camera{}{}", near.empty() ? "" : ", nearest is ", near));
}

void set(Camera& camera, const std::string& key, const json& value) {
  if (key == "eye") {
    camera.eye = vectorOf(value, key);
  } else if (key == "target") {
    camera.target = vectorOf(value, key);
  } else if (key == "up") {
    camera.up = vectorOf(value, key);
  } else if (key == "fovy_degrees") {
    camera.fovyDegrees = numberOf(value, key);
  } else if (key == "orthographic_height") {
    camera.orthographicHeight = numberOf(value, key);
    if (!(camera.orthographicHeight > 0)) refuse(key, "is not above 0");
  } else if (key == "shift") {
    camera.shift = shiftOf(value);
  } else if (key == "far") {
    camera.farPlane = numberOf(value, key);
  } else if (key == "size") {
    camera.size = sizeOf(value);
  } else if (key == "near") {
    camera.nearPlane = numberOf(value, key);
  } else {
    refuseKey(key);
  }
}

void requireFinite(const glm::dvec3& vector, std::string_view field) {
  for (int i = 0; i < 3; ++i) {
    // Products of larger coordinates could overflow.
    if (!(std::abs(vector[i]) <= 1e15)) refuse(field, "is not finite");
  }
}

}  // namespace

void validate(const Camera& camera) {
  requireFinite(camera.eye, "eye");
  requireFinite(camera.target, "target");
  requireFinite(camera.up, "up");
  if (!(camera.fovyDegrees >= 0.01 && camera.fovyDegrees <= 170)) {
    refuse("fovy_degrees", fmt::format("is {}, not from 0.01 to 170", camera.fovyDegrees));
  }
  if (!(camera.nearPlane > 0 && camera.nearPlane <= 1e9)) {
    refuse("near", fmt::format("is {}, not above 0 and at most 1e9", camera.nearPlane));
  }
  if (!(camera.orthographicHeight >= 0 && camera.orthographicHeight <= 1e9)) {
    refuse("orthographic_height", fmt::format("is {}, not at most 1e9", camera.orthographicHeight));
  }
  if (camera.orthographicHeight > 0 &&
      !(camera.farPlane > camera.nearPlane && camera.farPlane <= 1e9)) {
    refuse("far", fmt::format("is {}, not above near, {}, and at most 1e9", camera.farPlane,
                              camera.nearPlane));
  }
  if (!(std::abs(camera.shift.x) <= 10 && std::abs(camera.shift.y) <= 10)) {
    refuse("shift", "is not from -10 to 10");
  }
  if ((camera.size.x == 0) != (camera.size.y == 0) || camera.size.x > kLargestSize ||
      camera.size.y > kLargestSize) {
    refuse("size", fmt::format("is not from 1 to {} per side", kLargestSize));
  }
  const glm::dvec3 view = camera.target - camera.eye;
  const double distance = glm::length(view);
  // The difference of the coordinates must be far larger than their rounding errors.
  if (!(distance > 1e-12 * (1 + glm::length(camera.eye)))) refuse("target", "is at the eye");
  const double upLength = glm::length(camera.up);
  if (!(upLength > 1e-9)) refuse("up", "has no length");
  if (!(glm::length(glm::cross(view / distance, camera.up / upLength)) > 1e-6)) {
    refuse("up", "is along the view direction");
  }
}

std::string readCameraText(const std::string& path) {
  return readRegularFile(path, ErrorId::kCameraUnreadable, kLargestFile);
}

Camera cameraFromJson(const json& document, const std::string& name) {
  try {
    if (!document.is_object()) refuse("the file", "does not hold a JSON object");
    Camera camera;
    for (const auto& [key, value] : document.items()) set(camera, key, value);
    const bool orthographic = document.contains("orthographic_height");
    for (const char* key : {"eye", "target", "fovy_degrees"}) {
      if (document.contains(key) || (orthographic && key == std::string_view("fovy_degrees"))) {
        continue;
      }
      refuse(key, "is missing");
    }
    validate(camera);
    return camera;
  } catch (const Error& error) {
    throw Error(error.id(), "{}: {}", name, error.detail());
  }
}

Camera parseCamera(std::string_view text, const std::string& name) {
  return cameraFromJson(parse(text, name), name);
}

Camera loadCamera(const std::string& path) {
  return parseCamera(readCameraText(path), path);
}

std::string cameraJson(const Camera& camera) {
  const auto array = [](const glm::dvec3& v) { return json::array({v.x, v.y, v.z}); };
  nlohmann::ordered_json document{{"eye", array(camera.eye)},
                                  {"target", array(camera.target)},
                                  {"up", array(camera.up)},
                                  {"fovy_degrees", camera.fovyDegrees}};
  if (camera.orthographicHeight > 0) {
    document["orthographic_height"] = camera.orthographicHeight;
    document["far"] = camera.farPlane;
  }
  if (camera.shift != glm::dvec2(0)) document["shift"] = {camera.shift.x, camera.shift.y};
  if (camera.size.x != 0) document["size"] = {camera.size.x, camera.size.y};
  document["near"] = camera.nearPlane;
  return document.dump();
}

void saveCamera(const Camera& camera, const std::string& path) {
  writeFileAtomically(path, cameraJson(camera) + "\n");
}

glm::dmat3 worldFromView(const Camera& camera) {
  const glm::dvec3 backward = glm::normalize(camera.eye - camera.target);
  const glm::dvec3 right = glm::normalize(glm::cross(camera.up, backward));
  return {right, glm::cross(backward, right), backward};
}

}  // namespace grisaille::scene
