// SPDX-License-Identifier: MIT
#include "core/scene/camera_path.h"

#include "tests/core/scene/gltf_builder.h"
#include "tests/support/expect_error.h"

namespace grisaille::scene {
namespace {

using CameraPathFiles = SceneFiles;

json key(double x) {
  return {{"eye", {x, 1, 3}}, {"target", {2 * x, 0, 0}}, {"fovy_degrees", 40 + x}};
}

json goodPath() {
  return {{"cameras", {key(0), key(3), key(4)}}, {"frames", 7}};
}

TEST_F(CameraPathFiles, RunsFromKeyToKey) {
  const CameraPath path = loadCameraPath(put("path.json", goodPath().dump()));
  const std::vector<Camera> cameras = camerasOf(path);
  ASSERT_EQ(cameras.size(), 7u);
  const double x[] = {0, 1, 2, 3, 3 + 1.0 / 3, 3 + 2.0 / 3, 4};
  for (size_t i = 0; i < 7; ++i) {
    SCOPED_TRACE(i);
    EXPECT_NEAR(cameras[i].eye.x, x[i], 1e-12);
    EXPECT_NEAR(cameras[i].target.x, 2 * x[i], 1e-12);
    EXPECT_NEAR(cameras[i].fovyDegrees, 40 + x[i], 1e-12);
    EXPECT_EQ(cameras[i].eye.z, 3);
  }
  // The first and last cameras equal the keys, to the bit.
  EXPECT_EQ(cameraJson(cameras.front()), cameraJson(path.keys.front()));
  EXPECT_EQ(cameraJson(cameras.back()), cameraJson(path.keys.back()));
  const CameraPath again = parseCameraPath(cameraPathJson(path), "again");
  EXPECT_EQ(again.keys, path.keys);
  EXPECT_EQ(again.frames, path.frames);
}

TEST_F(CameraPathFiles, MistakesAreNamed) {
  const auto refused = [&](const json& document, ErrorId id, const std::string& word) {
    try {
      loadCameraPath(put("path.json", document.dump()));
      ADD_FAILURE() << document;
    } catch (const Error& error) {
      EXPECT_EQ(error.id(), id) << error.what();
      EXPECT_NE(error.detail().find("path.json: "), std::string::npos) << error.what();
      EXPECT_NE(error.detail().find(word), std::string::npos) << error.what();
    }
  };
  const auto with = [](const char* field, const json& value) {
    json document = goodPath();
    document[field] = value;
    return document;
  };
  for (const json& frames : {json(1), json(0), json(-3), json(2.5), json("7"), json(1e9), json()}) {
    refused(with("frames", frames), ErrorId::kCameraInvalid, "frames");
  }
  refused(with("cameras", {key(0)}), ErrorId::kCameraInvalid, "cameras");
  refused(with("cameras", 5), ErrorId::kCameraInvalid, "cameras");
  refused(with("cameras", {key(0), 5}), ErrorId::kCameraInvalid, "cameras[1]");
  refused(with("speed", 5), ErrorId::kCameraInvalid, "speed");
  json wide = key(1);
  wide["fovy_degrees"] = 180;
  refused(with("cameras", {key(0), wide}), ErrorId::kCameraInvalid, "cameras[1]: fovy_degrees");
  for (const char* field : {"cameras", "frames"}) {
    json document = goodPath();
    document.erase(field);
    refused(document, ErrorId::kCameraInvalid, field);
  }
  refused(json::array(), ErrorId::kCameraInvalid, "object");
  EXPECT_ERROR(ErrorId::kCameraUnreadable, loadCameraPath(put("path.json", "{")));
  EXPECT_ERROR(ErrorId::kCameraUnreadable, loadCameraPath(file("missing.json")));
  const std::string deep = std::string(200000, '[') + std::string(200000, ']');
  EXPECT_ERROR(ErrorId::kCameraInvalid,
               loadCameraPath(put("path.json", "{\"frames\": 2, \"cameras\": [" + deep + "]}")));
}

// The eye passes through the target.
TEST(CameraPath, AFrameWithoutAViewIsNamed) {
  const Camera a{.eye = {0, 0, 2}, .target = {0, 0, 0}}, b{.eye = {0, 0, -2}, .target = {0, 0, 0}};
  EXPECT_NO_THROW(camerasOf({.keys = {a, b}, .frames = 4}));
  try {
    camerasOf({.keys = {a, b}, .frames = 5});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.id(), ErrorId::kCameraInvalid);
    EXPECT_EQ(error.detail().rfind("frame 2: target", 0), 0u) << error.what();
  }
}

}  // namespace
}  // namespace grisaille::scene
