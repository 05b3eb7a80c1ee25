// SPDX-License-Identifier: MIT
// `grisaille apply` on pictures by `grisaille render` gives the rendered result, to within 1/255.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/image/image.h"
#include "core/scene/camera.h"
#include "core/scene/camera_matrices.h"
#include "core/scene/view.h"
#include "tests/app/apply/apply_run.h"
#include "tests/app/apply/odd_pictures.h"
#include "tests/support/expect_error.h"

namespace grisaille::tests {
namespace {

INSTANTIATE_TEST_SUITE_P(, Apply, ::testing::ValuesIn(testDevices()), GRISAILLE_DEVICE_NAME);

TEST_P(Apply, EqualsTheFrameThatThePicturesAreOf) {
  const std::string backend = " --check --backend " + GetParam().backend;
  for (const std::string size : {"161x91", "64x129"}) {
    render("--write color=color.exr" + backend, size);
    run("apply --depth depth.exr --normal normal.exr --camera @ --write ao=again.exr --write "
        "color=color_again.exr" +
        backend);
    expectSame("again.exr", "ao.exr");
    expectSame("color_again.exr", "color.exr");
    image::Image open = read("ao.exr");
    std::ranges::fill(open.pixels, 1.0f);
    EXPECT_GT(image::shareOver(read("ao.exr"), open, 0.2), 0.05) << "no pixel is occluded";
  }
}

// The kinds of cameras: jittered, one eye of a headset, a corner of a larger picture, orthographic.
constexpr const char* kKinds[] = {R"("fovy_degrees": 50, "shift": [0.003, -0.002])",
                                  R"("fovy_degrees": 50, "shift": [-0.12, 0.03])",
                                  R"("fovy_degrees": 30, "shift": [-0.5, -0.5])",
                                  R"("orthographic_height": 4, "far": 60)",
                                  R"("orthographic_height": 4, "far": 60, "shift": [0.2, -0.1])"};

TEST_P(Apply, TakesEveryKindOfCamera) {
  const std::string backend = " --check --backend " + GetParam().backend;
  for (const char* kind : kKinds) {
    SCOPED_TRACE(kind);
    camera_ = std::string(R"({"eye": [-5, 2.6, 1.6], "target": [2, -0.6, -0.9], "near": 0.05, )") +
              kind + "}";
    render(backend);
    run("apply --depth depth.exr --normal normal.exr --camera @ --write ao=again.exr" + backend);
    // Planes that differ change the last bits of the depth: single samples may fall on the other
    // side of an edge, here and below.
    expectSame("again.exr", "ao.exr", 0.002);
    // By the matrices in the file, which are floats.
    run("apply --depth depth.exr --normal normal.exr --write ao=again.exr" + backend);
    expectSame("again.exr", "ao.exr", 0.004);
    image::Image open = read("ao.exr");
    std::ranges::fill(open.pixels, 1.0f);
    EXPECT_GT(image::shareOver(read("ao.exr"), open, 0.1), 0.05) << "no pixel is occluded";
  }
}

// With the thickness of matter, the result is that of `render` with backs=bodies.
TEST_P(Apply, TakesTheThicknessOfMatter) {
  const std::string backend = " --check --backend " + GetParam().backend;
  const std::string bodies = " --set ssao.backs=bodies";
  run("render --camera @ --size 161x91 --write depth=depth.exr --write normal=normal.exr --write "
      "thickness=thickness.exr --write ao=assumed.exr" +
      backend);
  const Outcome drawn = runProgram(
      {"render", "--camera", camera_, "--size", "161x91", "--set", "ssao.guard_band=0", "--set",
       "ssao.backs=bodies", "--write", "ao=ao.exr", "--backend", GetParam().backend},
      folder_.path(), environment_);
  ASSERT_EQ(drawn.status, 0) << drawn.err;
  const std::string pictures = "apply --camera @ --depth depth.exr --normal normal.exr";
  run(pictures + " --thickness thickness.exr --write ao=again.exr" + bodies + backend);
  expectSame("again.exr", "ao.exr");
  EXPECT_GT(image::shareOver(read("ao.exr"), read("assumed.exr"), 2.0 / 255), 0.01);
  image::Image odd = read("thickness.exr");
  odd.pixels[5] = std::numeric_limits<float>::quiet_NaN();
  image::write(odd, folder_ / "odd.exr");
  expectError(pictures + " --thickness odd.exr --write ao=x.exr", "E5512", "(5, 0) is not finite");
  expectError(pictures + " --thickness normal.exr --write ao=x.exr", "E5505", "thickness");
}

// Normals from the depth are those of the facets, and normals in the wrong space are still noticed.
TEST_F(ApplyOnce, OrthographicPicturesAreChecked) {
  camera_ =
      R"({"eye": [-5, 2.6, 1.6], "target": [2, -0.6, -0.9], "near": 0.05, "far": 60, "orthographic_height": 4})";
  render();
  const std::string depth = "apply --depth depth.exr ";
  const Outcome sound = grisaille(depth + "--normal normal.exr --write ao=again.exr");
  EXPECT_EQ(sound.err.find("warning"), std::string::npos) << sound.err;
  expectError(depth + "--normal normal.exr --normal-space view --write ao=x.exr", "E5509",
              "normal");
  run(depth + "--write ao=facets.exr");
  // Facets have no smooth shading, and none of leaves' details.
  EXPECT_LT(image::compare(read("facets.exr"), read("ao.exr")).rmse, 0.12);
}

TEST_F(ApplyOnce, OrthographicDepthBuffersAreLinear) {
  camera_ =
      R"({"eye": [-5, 2.6, 1.6], "target": [2, -0.6, -0.9], "near": 0.5, "far": 60, "orthographic_height": 4})";
  render();
  image::Image clip = read("depth.exr"), reversed = clip;
  for (size_t i = 0; i < clip.pixels.size(); ++i) {
    const double z{clip.pixels[i]};
    clip.pixels[i] = static_cast<float>(z > 0 ? (z - 0.5) / 59.5 : 1);
    reversed.pixels[i] = static_cast<float>(z > 0 ? (60 - z) / 59.5 : 0);
  }
  image::write(clip, folder_ / "clip.exr");
  image::write(reversed, folder_ / "reversed.exr");
  for (const std::string kind : {"clip", "clip-reversed"}) {
    const std::string file = kind == "clip" ? "clip.exr" : "reversed.exr";
    run("apply --camera @ --depth " + file + " --depth-kind " + kind +
        " --normal normal.exr --write ao=again.exr");
    expectSame("again.exr", "ao.exr", 0.01);
  }
  // Files of image::write() hold no camera; the file of render does.
  expectError("apply --depth depth.exr --depth-kind clip --near 0.5 --write ao=x.exr", "E5101",
              "needs a far plane");
}

// Without --camera: the files store the matrices as floats, so single samples may fall on the other
// side of an edge.
TEST_F(ApplyOnce, TakesTheCameraFromTheDepthItself) {
  render();
  run("apply --depth depth.exr --normal normal.exr --write ao=again.exr");
  expectSame("again.exr", "ao.exr", 0.002);
}

TEST_F(ApplyOnce, EveryKindOfDepthComesToTheSame) {
  render();
  const image::Image depth = read("depth.exr"), normal = read("normal.exr");
  const scene::Camera camera = scene::parseCamera(kCamera, "test");
  image::Image clip = depth, reversed = depth, distance = depth, viewNormal = normal;
  const double near = camera.nearPlane, far = 80;
  const scene::View view = scene::viewOf(camera, {depth.width, depth.height});
  const glm::dmat3 viewFromWorld = glm::transpose(scene::worldFromView(camera));
  for (uint32_t i = 0; i < depth.pixels.size(); ++i) {
    const double z{depth.pixels[i]};
    const glm::dvec2 at(i % depth.width + 0.5, i / depth.width + 0.5);
    const double ray = glm::length(scene::rayAt(view, at).direction);
    reversed.pixels[i] = static_cast<float>(z > 0 ? near * (far - z) / (z * (far - near)) : 0);
    clip.pixels[i] = static_cast<float>(z > 0 ? 1 - near / z : 1);
    distance.pixels[i] =
        z > 0 ? static_cast<float>(z * ray) : std::numeric_limits<float>::infinity();
    const glm::dvec3 n = viewFromWorld * glm::dvec3(normal.pixels[3 * i], normal.pixels[3 * i + 1],
                                                    normal.pixels[3 * i + 2]);
    for (int c = 0; c < 3; ++c) viewNormal.pixels[3 * i + c] = static_cast<float>(n[c]);
  }
  image::write(reversed, folder_ / "reversed.exr");
  image::write(clip, folder_ / "clip.exr");
  image::write(distance, folder_ / "distance.exr");
  image::write(viewNormal, folder_ / "view.exr");
  // Allows for pixels that change because depth is off by a few bits or normals are rounded
  // differently.
  const auto same = [&](const std::string& more) {
    run("apply --camera @ --write ao=again.exr " + more);
    expectSame("again.exr", "ao.exr", 0.01);
    EXPECT_LT(image::compare(read("again.exr"), read("ao.exr")).rmse, 0.002) << more;
  };
  same("--depth reversed.exr --depth-kind clip-reversed --far 80 --normal normal.exr");
  same("--depth clip.exr --depth-kind clip --normal normal.exr");
  same("--depth distance.exr --depth-kind distance --normal normal.exr");
  same("--depth depth.exr --normal view.exr --normal-space view");
}

TEST_F(ApplyOnce, SequencesAreAppliedFrameByFrame) {
  for (const char* frame : {"0009", "0010", "0011"}) {
    const std::string eye = std::string("{\"eye\":[-5,2.6,1.") + (frame + 3) +
                            "],\"target\":[2,-0.6,-0.9],\"fovy_degrees\":50}";
    folder_.write(std::string("camera.") + frame + ".json", eye);
    run("render --camera " + eye + " --size 65x37 --write ao=ao." + frame +
        ".exr --write depth=d." + frame + ".exr --write normal=n." + frame + ".exr");
  }
  const std::string common =
      "apply --depth d.####.exr --normal n.%04d.exr --camera camera.####.json ";
  const Outcome outcome = grisaille(common + "--write ao=again.####.exr");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("wrote again.0009.exr to again.0011.exr"), std::string::npos);
  for (const std::string frame : {"0009", "0010", "0011"}) {
    expectSame("again." + frame + ".exr", "ao." + frame + ".exr");
  }
  EXPECT_GT(image::shareOver(read("ao.0009.exr"), read("ao.0010.exr"), 1.0 / 255), 0.0);
  // A terminal shows a progress bar.
  const Outcome shown =
      runShell("script -qec 'grisaille " + common +
                   "--set ssao.radius=0.5 --frames 9-11x2 --write ao=few.%02d.exr' /dev/null",
               folder_.path());
  EXPECT_EQ(shown.status, 0) << shown.err;
  EXPECT_NE(shown.out.find("\rapply ["), std::string::npos) << shown.out;
  EXPECT_NE(shown.out.find("frame 9, 1 of 2"), std::string::npos) << shown.out;
  expectSame("few.11.exr", "ao.0011.exr");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "few.10.exr"));

  expectError(common + "--write ao=one.exr", "E5507", "has no frame number, but --depth");
  expectError("apply --depth d.0009.exr --write ao=a.####.exr", "E5507",
              "but --depth is a single file");
  expectError("apply --depth d.0009.exr --normal n.####.exr --write ao=a.exr", "E5507",
              "but --depth is a single file");
  expectError("apply --depth d.0009.exr --frames 1-2 --write ao=a.exr", "E5507", "--frames");
  expectError("apply --depth x.####.exr --write ao=a.####.exr", "E5507", "x.####.exr");
  expectError(common + "--frames 9-12 --write ao=a.####.exr", "E5507", "frame 12");
  std::filesystem::remove(folder_ / "n.0010.exr");
  expectError(common + "--write ao=a.####.exr", "E5507", "frame 10 lacks the file 'n.0010.exr'");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.0009.exr"));
}

TEST_F(ApplyOnce, WhatDoesNotFitIsRefused) {
  render();
  const std::string with = "apply --camera @ --write ao=x.exr --depth ";
  // A file without matrices.
  image::write(read("depth.exr"), folder_ / "bare.exr");
  expectError("apply --depth bare.exr --write ao=x.exr", "E5501", "bare.exr");
  // Matrices of a picture with another aspect ratio.
  image::write(read("depth.exr"), folder_ / "stretched.exr",
               {.matrices = scene::matricesOf(scene::Camera{}, 100, 100)});
  expectError("apply --depth stretched.exr --write ao=x.exr", "E5502", "1.769 : 1");
  image::Image small = read("normal.exr");
  small.height -= 1;
  small.pixels.resize(size_t{3} * small.width * small.height);
  image::write(small, folder_ / "small.exr");
  expectError(with + "depth.exr --normal small.exr", "E5503", "161 x 90");
  image::Image odd = read("depth.exr");
  odd.pixels[161 * 3 + 8] = std::numeric_limits<float>::quiet_NaN();
  image::write(odd, folder_ / "odd.exr");
  expectError(with + "odd.exr", "E5504", "(8, 3) is nan");
  expectError(with + "depth.exr --depth-kind clip", "E5504", "depth.exr");
  expectError(with + "normal.exr", "E5505", "R, G, B");
  expectError(with + "depth.exr --surface base --write color=c.exr", "E5506", "base colours");
  expectError(with + "missing.exr", "E4101", "missing.exr");
  expectError("apply --depth depth.exr --depth-kind clip --write ao=x.exr", "E5101", "--near");
  expectError(with + "depth.exr --near 2 --far 1", "E5101", "--far");
  expectError(with + "depth.exr --write nothing=y.exr", "E5102", "nothing");
  expectError("apply --depth depth.exr", "E5101", "--write");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "x.exr"));
}

TEST_F(ApplyOnce, DeepPicturesAreRefusedAsDeep) {
  render();
  writeDeepPicture(folder_ / "deep.exr");
  const std::string with = "apply --camera @ --write ao=x.exr --depth ";
  expectError(with + "deep.exr", "E5508", "deep.exr: it is a deep picture");
  expectError(with + "depth.exr --normal deep.exr", "E5508", "deep.exr: it is a deep picture");
  EXPECT_ERROR(ErrorId::kPictureDeep, read("deep.exr"));
}

TEST_F(ApplyOnce, BaseColoursAndPicturesWithoutNormals) {
  render("--surface base --write base_colour=base.exr --write color=color.exr");
  run("apply --depth depth.exr --normal normal.exr --base-colour base.exr --surface base --camera "
      "@ "
      "--write color=again.exr");
  expectSame("again.exr", "color.exr");
  run("apply --depth depth.exr --camera @ --write ao=bare.exr --write normal=facets.exr");
  EXPECT_LT(image::compare(read("bare.exr"), read("ao.exr")).rmse, 0.14);
  EXPECT_LT(image::shareOver(read("facets.exr"), read("normal.exr"), 0.05), 0.5);
}

}  // namespace
}  // namespace grisaille::tests
