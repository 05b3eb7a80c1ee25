// SPDX-License-Identifier: MIT
#include "core/scene/camera.h"

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "tests/core/scene/gltf_builder.h"
#include "tests/support/expect_error.h"

namespace grisaille::scene {
namespace {

using CameraFiles = SceneFiles;

json goodCamera() {
  return {{"eye", {1, 2, 3}}, {"target", {4, 5, -6}}, {"fovy_degrees", 55.5}};
}

TEST_F(CameraFiles, ReadsAllFields) {
  json document = goodCamera();
  document["up"] = {0.1, 1, 0};
  document["size"] = {1280, 720};
  document["near"] = 0.05;
  const Camera camera = loadCamera(put("a.json", document.dump()));
  EXPECT_EQ(camera.eye, glm::dvec3(1, 2, 3));
  EXPECT_EQ(camera.target, glm::dvec3(4, 5, -6));
  EXPECT_EQ(camera.up, glm::dvec3(0.1, 1, 0));
  EXPECT_EQ(camera.fovyDegrees, 55.5);
  EXPECT_EQ(camera.size, glm::uvec2(1280, 720));
  EXPECT_EQ(camera.nearPlane, 0.05);
}

TEST_F(CameraFiles, SavingLosesNothing) {
  for (const glm::uvec2 size : {glm::uvec2(0), glm::uvec2(640, 480)}) {
    const Camera camera{.eye = {0.1, 1.0 / 3, -1e5},
                        .target = {2, 3, 4},
                        .up = {0, 0.7, 0.1},
                        .fovyDegrees = 61.7,
                        .size = size,
                        .nearPlane = 1e-3};
    saveCamera(camera, file("a.json"));
    const Camera back = loadCamera(file("a.json"));
    EXPECT_EQ(back.eye, camera.eye);
    EXPECT_EQ(back.target, camera.target);
    EXPECT_EQ(back.up, camera.up);
    EXPECT_EQ(back.fovyDegrees, camera.fovyDegrees);
    EXPECT_EQ(back.size, camera.size);
    EXPECT_EQ(back.nearPlane, camera.nearPlane);
  }
  EXPECT_ERROR(ErrorId::kFileUnwritable, saveCamera(atriumCamera(), file("missing/a.json")));
}

TEST(CameraText, ComesBackBitByBit) {
  std::mt19937_64 random(1);
  const auto any = [&](double largest) {
    for (;;) {
      const double value = std::bit_cast<double>(random());
      if (std::abs(value) <= largest) return random() % 16 == 0 ? std::copysign(0.0, value) : value;
    }
  };
  const auto bits = [](const Camera& c) {
    std::vector<uint64_t> all = {c.size.x, c.size.y};
    for (const double value : {c.eye.x, c.eye.y, c.eye.z, c.target.x, c.target.y, c.target.z,
                               c.up.x, c.up.y, c.up.z, c.fovyDegrees, c.nearPlane}) {
      all.push_back(std::bit_cast<uint64_t>(value));
    }
    return all;
  };
  size_t sound = 0;
  while (sound < 5000) {
    Camera camera{.eye = {any(1e15), any(1e15), any(1e15)},
                  .target = {any(1e15), any(1e15), any(1e15)},
                  .up = {any(1e15), any(1e15), any(1e15)},
                  .fovyDegrees = 1 + std::abs(any(169)),
                  .size = random() % 2 ? glm::uvec2(0) : glm::uvec2(1 + random() % 16384, 7),
                  .nearPlane = std::abs(any(1e9))};
    try {
      validate(camera);
    } catch (const Error&) {
      continue;
    }
    ++sound;
    const std::string text = cameraJson(camera);
    EXPECT_EQ(text.find('\n'), std::string::npos);
    ASSERT_EQ(bits(parseCamera(text, "text")), bits(camera)) << text;
  }
}

TEST(CameraText, ErrorsBeginWithItsName) {
  for (const auto& [text, id] : {std::pair{"", ErrorId::kCameraUnreadable},
                                 {"{", ErrorId::kCameraUnreadable},
                                 {"{}", ErrorId::kCameraInvalid},
                                 {"[]", ErrorId::kCameraInvalid}}) {
    try {
      parseCamera(text, "--camera");
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.id(), id) << error.what();
      EXPECT_EQ(error.detail().rfind("--camera: ", 0), 0u) << error.what();
    }
  }
}

TEST_F(CameraFiles, BadFieldsAreRefusedByName) {
  const std::pair<const char*, json> cases[] = {
      {"eye", "here"},
      {"eye", {1, 2}},
      {"eye", {1, 2, 3, 4}},
      {"eye", {1, "2", 3}},
      {"eye", {1, nullptr, 3}},
      {"eye", {1e300, 0, 0}},
      {"target", {1, 2, 3}},
      {"target", 7},
      {"target", {{1}, 2, 3}},
      {"up", {0, 0, 0}},
      {"up", {3, 3, -9}},
      {"up", {-6, -6, 18}},
      {"up", false},
      {"fovy_degrees", 0},
      {"fovy_degrees", 180},
      {"fovy_degrees", "wide"},
      {"fovy_degrees", -60},
      {"size", {0, 720}},
      {"size", {1280}},
      {"size", {1280.5, 720}},
      {"size", {1e9, 720}},
      {"size", {-1, 720}},
      {"near", 0},
      {"near", -1},
      {"near", json::array({1})},
      {"near", 1e300},
  };
  for (const auto& [field, value] : cases) {
    json document = goodCamera();
    document[field] = value;
    try {
      loadCamera(put("a.json", document.dump()));
      ADD_FAILURE() << field << " = " << value;
    } catch (const Error& error) {
      EXPECT_EQ(error.id(), ErrorId::kCameraInvalid) << error.what();
      EXPECT_NE(error.detail().find(field), std::string::npos) << error.what();
    }
  }
  for (const char* field : {"eye", "target", "fovy_degrees"}) {
    json document = goodCamera();
    document.erase(field);
    EXPECT_ERROR(ErrorId::kCameraInvalid, loadCamera(put("a.json", document.dump())));
  }
  EXPECT_ERROR(ErrorId::kCameraInvalid, loadCamera(put("a.json", "[1, 2]")));
}

TEST_F(CameraFiles, AnUnknownKeyNamesTheNearest) {
  json document = goodCamera();
  document["fov_degrees"] = 60;
  try {
    loadCamera(put("a.json", document.dump()));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.id(), ErrorId::kCameraInvalid);
    EXPECT_NE(error.detail().find("fovy_degrees"), std::string::npos) << error.what();
  }
}

TEST_F(CameraFiles, UnreadableFiles) {
  EXPECT_ERROR(ErrorId::kCameraUnreadable, loadCamera(file("missing.json")));
  EXPECT_ERROR(ErrorId::kCameraUnreadable, loadCamera(file(".")));
  EXPECT_ERROR(ErrorId::kCameraUnreadable, loadCamera(put("a.json", "")));
  EXPECT_ERROR(ErrorId::kCameraUnreadable, loadCamera(put("a.json", "{\"eye\": [NaN, 0, 0]}")));
  EXPECT_ERROR(ErrorId::kCameraUnreadable, loadCamera(put("a.json", "{\"eye\": [1e999, 0, 0]}")));
  EXPECT_ERROR(ErrorId::kCameraUnreadable, loadCamera(put("a.json", std::string(100000, '['))));
  EXPECT_ERROR(ErrorId::kCameraUnreadable, loadCamera(put("a.json", std::string(2 << 20, ' '))));
}

TEST(Camera, ValidateRefusesWhatNoFileCanHold) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (int field = 0; field < 5; ++field) {
      Camera camera;
      if (field == 0) camera.eye.x = bad;
      if (field == 1) camera.target.y = bad;
      if (field == 2) camera.up.z = bad;
      if (field == 3) camera.fovyDegrees = bad;
      if (field == 4) camera.nearPlane = bad;
      EXPECT_ERROR(ErrorId::kCameraInvalid, validate(camera));
    }
  }
  EXPECT_NO_THROW(validate(Camera{}));
  EXPECT_NO_THROW(validate(atriumCamera()));
}

TEST(Camera, TheTargetIsTheMiddleOfThePicture) {
  for (const Camera& camera : {atriumCamera(), Camera{},
                               Camera{.eye = {5, 9, 2}, .target = {4, -3, 8}, .up = {1, 1, 0}}}) {
    const glm::dmat3 world = worldFromView(camera);
    const glm::dvec3 target = glm::transpose(world) * (camera.target - camera.eye);
    EXPECT_NEAR(target.x, 0, 1e-12);
    EXPECT_NEAR(target.y, 0, 1e-12);
    EXPECT_LT(target.z, 0);
    EXPECT_NEAR(glm::determinant(world), 1, 1e-12);
    EXPECT_GT(glm::dot(world[1], camera.up), 0);
    EXPECT_NEAR(glm::dot(world[0], camera.up), 0, 1e-12);
  }
}

}  // namespace
}  // namespace grisaille::scene
