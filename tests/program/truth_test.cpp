// SPDX-License-Identifier: MIT
// `grisaille truth`: caching, resuming, interruption, errors, and the contents of its pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/image/image.h"
#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

class TruthCommand : public ::testing::Test {
 protected:
  Outcome truth(std::vector<std::string> arguments, const std::string& size = "64x36") {
    arguments.insert(arguments.begin(), {"truth", "--size", size});
    return runProgram(arguments, folder_.path(), {"XDG_CACHE_HOME=" + cache_.path().string()});
  }
  // Runs the command and returns the bytes of ao.exr.
  std::string traced(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--write", "ao=ao.exr"});
    last_ = truth(arguments);
    EXPECT_EQ(last_.status, 0) << last_.err;
    return readFile(folder_ / "ao.exr");
  }
  bool says(const std::string& text) const { return last_.out.find(text) != std::string::npos; }
  std::vector<std::filesystem::path> kept() const {
    std::vector<std::filesystem::path> files;
    const auto folder = cache_.path() / "grisaille" / "truth";
    if (!std::filesystem::exists(folder)) return files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      files.push_back(entry.path());
    }
    return files;
  }
  void expectError(const std::vector<std::string>& arguments, int number,
                   const std::string& mention = "") {
    SCOPED_TRACE(mention);
    const Outcome outcome = truth(arguments);
    EXPECT_TRUE(outcome.status == 1 || outcome.status == 2) << outcome.status;
    EXPECT_EQ(outcome.err.rfind("error E" + std::to_string(number) + ": ", 0), 0u) << outcome.err;
    EXPECT_NE(outcome.err.find(mention), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(folder_.files().empty());
  }

  TemporaryFolder folder_, cache_;
  Outcome last_;
};

TEST_F(TruthCommand, WritesWhatRaysSee) {
  const Outcome outcome =
      truth({"--samples", "64", "--write", "ao=ao.exr", "--write", "ao_error=e.exr", "--write",
             "depth=d.exr", "--write", "normal=n.exr", "--write", "normal=n.png"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find("ao: 64 samples per pixel, rms standard error 0.0"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("rays per second"), std::string::npos);
  const image::Image ao = image::read(folder_ / "ao.exr"), error = image::read(folder_ / "e.exr");
  const image::Image depth = image::read(folder_ / "d.exr"),
                     normal = image::read(folder_ / "n.exr");
  ASSERT_EQ(ao.width, 64u);
  ASSERT_EQ(normal.channels, 3u);
  double squares = 0;
  size_t surfaces = 0;
  for (uint32_t y = 0; y < 36; ++y) {
    for (uint32_t x = 0; x < 64; ++x) {
      const double length = std::hypot(normal.at(x, y, 0), normal.at(x, y, 1), normal.at(x, y, 2));
      EXPECT_NEAR(length, depth.at(x, y) > 0 ? 1 : 0, 1e-6);
      if (depth.at(x, y) == 0) {
        EXPECT_EQ(ao.at(x, y), 1);
        EXPECT_EQ(error.at(x, y), 0);
        continue;
      }
      if (std::isnan(error.at(x, y))) continue;
      EXPECT_GE(ao.at(x, y), 0);
      EXPECT_LE(ao.at(x, y), 1);
      squares += error.at(x, y) * error.at(x, y);
      ++surfaces;
    }
  }
  EXPECT_GT(surfaces, 1000u);
  const double rms = std::sqrt(squares / static_cast<double>(surfaces));
  EXPECT_GT(rms, 0.001);
  EXPECT_LT(rms, 0.05);
}

TEST_F(TruthCommand, ResumedItIsTheSameToTheBit) {
  const std::string whole = traced({"--samples", "200", "--no-cache"});
  EXPECT_TRUE(kept().empty());
  const std::string few = traced({"--samples", "70"});
  ASSERT_EQ(kept().size(), 1u);
  EXPECT_NE(few, whole);
  EXPECT_EQ(traced({"--samples", "200"}), whole);
  EXPECT_TRUE(says("200 samples per pixel (70 of them from the cache)")) << last_.out;
  // Same number of samples: no rays are cast. Fewer: the cached ones are kept and used.
  EXPECT_EQ(traced({"--samples", "200"}), whole);
  EXPECT_TRUE(says("no rays cast")) << last_.out;
  EXPECT_EQ(traced({"--samples", "70"}), whole);
  EXPECT_EQ(kept().size(), 1u);
}

TEST_F(TruthCommand, WhatChangesThePictureIsKeptApart) {
  const std::string first = traced({"--samples", "16"});
  for (const std::vector<std::string>& other :
       {std::vector<std::string>{"--radius", "0.4"},
        {"--seed", "2"},
        {"--camera", R"({"eye": [0, 2, 3], "target": [0, 1, 0], "fovy_degrees": 60})"}}) {
    std::vector<std::string> arguments = {"--samples", "16"};
    arguments.insert(arguments.end(), other.begin(), other.end());
    EXPECT_NE(traced(arguments), first) << other[0];
    EXPECT_FALSE(says("from the cache")) << other[0];
  }
  EXPECT_EQ(kept().size(), 4u);
  // The same scene from a file counts as the same scene, whatever the file's name.
  const Outcome scene = runProgram({"scene", "--write", "a.glb"}, folder_.path());
  ASSERT_EQ(scene.status, 0) << scene.err;
  std::filesystem::copy(folder_ / "a.glb", folder_ / "b.glb");
  const std::string camera = R"({"eye": [0, 2, 3], "target": [0, 1, 0], "fovy_degrees": 60})";
  const std::string read = traced({"a.glb", "--camera", camera, "--samples", "16"});
  EXPECT_EQ(traced({"b.glb", "--camera", camera, "--samples", "16"}), read);
  EXPECT_TRUE(says("no rays cast")) << last_.out;
}

TEST_F(TruthCommand, ADamagedFileIsANoteAndThrownAway) {
  const std::string sound = traced({"--samples", "64"});
  ASSERT_EQ(kept().size(), 1u);
  const std::filesystem::path file = kept()[0];
  const std::string bytes = readFile(file);
  std::string turned = bytes;
  turned[bytes.size() / 2] = static_cast<char>(turned[bytes.size() / 2] ^ 4);
  const std::string damages[] = {turned, bytes.substr(0, bytes.size() - 1), bytes + "x", "",
                                 "junk"};
  for (const std::string& damaged : damages) {
    std::ofstream(file, std::ios::binary) << damaged;
    EXPECT_EQ(traced({"--samples", "64"}), sound);
    EXPECT_NE(last_.err.find("note: "), std::string::npos) << last_.err;
    EXPECT_NE(last_.err.find("damaged"), std::string::npos) << last_.err;
    EXPECT_EQ(readFile(file), bytes);
  }
}

TEST_F(TruthCommand, WithoutAPlaceToKeepItIsANoteAndGoesOn) {
  const std::string sound = traced({"--samples", "64"});
  const TemporaryFolder blocked;
  blocked.write("grisaille", "a file where a folder should be");
  const Outcome outcome =
      runProgram({"truth", "--size", "64x36", "--samples", "64", "--write", "ao=b.exr"},
                 folder_.path(), {"XDG_CACHE_HOME=" + blocked.path().string()});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err.rfind("note: ", 0), 0u) << outcome.err;
  EXPECT_EQ(readFile(folder_ / "b.exr"), sound);
}

TEST_F(TruthCommand, EndsOnceTheErrorIsSmallEnough) {
  traced({"--samples", "4096", "--error", "0.02"});
  const size_t at = last_.out.find("ao: ");
  ASSERT_NE(at, std::string::npos);
  EXPECT_LT(std::stoi(last_.out.substr(at + 4)), 1024) << last_.out;
  const size_t error = last_.out.find("error ", at);
  EXPECT_LE(std::stod(last_.out.substr(error + 6)), 0.02) << last_.out;
}

TEST_F(TruthCommand, AnInterruptionKeepsWhatIsDone) {
  for (const std::string signal : {"INT", "TERM"}) {
    const std::string seed = signal == "INT" ? "5" : "6";
    const std::string options = "--size 64x36 --seed " + seed + " --write ao=ao.exr";
    const Outcome outcome = runShell(
        // Deletes the previous run's messages, which the wait would mistake for this run's.
        "rm -f err; export XDG_CACHE_HOME=" + cache_.path().string() + "; grisaille truth " +
            options +
            " --samples 262144 --progress 2> err & child=$!; until grep -q 'samples per pixel, "
            "error' "
            "err; do kill -0 $child || break; sleep 0.05; done; kill -" +
            signal + " $child; wait $child; echo status $?",
        folder_.path());
    EXPECT_EQ(outcome.out, "status 130\n") << outcome.err;
    const std::string err = readFile(folder_ / "err");
    EXPECT_NE(err.find("note: interrupted; "), std::string::npos) << err;
    EXPECT_NE(err.find("% "), std::string::npos);
    EXPECT_NE(err.find(" left"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "ao.exr"));
    traced({"--samples", "16", "--seed", seed});
    EXPECT_TRUE(says("from the cache")) << last_.out;
    EXPECT_TRUE(says("no rays cast")) << last_.out;
    std::filesystem::remove(folder_ / "ao.exr");
  }
}

// The best result that the depth buffer allows is closer to the truth than the effect's result.
TEST_F(TruthCommand, TheCeilingIsAboveSsao) {
  const Outcome outcome = truth({"--samples", "256", "--write", "ao=ao.exr", "--write",
                                 "ceiling=c.exr", "--write", "ceiling_error=ce.exr"},
                                "256x144");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("ceiling: 256 samples per pixel"), std::string::npos) << outcome.out;
  const Outcome render =
      runProgram({"render", "--size", "256x144", "--write", "ao=s.exr"}, folder_.path());
  ASSERT_EQ(render.status, 0) << render.err;
  const image::Image ao = image::read(folder_ / "ao.exr");
  const image::Difference ceiling = image::compare(image::read(folder_ / "c.exr"), ao);
  const image::Difference ssao = image::compare(image::read(folder_ / "s.exr"), ao);
  const image::Similarity ceilingSsim = image::ssim(image::read(folder_ / "c.exr"), ao);
  const image::Similarity ssaoSsim = image::ssim(image::read(folder_ / "s.exr"), ao);
  std::printf("ceiling: RMSE %.4f, SSIM %.4f; ssao: RMSE %.4f, SSIM %.4f\n", ceiling.rmse,
              ceilingSsim.mean, ssao.rmse, ssaoSsim.mean);
  EXPECT_LT(ceiling.rmse, 0.95 * ssao.rmse);
  EXPECT_GT(ceilingSsim.mean, ssaoSsim.mean);
  EXPECT_LT(ceiling.rmse, 0.1);
  // Each thickness has its own estimate.
  const Outcome thick =
      truth({"--samples", "256", "--thickness", "5", "--write", "ceiling=t.exr"}, "256x144");
  ASSERT_EQ(thick.status, 0) << thick.err;
  EXPECT_EQ(thick.out.find("from the cache"), std::string::npos) << thick.out;
  EXPECT_LT(image::compare(image::read(folder_ / "t.exr"), ao).bias, ceiling.bias);
}

TEST_F(TruthCommand, WhatIsWrongIsRefusedByName) {
  const std::vector<std::string> ao = {"--write", "ao=a.exr"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), ao.begin(), ao.end());
    return more;
  };
  expectError({}, 5101, "--write");
  expectError({"--write", "ao"}, 5101, "NAME=FILE");
  expectError({"--write", "shadow=a.exr"}, 5106, "shadow");
  expectError({"--write", "ao=a.jpg"}, 4102, "a.jpg");
  expectError({"--write", "depth=no/such/folder/a.exr"}, 4103);
  for (const char* radius : {"0", "-1", "nan", "inf", "1e7"}) {
    expectError(with({"--radius", radius}), 5101, "--radius");
  }
  expectError(with({"--samples", "0"}), 5101, "--samples");
  expectError(with({"--samples", "300000"}), 5101, "--samples");
  expectError(with({"--samples", "many"}), 5101, "--samples");
  expectError(with({"--error", "-0.1"}), 5101, "--error");
  expectError(with({"--error", "nan"}), 5101, "--error");
  expectError(with({"--thickness", "1"}), 5101, "--thickness");
  expectError({"--write", "ceiling=a.exr", "--thickness", "-1"}, 5101, "--thickness");
  expectError({"--write", "mask=a.exr"}, 5106, "mask");
  expectError(with({"--camera", "{}"}), 2202);
  expectError(with({"no such scene.glb"}), 2101, "no such scene.glb");
  expectError(with({"--size", "0x9"}), 5101);
}

}  // namespace
}  // namespace grisaille::tests
