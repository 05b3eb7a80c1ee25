// SPDX-License-Identifier: MIT
// `grisaille apply` names pictures that cannot be right, and says nothing of sound ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <glm/gtc/packing.hpp>
#include <limits>

#include "core/scene/camera.h"
#include "tests/app/apply/apply_run.h"
#include "tests/app/apply/odd_pictures.h"

namespace grisaille::tests {
namespace {

using glm::vec3;

// Changes each normal of a picture.
image::Image changed(image::Image normals, const std::function<vec3(vec3)>& change) {
  for (size_t i = 0; i < normals.pixels.size(); i += 3) {
    const vec3 n = change({normals.pixels[i], normals.pixels[i + 1], normals.pixels[i + 2]});
    for (int c = 0; c < 3; ++c) normals.pixels[i + static_cast<size_t>(c)] = n[c];
  }
  return normals;
}

image::Image scaled(image::Image picture, float by) {
  for (float& value : picture.pixels) value *= by;
  return picture;
}

class SoundPictures : public Apply {};
INSTANTIATE_TEST_SUITE_P(, SoundPictures, ::testing::ValuesIn(testDevices()),
                         GRISAILLE_DEVICE_NAME);

// Whatever the view: a hall, foliage close up, a floor from above, and a portrait format.
TEST_P(SoundPictures, PassWithoutAWord) {
  const std::string backend = " --backend " + GetParam().backend;
  const std::pair<const char*, const char*> views[] = {
      {R"({"eye":[-5,2.6,1.6],"target":[2,-0.6,-0.9],"fovy_degrees":50})", "160x90"},
      {R"({"eye":[8.5,1.6,-3.6],"target":[-6,1.5,-3.9],"fovy_degrees":60})", "320x180"},
      {R"({"eye":[0,3,0.5],"target":[0.1,0,0],"fovy_degrees":75})", "64x129"},
      {R"({"eye":[0,1.5,0],"target":[0,1.5,-1],"fovy_degrees":40})", "97x61"}};
  for (const auto& [camera, size] : views) {
    run(std::string("render --camera ") + camera + " --size " + size + backend +
        " --write depth=d.exr --write normal=n.exr --write normal=n.png --write base_colour=b.exr");
    // As a renderer that stores half floats writes them.
    for (const std::string name : {"d", "n"}) {
      image::Image half = read(name + ".exr");
      for (float& value : half.pixels) {
        value = glm::unpackHalf1x16(glm::packHalf1x16(value));
      }
      image::write(half, folder_ / (name + "_half.exr"));
    }
    const Outcome half = grisaille(
        std::string("apply --depth d_half.exr --normal n_half.exr --write ao=a.exr --camera ") +
        camera + backend);
    EXPECT_EQ(half.status, 0);
    EXPECT_EQ(half.err, "") << camera;
    for (const std::string more :
         {"", "--normal n.exr --base-colour b.exr --surface base --write color=c.exr",
          "--normal n.png --normal-encoding unsigned"}) {
      const Outcome outcome = grisaille("apply --depth d.exr --write ao=a.exr " + more + backend);
      EXPECT_EQ(outcome.status, 0);
      EXPECT_EQ(outcome.err, "") << camera << " " << more;
    }
  }
}

class PictureChecks : public ApplyOnce {
 protected:
  void SetUp() override {
    render("--write base_colour=base.exr");
    depth_ = read("depth.exr");
    normal_ = read("normal.exr");
    camera_ = scene::parseCamera(kCamera, "test");
  }
  void refusesNormal(const image::Image& normal, const std::string& mention,
                     const std::string& more = "") {
    image::write(normal, folder_ / "odd.exr");
    expectError("apply --depth depth.exr --normal odd.exr --write ao=x.exr " + more, "E5509",
                mention);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "x.exr"));
  }
  // Expects one warning, and a picture.
  void warns(const std::string& line, const std::string& mention) {
    const Outcome outcome = grisaille("apply --write ao=x.exr " + line);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("warning: ", 0), 0u) << outcome.err;
    EXPECT_NE(outcome.err.find(mention), std::string::npos) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_TRUE(std::filesystem::exists(folder_ / "x.exr"));
    std::filesystem::remove(folder_ / "x.exr");
  }
  // Replaces depth.exr, without the camera in its file.
  void storeDepth(const std::function<float(float)>& change) {
    image::Image odd = depth_;
    for (float& z : odd.pixels) z = change(z);
    image::write(odd, folder_ / "odd_depth.exr");
  }

  image::Image depth_, normal_;
  scene::Camera camera_;
};

TEST_F(PictureChecks, NormalsOfAnotherLengthOrEncoding) {
  refusesNormal(scaled(normal_, 0), "100 % of the surface pixels have a normal of length 0");
  const image::Image encoded = changed(normal_, [](vec3 n) { return 0.5f * n + 0.5f; });
  refusesNormal(encoded, "pass --normal-encoding unsigned");
  refusesNormal(normal_, "negative component", "--normal-encoding unsigned");
  run("apply --depth depth.exr --normal odd.exr --write ao=a.exr");
  image::write(encoded, folder_ / "encoded.exr");
  run("apply --depth depth.exr --normal encoded.exr --normal-encoding unsigned --write ao=b.exr");
  expectSame("b.exr", "a.exr", 0.01);
  int pixel = 0;
  refusesNormal(
      changed(normal_, [&](vec3 n) { return n * (0.3f * static_cast<float>(++pixel % 7 + 1)); }),
      "lengths vary from 0.3 to 2.1");
  image::write(scaled(normal_, 2), folder_ / "two.exr");
  warns("--depth depth.exr --normal two.exr", "the normals have a mean length of 2, not 1");
  expectSame("b.exr", "a.exr", 0.01);
  image::write(changed(normal_, [&](vec3 n) { return ++pixel % 20 == 0 ? vec3(0) : n; }),
               folder_ / "gaps.exr");
  warns("--depth depth.exr --normal gaps.exr", "5.0 % of the surface pixels have a normal of len");
}

TEST_F(PictureChecks, NormalsOfAnotherDirection) {
  const glm::mat3 viewFromWorld(glm::transpose(scene::worldFromView(camera_)));
  const image::Image view = changed(normal_, [&](vec3 n) { return viewFromWorld * n; });
  refusesNormal(scaled(normal_, -1),
                "100 % of the surface pixels have a normal that faces away from the camera; they "
                "fit the depth to");
  refusesNormal(scaled(normal_, -1), "written as (-x, -y, -z)");
  refusesNormal(view, "as view-space normals, --normal-space view");
  refusesNormal(normal_, "as world-space normals, --normal-space world", "--normal-space view");
  refusesNormal(changed(normal_, [](vec3 n) { return vec3(n.x, n.z, n.y); }),
                "written as (x, z, y)");
  refusesNormal(changed(normal_, [](vec3 n) { return vec3(n.x, -n.z, n.y); }),
                "written as (x, z, -y)");
  refusesNormal(changed(view, [](vec3 n) { return vec3(n.x, n.y, -n.z); }), "written as (x, y, -z)",
                "--normal-space view");
  // Normals of another picture.
  image::Image turned = normal_;
  std::ranges::reverse(turned.pixels);
  turned = changed(turned, [](vec3 n) { return vec3(n.z, n.y, n.x); });
  image::write(changed(turned, [](vec3 n) { return vec3(-n.z, n.x, -n.y); }),
               folder_ / "turned.exr");
  const Outcome outcome = grisaille("apply --depth depth.exr --normal turned.exr --write ao=x.exr");
  EXPECT_NE(outcome.err.find("turned.exr: "), std::string::npos) << outcome.err;
}

TEST_F(PictureChecks, DepthsOfAnotherKindOrUnit) {
  const std::string odd = "--depth odd_depth.exr --camera @";
  const auto near = static_cast<float>(camera_.nearPlane);
  const auto refused = [&](const std::string& more, const std::string& mention) {
    expectError("apply --write ao=x.exr " + odd + more, "E5504", mention);
  };
  storeDepth([&](float z) { return z < 6 ? 1 - near / z : 1; });  // with a sky
  warns(odd, "like the sky of a depth buffer; for that, pass --depth-kind clip");
  refused(" --depth-kind clip-reversed", "the picture looks like --depth-kind clip;");
  storeDepth([&](float z) { return z < 6 ? near / z : 0; });
  warns(odd,
        "in front of the near plane at 0.05 m; for a depth buffer, pass --depth-kind clip-rev");
  refused(" --depth-kind clip", "the picture looks like --depth-kind clip-reversed;");
  storeDepth([&](float z) { return 1 - near / std::max(z, 1.0f); });  // without a sky
  warns(odd, "like a depth buffer; for that, pass --depth-kind clip");
  warns(odd + " --depth-kind clip-reversed", "if 1 stands for the far plane, pass --depth-kind cl");
  storeDepth([&](float z) { return near / std::max(z, 1.0f); });
  warns(odd + " --depth-kind clip", "if 1 stands for the near plane, pass --depth-kind clip-rever");
  storeDepth([](float z) { return 1000 * z; });
  warns(odd, "write it in metres");
  storeDepth([](float) { return 5.0f; });
  warns(odd, "every surface pixel has the same depth, 5 m");
  storeDepth([](float) { return 0.0f; });
  warns(odd, "no pixel shows a surface");
  storeDepth([](float z) { return -z; });
  refused("", "is -");
  image::write(scaled(depth_, 0.05f), folder_ / "whole.png", {.pngBits = 16});
  expectError("apply --write ao=x.exr --depth whole.png --camera @", "E5504", "stores integers");
}

TEST_F(PictureChecks, OddPixelsCamerasAndColours) {
  writeWithAspect(depth_, 2, folder_ / "wide.exr");
  writeWithAspect(normal_, 0.5f, folder_ / "tall.exr");
  writeWithAspect(depth_, 1, folder_ / "square.exr");
  const std::string end = " --camera @ --write ao=x.exr";
  expectError("apply --depth wide.exr" + end, "E5510",
              "wide.exr: its pixels have an aspect ratio of 2,");
  expectError("apply --depth depth.exr --normal tall.exr" + end, "E5510", "ratio of 0.5, not 1");
  run("apply --depth square.exr" + end);

  warns(R"(--depth depth.exr --camera {"eye":[-5,2.6,1.6],"target":[2,1,-0.9],"fovy_degrees":40})",
        "from the camera in the file, and its angle of view is 40.0 instead of 50.0 degrees");

  image::Image base = read("base.exr");
  base.pixels[7] = 3;
  image::write(base, folder_ / "bright.exr");
  const std::string colours = "--depth depth.exr --surface base --write color=c.exr --base-colour ";
  warns(colours + "bright.exr", "outside 0 to 1, from");
  base.pixels[7] = std::numeric_limits<float>::quiet_NaN();
  image::write(base, folder_ / "nan.exr");
  expectError("apply " + colours + "nan.exr", "E5511", "the base colour at (2, 0) is not finite");
}

// A defect of every frame is named once.
TEST_F(PictureChecks, ASequenceWarnsOnce) {
  for (const char* frame : {"1", "2", "3"}) {
    image::write(depth_, folder_ / (std::string("d.0") + frame + ".exr"));
    image::write(scaled(normal_, 2), folder_ / (std::string("n.0") + frame + ".exr"));
  }
  const Outcome outcome =
      grisaille("apply --depth d.##.exr --normal n.##.exr --camera @ --write ao=a.##.exr");
  EXPECT_EQ(outcome.status, 0);
  const std::string warning = "warning: n.01.exr: the normals have a mean length of 2, not 1";
  EXPECT_NE(outcome.err.find(warning), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("n.02.exr"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace grisaille::tests
