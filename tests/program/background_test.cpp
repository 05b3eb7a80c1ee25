// SPDX-License-Identifier: MIT
// The background of the composed picture, on every backend.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

class Background : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const std::vector<std::string> present = backends();
    if (std::ranges::find(present, GetParam()) == present.end()) {
      GTEST_SKIP() << GetParam() << " has no device here";
    }
  }

  image::Image rendered(const std::string& more, const std::string& file) {
    const Outcome outcome =
        runShell("grisaille render --backend " + GetParam() +
                     " --size 96x54 --check --write depth=d.exr --write color=" + file + " " + more,
                 folder_.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    if (outcome.status != 0) return {};
    depth_ = image::read(folder_ / "d.exr");
    return image::read(folder_ / file);
  }

  // Checks the colours of all pixels without a surface, and that there are both kinds of pixels.
  void expectSky(const image::Image& color, std::array<float, 4> sky, uint32_t channels) {
    ASSERT_EQ(color.channels, channels);
    size_t seen = 0;
    for (uint32_t y = 0; y < color.height; ++y) {
      for (uint32_t x = 0; x < color.width; ++x) {
        if (depth_.at(x, y) > 0) {
          ASSERT_EQ(channels == 4 ? color.at(x, y, 3) : 1, 1);
          continue;
        }
        ++seen;
        for (uint32_t c = 0; c < channels; ++c) ASSERT_NEAR(color.at(x, y, c), sky[c], 2e-4);
      }
    }
    EXPECT_GT(seen, 0u);
    EXPECT_LT(seen, depth_.pixels.size());
  }

  TemporaryFolder folder_;
  image::Image depth_;
};
INSTANTIATE_TEST_SUITE_P(, Background, ::testing::Values("opengl", "vulkan"),
                         [](const auto& test) { return test.param; });

TEST_P(Background, IsGreyUnlessAColourIsGiven) {
  const float grey = 128.0f / 255;
  expectSky(rendered("", "a.png"), {grey, grey, grey, 1}, 3);
  expectSky(rendered("--background '#ff8000'", "a.png"), {1, grey, 0, 1}, 3);
  expectSky(rendered("--background '#ff8000'", "a.exr"), {1, 0.21586f, 0, 1}, 3);
  expectSky(rendered("--surface base", "a.png"), {grey, grey, grey, 1}, 3);
}

TEST_P(Background, IsAbsentWhereItIsTransparent) {
  for (const char* surface : {"white", "base"}) {
    for (const char* file : {"a.png", "a.exr"}) {
      const std::string more = std::string("--background transparent --surface ") + surface;
      expectSky(rendered(more, file), {0, 0, 0, 0}, 4);
    }
  }
}

TEST_P(Background, LeavesSurfacesAndOtherOutputsAsTheyAre) {
  const image::Image grey =
      rendered("--effects ssao,sspm --add sspm=40,40 --write ao=a.exr", "c.exr");
  const image::Image depth = depth_, ao = image::read(folder_ / "a.exr");
  const image::Image clear = rendered(
      "--effects ssao,sspm --add sspm=40,40 --write ao=a.exr --background transparent", "c.exr");
  EXPECT_EQ(image::read(folder_ / "a.exr").pixels, ao.pixels);
  EXPECT_EQ(depth_.pixels, depth.pixels);
  ASSERT_EQ(clear.channels, 4u);
  for (uint32_t y = 0; y < depth.height; ++y) {
    for (uint32_t x = 0; x < depth.width; ++x) {
      if (depth.at(x, y) == 0) continue;
      for (uint32_t c = 0; c < 3; ++c) ASSERT_EQ(clear.at(x, y, c), grey.at(x, y, c));
    }
  }
}

TEST_P(Background, PaintIsShadedInAnyOrderOfTheEffects) {
  const std::string shots = " --set sspm.paint_range=2 --add sspm=40,40 --add sspm=30,20";
  const image::Image after = rendered("--effects ssao,sspm" + shots, "a.exr");
  const image::Image before =
      rendered("--effects sspm,ssao" + shots + " --write ao=ao.exr --write paint=p.exr", "b.exr");
  EXPECT_EQ(after.pixels, before.pixels);
  const image::Image ao = image::read(folder_ / "ao.exr"), paint = image::read(folder_ / "p.exr");
  size_t painted = 0;
  for (uint32_t y = 0; y < after.height; ++y) {
    for (uint32_t x = 0; x < after.width; ++x) {
      const float alpha = paint.at(x, y, 3);
      if (depth_.at(x, y) == 0 || alpha == 0) continue;
      painted += ao.at(x, y) < 0.95f ? 1 : 0;
      for (uint32_t c = 0; c < 3; ++c) {
        const float color = (1 - alpha) + alpha * paint.at(x, y, c);
        ASSERT_NEAR(after.at(x, y, c), color * ao.at(x, y), 2e-3f);
      }
    }
  }
  EXPECT_GT(painted, 20u);
}

// The depth of an effect's guard band is larger than the picture.
TEST_P(Background, FitsThePictureBesideAGuardBand) {
  const std::string wide = "--set ssao.guard_band=0.2 --background ";
  expectSky(rendered(wide + "transparent", "a.png"), {0, 0, 0, 0}, 4);
  const Outcome alone = runShell("grisaille render --backend " + GetParam() + " --size 96x54 " +
                                     wide + "transparent --write color=only.exr",
                                 folder_.path());
  ASSERT_EQ(alone.status, 0) << alone.err;
  expectSky(image::read(folder_ / "only.exr"), {0, 0, 0, 0}, 4);
}

TEST_P(Background, ComesFromTheSettingsFileUnlessTheCommandLineGivesIt) {
  folder_.write("s.toml", "background = \"transparent\"\n");
  expectSky(rendered("--config s.toml", "a.png"), {0, 0, 0, 0}, 4);
  expectSky(rendered("--config s.toml --background '#000000'", "a.png"), {0, 0, 0, 1}, 3);
}

TEST_P(Background, OfPicturesIsTheSkyOfTheirDepth) {
  const image::Image drawn = rendered("--background transparent", "a.exr");
  const Outcome applied =
      runShell("grisaille apply --backend " + GetParam() +
                   " --depth d.exr --effects '' --background transparent --write color=b.exr",
               folder_.path());
  ASSERT_EQ(applied.status, 0) << applied.err;
  expectSky(image::read(folder_ / "b.exr"), {0, 0, 0, 0}, 4);
}

TEST(BackgroundOption, RefusesWhatIsNoColour) {
  const TemporaryFolder folder;
  for (const char* text : {"grey", "'#12'", "'#gggggg'", "''"}) {
    const Outcome outcome =
        runShell(std::string("grisaille render --size 8x8 --background ") + text, folder.path());
    EXPECT_NE(outcome.status, 0) << text;
    EXPECT_NE(outcome.err.find("--background"), std::string::npos) << outcome.err;
  }
}

// A model of another size: the note names the radius once, and a value that is set wins.
TEST(SceneRadius, IsPrintedUnlessItIsSet) {
  const TemporaryFolder folder;
  folder.write("tiny.gltf", R"({"asset": {"version": "2.0"}, "scene": 0,
    "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "scale": [0.01, 0.01, 0.01]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                   "min": [0, 0, 0], "max": [1, 1, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
  const auto note = [&](const std::string& line) {
    const Outcome outcome = runShell(line, folder.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const size_t at = outcome.err.find("note: ssao.radius = ");
    EXPECT_EQ(outcome.err.find("chosen for", at + 60), std::string::npos) << outcome.err;
    return at == std::string::npos ? 0.0 : std::stod(outcome.err.substr(at + 20));
  };
  const double radius = note("grisaille render tiny.gltf --size 64x36 --write depth=d.exr");
  EXPECT_GT(radius, 1e-4);
  EXPECT_LT(radius, 1e-3);
  for (const std::string& backend : backends()) {
    EXPECT_EQ(note("grisaille render tiny.gltf --size 16x16 --write ao=a.exr --backend " + backend +
                   " --camera '{\"eye\": [0, 0, 3], \"target\": [0, 0, 0], \"fovy_degrees\": 40}'"),
              radius);
  }
  EXPECT_GT(note("grisaille apply --depth d.exr --write ao=b.exr"), 1e-4);
  folder.write("s.toml", "[ssao]\nradius = 0.5\n");
  EXPECT_EQ(note("grisaille render tiny.gltf --size 8x8 --set ssao.radius=0.5"), 0);
  EXPECT_EQ(note("grisaille render tiny.gltf --size 8x8 --config s.toml"), 0);
  EXPECT_EQ(note("grisaille render --size 8x8"), 0) << "the atrium keeps the defaults";
}

}  // namespace
}  // namespace grisaille::tests
