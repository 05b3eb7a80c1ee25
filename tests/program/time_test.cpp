// SPDX-License-Identifier: MIT
// Scenes at a time of their animations: --animation, --time, and sequences of --times.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/image/image.h"
#include "tests/program/run.h"
#include "tests/support/animated_gltf.h"

namespace grisaille::tests {
namespace {

class Time : public ::testing::Test {
 protected:
  Time() { folder_.write("a.glb", animatedGlb()); }

  Outcome run(const std::vector<std::string>& arguments) {
    return runProgram(arguments, folder_.path(), {"XDG_CACHE_HOME=" + (folder_ / "cache")});
  }
  Outcome expectRuns(const std::vector<std::string>& arguments) {
    Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome;
  }
  void expectRefused(const std::vector<std::string>& arguments, const std::string& error) {
    SCOPED_TRACE(error);
    const Outcome outcome = run(arguments);
    EXPECT_NE(outcome.status, 0);
    EXPECT_NE(outcome.err.find(error), std::string::npos) << outcome.err;
  }
  std::vector<float> pixels(const std::string& name) { return image::read(folder_ / name).pixels; }

  TemporaryFolder folder_;
};

// The truth's rays and every backend's raster show the same pose.
TEST_F(Time, PictureAndTruthShowTheSamePose) {
  std::vector<std::vector<float>> truths;
  for (const auto& [animation, time] : {std::pair("move", "0.3"),
                                        {"0", "1"},
                                        {"move", "1.7"},
                                        {"jump", "0.6"},
                                        {"1", "1"},
                                        {"2", "0.4"}}) {
    SCOPED_TRACE(testing::Message() << animation << " " << time);
    const std::vector<std::string> pose = {"a.glb",  "--animation", animation, "--time",     time,
                                           "--size", "160x90",      "--write", "depth=d.exr"};
    const auto command = [&](std::vector<std::string> start) {
      start.insert(start.end(), pose.begin(), pose.end());
      return start;
    };
    expectRuns(command({"truth"}));
    truths.push_back(pixels("d.exr"));
    for (const std::string& backend : backends()) {
      expectRuns(command({"render", "--backend", backend}));
      const std::vector<float> drawn = pixels("d.exr");
      std::vector<double> errors;
      size_t covered = 0;
      for (size_t i = 0; i < drawn.size(); ++i) {
        const double depth = drawn[i], traced = truths.back()[i];
        if ((depth > 0) != (traced > 0)) ++covered;
        if (depth > 0 && traced > 0) errors.push_back(std::abs(depth - traced) / traced);
      }
      ASSERT_GT(errors.size(), 1000u);
      std::ranges::nth_element(errors, errors.begin() + static_cast<ptrdiff_t>(errors.size() / 2));
      EXPECT_LT(errors[errors.size() / 2], 1e-5) << backend;
      EXPECT_LT(covered, errors.size() / 50) << backend;
    }
  }
  for (size_t i = 1; i < truths.size(); ++i) EXPECT_NE(truths[i], truths[i - 1]);
}

// The camera and lengths of the scene at rest: each frame is the picture of its time.
TEST_F(Time, FramesOfASequenceArePicturesOfTheirTimes) {
  const std::vector<std::string> most = {"--size", "96x54", "--backend", backends().front()};
  std::vector<std::string> sequence = {"render",  "a.glb",          "--times", "0:1:1/4",
                                       "--write", "depth=d.##.exr", "--write", "ao=%d.exr"};
  sequence.insert(sequence.end(), most.begin(), most.end());
  const Outcome outcome = expectRuns(sequence);
  EXPECT_NE(outcome.out.find("wrote d.00.exr to d.04.exr"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("wrote 0.exr to 4.exr"), std::string::npos) << outcome.out;
  for (int i = 0; i <= 4; ++i) {
    const std::string number = std::to_string(i);
    std::vector<std::string> one = {"render",  "a.glb",       "--time",  std::to_string(0.25 * i),
                                    "--write", "depth=d.exr", "--write", "ao=ao.exr"};
    one.insert(one.end(), most.begin(), most.end());
    expectRuns(one);
    EXPECT_EQ(pixels("d.exr"), pixels("d.0" + number + ".exr")) << i;
    EXPECT_EQ(pixels("ao.exr"), pixels(number + ".exr")) << i;
  }
  EXPECT_NE(pixels("d.00.exr"), pixels("d.02.exr"));
  expectRuns({"render", "a.glb", "--size", "16x9", "--animation", "jump", "--times", "0:1:1"});
  EXPECT_TRUE(std::filesystem::exists(folder_ / "grisaille.0001.png"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "grisaille.0002.png"));
}

TEST_F(Time, WithoutOptionsTheSceneIsAtRest) {
  const auto draw = [&](const std::string& file, std::vector<std::string> pose) {
    pose.insert(pose.begin(), {"render", "a.glb", "--size", "96x54", "--camera",
                               R"({"eye": [0, 4, 8], "target": [0, 1, 0], "fovy_degrees": 40})",
                               "--write", "depth=" + file});
    expectRuns(pose);
  };
  draw("rest.exr", {});
  draw("time.exr", {"--time", "0"});
  draw("start.exr", {"--animation", "0"});
  EXPECT_EQ(pixels("time.exr"), pixels("start.exr"));
  EXPECT_NE(pixels("time.exr"), pixels("rest.exr"));
}

// The camera that the program chooses holds the animation at all times.
TEST_F(Time, TheDefaultCameraHoldsTheAnimation) {
  expectRuns({"scene", "a.glb", "--write-camera", "rest.json"});
  expectRuns(
      {"scene", "a.glb", "--animation", "high", "--time", "0.7", "--write-camera", "c.json"});
  EXPECT_NE(readFile(folder_ / "rest.json"), readFile(folder_ / "c.json"));
  expectRuns({"render", "a.glb", "--size", "96x54", "--animation", "high", "--times", "0:1:1/8",
              "--write", "depth=d.##.exr"});
  for (int i = 0; i <= 8; ++i) {
    const image::Image depth = image::read(folder_ / ("d.0" + std::to_string(i) + ".exr"));
    size_t seen = 0, border = 0;
    for (uint32_t y = 0; y < depth.height; ++y) {
      for (uint32_t x = 0; x < depth.width; ++x) {
        if (depth.at(x, y, 0) == 0) continue;
        ++seen;
        if (x == 0 || y == 0 || x + 1 == depth.width || y + 1 == depth.height) ++border;
      }
    }
    EXPECT_GT(seen, 100u) << i;
    EXPECT_EQ(border, 0u) << i;
  }
}

TEST_F(Time, SceneListsAnimationsAndWritesAPose) {
  const Outcome outcome = expectRuns({"scene", "a.glb"});
  for (const char* line : {"\nanimation 0: move, 2 s\n", "\nanimation 1: jump, 1 s\n",
                           "\nanimation 2: 0.5 s\n", "\nanimation 3: high, 1 s\n"}) {
    EXPECT_NE(outcome.out.find(line), std::string::npos) << outcome.out;
  }
  expectRuns({"scene", "a.glb", "--animation", "move", "--time", "1.25", "--write", "p.glb",
              "--write-camera", "c.json"});
  const std::vector<std::string> view = {"--camera", "c.json", "--size", "96x54", "--write"};
  std::vector<std::string> posed = {"render", "a.glb", "--animation", "move", "--time", "1.25"};
  std::vector<std::string> written = {"render", "p.glb"};
  for (auto* command : {&posed, &written}) {
    command->insert(command->end(), view.begin(), view.end());
  }
  posed.push_back("depth=a.exr"), written.push_back("depth=b.exr");
  expectRuns(posed);
  expectRuns(written);
  const std::vector<float> a = pixels("a.exr"), b = pixels("b.exr");
  size_t different = 0;
  for (size_t i = 0; i < a.size(); ++i) different += std::abs(a[i] - b[i]) > 1e-4f * a[i];
  EXPECT_LT(different, a.size() / 200);
  EXPECT_EQ(expectRuns({"scene", "p.glb"}).out.find("animation"), std::string::npos);
}

TEST_F(Time, MistakesAreNamed) {
  const auto render = [](std::vector<std::string> more) {
    more.insert(more.begin(), {"render", "a.glb", "--size", "16x9"});
    return more;
  };
  expectRefused(render({"--animation", "mov"}),
                "E2107: there is no animation 'mov', did you mean 'move'?");
  expectRefused(render({"--animation", "4"}),
                "E2107: there is no animation 4; the scene has 4, from 0 to 3");
  expectRefused(render({"--time", "2.5"}), "E2107: 2.5 s is after the end of move; give 0 to 2");
  expectRefused(render({"--animation", "2", "--time", "1"}),
                "E2107: 1 s is after the end of animation 2; give 0 to 0.5");
  for (const char* time : {"-1", "nan", "inf", "1s"}) {
    expectRefused(render({"--time", time}),
                  "--time: '" + std::string(time) + "' is not a number of 0 or more");
  }
  for (const char* command : {"render", "truth", "scene", "measure"}) {
    std::vector<std::string> words = {command, "--time", "1"};
    if (words[0] == "truth") words.insert(words.end(), {"--write", "ao=ao.exr"});
    if (words[0] == "measure") words.insert(words.end(), {"--out", "study"});
    expectRefused(words, "E2107: the scene has no animations");
  }
  expectRefused(render({"--times", "0:3:1"}), "E2107: 3 s is after the end of move");
  expectRefused(render({"--times", "0:1"}), "E5101: '0:1' is not of the form FIRST:LAST:STEP");
  expectRefused(render({"--times", "0:1:1e-9"}), "E5101: '0:1:1e-9' has more than 100000 frames");
  expectRefused(render({"--times", "0:1:1", "--time", "1"}), "--times");
  expectRefused(render({"--times", "0:1:1", "--frames", "2"}), "--times");
  expectRefused(render({"--times", "0:1:1", "--coverage", "-"}), "--times");
  expectRefused(render({"--times", "0:1:1", "--write", "ao=a.exr"}),
                "E5507: 'a.exr' has no frame number, but --times or --path writes a sequence");
  expectRefused(render({"--write", "ao=a.##.exr"}),
                "E5507: 'a.##.exr' has a frame number, but neither --times nor --path is given");
  expectRefused(
      render({"--times", "0:1:1", "--write", "ao=a.##.exr", "--write", "depth=a.%02d.exr"}),
      "name the same file");
  std::filesystem::remove_all(folder_ / "cache");  // of the driver
  EXPECT_EQ(folder_.files(), (std::vector<std::string>{"a.glb"}));
}

// Each frame is the picture of its camera, and of its time if the animation plays, too.
TEST_F(Time, ASequenceFollowsAPath) {
  const std::string first = R"({"eye": [0, 2, 6], "target": [0, 0.5, 0], "fovy_degrees": 60})";
  const std::string last = R"({"eye": [4, 2, 6], "target": [0, 0.5, 0], "fovy_degrees": 40})";
  const std::string middle = R"({"eye": [2, 2, 6], "target": [0, 0.5, 0], "fovy_degrees": 50})";
  folder_.write("p.json", "{\"frames\": 5, \"cameras\": [" + first + ", " + last + "]}");
  const std::vector<std::string> common = {"render", "a.glb",     "--size",
                                           "64x36",  "--effects", "ssao"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), common.begin(), common.end());
    return more;
  };
  const Outcome outcome =
      expectRuns(with({"--path", "p.json", "--json", "--write", "depth=p.##.exr"}));
  const auto told = nlohmann::json::parse(outcome.out.substr(0, outcome.out.find('\n')));
  EXPECT_EQ(told["progress"], "render");
  expectRuns(with({"--path", "p.json", "--times", "0:1:1/2", "--write", "depth=t.##.exr"}));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "p.05.exr"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "t.03.exr"));
  const auto expectPicture = [&](const std::string& name, const std::string& camera,
                                 std::vector<std::string> pose) {
    pose.insert(pose.end(), {"--camera", camera, "--write", "depth=one.exr"});
    expectRuns(with(pose));
    EXPECT_EQ(pixels(name), pixels("one.exr")) << name;
  };
  expectPicture("p.00.exr", first, {});
  expectPicture("p.02.exr", middle, {});
  expectPicture("p.04.exr", last, {});
  expectPicture("t.01.exr", middle, {"--time", "0.5"});
  expectRefused(with({"--path", "p.json", "--camera", first}), "--camera");
  expectRefused(with({"--path", "p.json", "--write", "depth=p.exr"}), "E5507");
  expectRefused(with({"--path", "missing.json"}), "missing.json");
  expectRefused(with({"--path", "p.json", "--times", "0:0:1"}), "frames is not from 2");
}

// With the ffmpeg of the machine, where it is there.
TEST_F(Time, ASequenceBecomesAVideo) {
  const auto with = [](const std::string& video, const std::string& file = "color=f.##.png") {
    return std::vector<std::string>{"render",  "a.glb",   "--size",  "65x36", "--effects", "",
                                    "--times", "0:1:1/8", "--write", file,    "--video",   video};
  };
  expectRefused(with("v.mp4", "depth=f.##.exr"), "--video needs .png");
  expectRefused(with("video"), "E5513");
  expectRefused({"render", "a.glb", "--video", "v.mp4"}, "--video needs --times or --path");
  const Outcome missing =
      runProgram(with("v.mp4"), folder_.path(),
                 {"XDG_CACHE_HOME=" + (folder_ / "cache"), "PATH=" + folder_.path().string()});
  EXPECT_NE(missing.err.find("E5513"), std::string::npos) << missing.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "f.00.png"));  // before any slow work
  if (runShell("ffmpeg -version", folder_.path()).status != 0) GTEST_SKIP() << "no ffmpeg";
  folder_.write("f.09.png", "of a longer sequence, and no picture");
  const Outcome outcome = expectRuns(with("v.mp4"));
  EXPECT_NE(outcome.out.find("wrote v.mp4"), std::string::npos) << outcome.out;
  const Outcome told = runShell(
      "ffprobe -v error -count_frames -show_entries "
      "stream=width,height,r_frame_rate,nb_read_frames "
      "-of csv=p=0 v.mp4",
      folder_.path());
  EXPECT_EQ(told.out, "66,36,8/1,9\n") << told.err;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "f.08.png"));
  // A format that ffmpeg does not know.
  expectRefused(with("v.nothing"), "E5513");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "v.nothing"));
}

TEST_F(Time, AnInterruptedSequenceLeavesWholeFiles) {
  const Outcome outcome = runShell(
      "grisaille render a.glb --size 96x54 --times 0:2:1/20000 --write depth=d.####.exr 2> err & "
      "child=$!; until [ -e d.0002.exr ]; do kill -0 $child || break; sleep 0.05; done; "
      "kill -INT $child; wait $child; echo status $?",
      folder_.path());
  EXPECT_NE(outcome.out.find("status 130\n"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("wrote d.0000.exr to "), std::string::npos) << outcome.out;
  const std::string err = readFile(folder_ / "err");
  EXPECT_NE(err.find("note: interrupted after "), std::string::npos) << err;
  size_t frames = 0;
  for (const std::string& file : folder_.files()) {
    if (!file.starts_with("d.")) continue;
    EXPECT_TRUE(file.ends_with(".exr")) << file;
    EXPECT_EQ(pixels(file).size(), 96u * 54u) << file;
    ++frames;
  }
  EXPECT_GE(frames, 3u);
  EXPECT_LT(frames, 40001u);
}

// The poses of a study are separate settings, with their own truth and command.
TEST_F(Time, MeasureKeepsTimesApart) {
  const auto measured = [&](const std::string& time) {
    expectRuns({"measure", "a.glb", "--time", time, "--sweep", "ssao.kernel_size=6", "--size",
                "64x36", "--samples", "16", "--rounds", "1", "--backend", backends().front(),
                "--out", "study"});
    return nlohmann::json::parse(readFile(folder_ / "study/results.json"));
  };
  const auto records = [&] {
    size_t count = 0;
    for (const auto& file : std::filesystem::directory_iterator(folder_ / "study/records")) {
      count += file.path().extension() == ".json" ? 1 : 0;
    }
    return count;
  };
  measured("0.5");
  const size_t first = records();
  EXPECT_GT(first, 0u);
  const std::string all = measured("1.5").dump();
  EXPECT_EQ(records(), 2 * first);
  EXPECT_NE(all.find("--animation 0 --time 0.5 "), std::string::npos) << all;
  EXPECT_NE(all.find("--animation 0 --time 1.5 "), std::string::npos) << all;
}

}  // namespace
}  // namespace grisaille::tests
