// SPDX-License-Identifier: MIT
// The program compiles shaders per setting, not per frame or shot. Some drivers recompile a shader
// for each value of a uniform in a condition. Counts the entries of Mesa's cache; other drivers
// leave it empty.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNoCache = "the driver keeps no shaders in Mesa's cache, so none are counted";

class CompiledShaders : public ::testing::TestWithParam<const char*> {
 protected:
  // Number of shaders that this run compiles; the run must succeed.
  ptrdiff_t compiledBy(const std::string& name, std::vector<std::string> arguments) {
    const fs::path cache = folder_.path() / name;
    arguments.insert(arguments.end(), {"--backend", GetParam()});
    const Outcome outcome =
        runProgram(arguments, folder_.path(), {"MESA_SHADER_CACHE_DIR=" + cache.string()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    if (!fs::exists(cache)) return 0;
    return std::count_if(fs::recursive_directory_iterator(cache), {},
                         [](const fs::directory_entry& entry) { return entry.is_regular_file(); });
  }
  TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(Backends, CompiledShaders, ::testing::Values("opengl", "vulkan"),
                         [](const auto& parameter) { return std::string(parameter.param); });

// Mesa writes its cache in the background, and may drop the last files when the process ends.
constexpr ptrdiff_t kDropped = 2;

TEST_P(CompiledShaders, AreNoMoreForMoreShots) {
  for (const std::string mode : {"surface", "per_shot"}) {
    ptrdiff_t few = 0;
    for (const int shots : {2, 20}) {
      std::vector<std::string> arguments = {"render",      "--size", "160x90",
                                            "--effects",   "sspm",   "--write",
                                            "paint=p.exr", "--set",  "sspm.mode=" + mode};
      for (int i = 0; i < shots; ++i) {
        arguments.insert(arguments.end(),
                         {"--add", fmt::format("sspm={},45,color=#ff{:02x}00", 5 + 7 * i, i)});
      }
      const ptrdiff_t compiled = compiledBy(fmt::format("{}-{}", mode, shots), arguments);
      if (shots == 2) few = compiled;
      if (compiled == 0) GTEST_SKIP() << kNoCache;
      EXPECT_LE(compiled, few + kDropped) << mode;
    }
  }
}

TEST_P(CompiledShaders, AreNoMoreForMoreFrames) {
  ptrdiff_t few = 0;
  for (const int frames : {3, 9}) {
    const std::string path = folder_.write("path.json", fmt::format(R"({{"frames": {}, "cameras": [
          {{"eye": [-6.5, 1.75, 1.9], "target": [2.6, 2.35, -1.2], "fovy_degrees": 62}},
          {{"eye": [-5.5, 1.85, 1.7], "target": [2.6, 2.35, -1.2], "fovy_degrees": 62}}]}})",
                                                                    frames));
    const std::string name = std::to_string(frames);
    const ptrdiff_t compiled =
        compiledBy(name, {"measure", "--sweep", "ssao.history=8", "--sweep", "ssao.kernel_size=4",
                          "--size", "96x54", "--samples", "16", "--rounds", "1", "--path", path,
                          "--out", "study-" + name});
    if (frames == 3) few = compiled;
    if (compiled == 0) GTEST_SKIP() << kNoCache;
    EXPECT_LE(compiled, few + kDropped);
  }
}

}  // namespace
}  // namespace grisaille::tests
