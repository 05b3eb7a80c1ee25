// SPDX-License-Identifier: MIT
// The example hosts, built against an installation alone. Their ambient occlusion matches the
// program's, from their depth and normals and from their scene.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <glm/gtc/packing.hpp>
#include <memory>
#include <sstream>

#include "core/image/image.h"
#include "tests/program/run.h"
#include "tests/support/display.h"

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

constexpr uint32_t kWidth = 320, kHeight = 180;
// Same as in examples/common/scene.h.
constexpr const char* kCamera =
    R"({"eye": [3.1, 2.3, 3.7], "target": [-0.2, 0.5, -0.1], "fovy_degrees": 51.56620156177409, "near": 0.1})";

template <typename T>
std::vector<T> numbersOf(const fs::path& path) {
  const std::string bytes = readFile(path);
  std::vector<T> numbers(bytes.size() / sizeof(T));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(T));
  return numbers;
}

// The first `channels` channels of a file of bare numbers.
image::Image imageOf(const std::vector<float>& numbers, uint32_t channels) {
  const size_t pixels = size_t{kWidth} * kHeight, given = numbers.size() / pixels;
  image::Image image{.width = kWidth, .height = kHeight, .channels = channels, .pixels = {}};
  for (size_t i = 0; i < pixels; ++i) {
    for (size_t c = 0; c < channels; ++c) image.pixels.push_back(numbers[i * given + c]);
  }
  return image;
}

std::vector<float> floatsOf(const std::vector<uint16_t>& halves) {
  std::vector<float> floats;
  for (const uint16_t half : halves) floats.push_back(glm::unpackHalf1x16(half));
  return floats;
}

// A glTF for the scene's triangles: the file's interleaved vertices are its buffer.
std::string gltfOf(size_t bytes) {
  const size_t count = bytes / (6 * sizeof(float));
  return fmt::format(
      R"({{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}],
"nodes": [{{"mesh": 0}}],
"meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0, "NORMAL": 1}}}}]}}],
"buffers": [{{"uri": "vertices.f32", "byteLength": {0}}}],
"bufferViews": [{{"buffer": 0, "byteLength": {0}, "byteStride": 24, "target": 34962}}],
"accessors": [
{{"bufferView": 0, "byteOffset": 0, "componentType": 5126, "count": {1}, "type": "VEC3",
"min": [-2, 0, -2], "max": [6, 4, 6]}},
{{"bufferView": 0, "byteOffset": 12, "componentType": 5126, "count": {1}, "type": "VEC3"}}]}})",
      bytes, count);
}

struct Example {
  const char* name;     // of its folder; its program is NAME_host
  const char* more;     // arguments
  const char* backend;  // that draws the program's picture to compare with
  const char* depth;    // options of `apply`
  const char* space;    // of the normals
};

class Examples : public ::testing::TestWithParam<Example> {
 protected:
  static void SetUpTestSuite() {
    if (SANITIZED) return;
    folder_ = std::make_unique<TemporaryFolder>();
    display_ = std::make_unique<Display>(320, 240);
    const Outcome outcome =
        runShell(std::string(CMAKE) + " --install " BUILD_FOLDER " --prefix " +
                     (*folder_ / "prefix") + " && cp -r " SOURCE_FOLDER "/examples examples",
                 folder_->path());
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  static void TearDownTestSuite() {
    display_.reset();
    folder_.reset();
  }
  void SetUp() override {
    if (SANITIZED) GTEST_SKIP() << "builds with sanitizers are not installed";
  }

  static void shell(const std::string& line) {
    const Outcome outcome = runShell(line, folder_->path());
    ASSERT_EQ(outcome.status, 0) << line << "\n" << outcome.out << outcome.err;
  }
  static image::Image read(const std::string& name) { return image::read(*folder_ / name); }

  // Converts the host's files to the program's: depth.exr, normal.exr, ao.exr, scene.gltf.
  static void convert(const fs::path& from) {
    const auto halvesOr = [&](const std::string& name) {
      return fs::exists(from / (name + ".f16"))
                 ? floatsOf(numbersOf<uint16_t>(from / (name + ".f16")))
                 : numbersOf<float>(from / (name + ".f32"));
    };
    image::write(imageOf(numbersOf<float>(from / "depth.f32"), 1), from / "depth.exr");
    image::write(imageOf(halvesOr("normal"), 3), from / "normal.exr");
    image::write(imageOf(halvesOr("ao"), 1), from / "ao.exr");
    std::ofstream(from / "scene.gltf") << gltfOf(fs::file_size(from / "vertices.f32"));
  }

  static inline std::unique_ptr<TemporaryFolder> folder_;
  static inline std::unique_ptr<Display> display_;
};

INSTANTIATE_TEST_SUITE_P(, Examples,
                         ::testing::Values(Example{"vulkan", "--check", "vulkan", "clip-reversed",
                                                   "world"},
                                           Example{"opengl", "", "opengl", "clip", "view"}),
                         [](const auto& test) { return test.param.name; });

TEST_P(Examples, AmbientOcclusionIsWhatTheProgramMakes) {
  const Example& example = GetParam();
  const std::string name = example.name;
  shell("mkdir out_" + name + " && cmake -G Ninja -S examples/" + name + " -B " + name +
        " -DCMAKE_PREFIX_PATH=$PWD/prefix && cmake --build " + name + " && " + name + "/" + name +
        "_host out_" + name + " " + example.more);
  const fs::path out = folder_->path() / ("out_" + name);
  convert(out);
  const std::string effect =
      std::string(" --set ssao.radius=0.5 --camera '") + kCamera + "' --backend " + example.backend;
  shell("cd " + out.string() + " && grisaille apply --depth depth.exr --depth-kind " +
        example.depth + " --near 0.1 --far 40 --normal normal.exr --normal-space " + example.space +
        effect + " --write ao=applied.exr");
  shell("cd " + out.string() + " && grisaille render scene.gltf --size 320x180" + effect +
        " --set ssao.guard_band=0 --set ssao.backs=assumed --write ao=rendered.exr");
  const image::Image ao = image::read(out / "ao.exr");
  const image::Image fromFiles = image::read(out / "applied.exr");
  const image::Difference applied = image::compare(ao, fromFiles);
  const image::Image fromScene = image::read(out / "rendered.exr");
  const image::Difference rendered = image::compare(ao, fromScene);
  std::printf("%s: largest difference from apply %.5f, from render %.5f (rmse %.6f)\n",
              example.name, applied.largest, rendered.largest, rendered.rmse);
  EXPECT_EQ(applied.nonFinite + rendered.nonFinite, 0u);
  // Clip depths that are not reversed are coarse far away, and facets follow from depths.
  EXPECT_LE(rendered.largest, 4.0 / 255);
  EXPECT_LT(image::shareOver(ao, fromScene, 1.0 / 255), 0.0005);
  EXPECT_LT(rendered.rmse, 0.0005);
  // Files round the normals once more: a sector at its edge may become occluded.
  EXPECT_LE(applied.largest, 2.5 / 255);
  EXPECT_LT(image::shareOver(ao, fromFiles, 1.0 / 255), 0.001);
  image::Image open = ao;
  std::ranges::fill(open.pixels, 1.0f);
  EXPECT_GT(image::shareOver(ao, open, 0.2), 0.05) << "no pixel is occluded";
}

// The lines that an existing renderer has to add.
TEST_P(Examples, IntegrationTakesUnder120Lines) {
  size_t lines = 0;
  for (const auto& entry :
       fs::directory_iterator(fs::path(SOURCE_FOLDER) / "examples" / GetParam().name)) {
    std::istringstream text(readFile(entry.path()));
    bool inside = false;
    for (std::string line; std::getline(text, line);) {
      if (line.find("// grisaille: begin") != std::string::npos) {
        EXPECT_FALSE(inside) << entry.path();
        inside = true;
      } else if (line.find("// grisaille: end") != std::string::npos) {
        EXPECT_TRUE(inside) << entry.path();
        inside = false;
      } else if (inside) {
        ++lines;
      } else {
        EXPECT_EQ(line.find("grisaille_"), std::string::npos) << entry.path() << ": " << line;
        EXPECT_EQ(line.find("gr::"), std::string::npos) << entry.path() << ": " << line;
      }
    }
    EXPECT_FALSE(inside) << entry.path();
  }
  const std::string name = GetParam().name;
  const std::string told = fmt::format("[examples/{0}](examples/{0}/main.cpp) {1}", name, lines);
  EXPECT_NE(readFile(fs::path(SOURCE_FOLDER) / "README.md").find(told), std::string::npos) << told;
  EXPECT_GT(lines, 20u);
  EXPECT_LT(lines, 120u);
}

}  // namespace
}  // namespace grisaille::tests
