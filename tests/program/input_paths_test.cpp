// SPDX-License-Identifier: MIT
// Paths that name no regular file give a numbered error at once, which names the kind of file.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>

#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

class InputPaths : public testing::Test {
 protected:
  InputPaths() {
    for (const char* ending : {"toml", "json", "glb", "exr"}) {
      EXPECT_EQ(mkfifo((folder_ / (std::string("pipe.") + ending)).c_str(), 0600), 0);
      fs::create_directory(folder_ / (std::string("folder.") + ending));
      fs::create_symlink("/dev/zero", folder_ / (std::string("device.") + ending));
    }
  }
  // A hanging command gets SIGKILL after 20 seconds: commands that trace handle SIGTERM themselves.
  Outcome run(const std::string& words) const {
    return runShell(
        "XDG_CACHE_HOME=$PWD/cache timeout -s KILL 20 " + programOf(words) + " " + words,
        folder_.path());
  }
  void expectRefused(const std::string& words, int number, const std::string& mention,
                     int status = 1) const {
    SCOPED_TRACE(words);
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("error E" + std::to_string(number) + ": ", 0), 0u) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(mention), std::string::npos) << mention << ": " << outcome.err;
  }

  TemporaryFolder folder_;
};

struct Reader {
  std::string words, ending;
  int number;
};

TEST_F(InputPaths, EveryReaderNamesWhatIsNoRegularFile) {
  const std::string render = "render --size 8x8 --write depth=out.exr ";
  const Reader readers[] = {
      {render, "glb", 2101},
      {render + "--camera", "json", 2201},
      {render + "--config", "toml", 5103},
      {render + "--effects sspm --load sspm=", "json", 3411},
      {"apply --camera '{}' --write ao=out.exr --depth", "exr", 4101},
      {"measure --size 8x8 --out out --effects sspm --output sspm.paint --reference r.exr --load "
       "sspm=",
       "json", 3411},
      {"measure --size 8x8 --out out --sweep ssao.kernel_size=2 --camera", "json", 2201},
      {"measure --size 8x8 --out out --sweep ssao.kernel_size=2 --path", "json", 2201},
      {"tune --size 8x8 --max-error 1 --out out.toml --validate", "json", 2201},
      {"claims --out out", "toml", 5103},
      {"scene", "glb", 2101},
  };
  for (const auto& [words, ending, number] : readers) {
    const std::string before = words.ends_with('=') ? words : words + " ";
    expectRefused(before + "pipe." + ending, number, "pipe." + ending + ": it is a named pipe");
    expectRefused(before + "folder." + ending, number, "folder." + ending + ": it is a folder");
    expectRefused(before + "device." + ending, number, "device." + ending + ": it is a device");
  }
  EXPECT_FALSE(fs::exists(folder_ / "out.exr"));
}

TEST_F(InputPaths, ATruthCacheFileThatIsNoFileIsNamed) {
  const std::string truth = "truth --size 8x8 --samples 16 --write ao=t.exr";
  ASSERT_EQ(run(truth).status, 0);
  const fs::path file = fs::directory_iterator(folder_ / "cache/grisaille/truth")->path();
  fs::remove(file);
  ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
  expectRefused(truth, 5107, file.string() + ": it is a named pipe");
  EXPECT_TRUE(fs::is_fifo(file));
  fs::remove(file);
  fs::create_directory(file);
  expectRefused(truth, 5107, file.string() + ": it is a folder");
  EXPECT_TRUE(fs::is_directory(file));
  EXPECT_EQ(run(truth + " --no-cache").status, 0);
}

TEST_F(InputPaths, AStudyRecordThatIsNoFileIsNamed) {
  const std::string measure =
      "measure --size 16x16 --samples 16 --rounds 1 --backend opengl --sweep ssao.kernel_size=2 "
      "--out s";
  const Outcome outcome = run(measure);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const fs::path file = fs::directory_iterator(folder_ / "s/records")->path();
  fs::remove(file);
  ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
  expectRefused("measure --report --out s", 5301,
                file.filename().string() + ": it is a named pipe");
  fs::remove(file);
  fs::create_directory(file);
  expectRefused("measure --report --out s", 5301, file.filename().string() + ": it is a folder");
}

TEST_F(InputPaths, AnEmptyPathIsAMistakeOfUsage) {
  for (const std::string words : {
           "render ''",
           "render --camera ''",
           "render --config ''",
           "render --timings ''",
           "render --coverage ''",
           "render --plugin-path ''",
           "render --write ao=",
           "render --write ''",
           "render --effects sspm --load sspm=",
           "render --effects sspm --save sspm=",
           "apply --depth '' --write ao=out.exr",
           "apply --depth d.exr --normal '' --write ao=out.exr",
           "truth '' --write ao=out.exr",
           "render --effects sspm --add sspm=",
           "measure --out out --effects sspm --load sspm=",
           "scene --write ''",
           "scene ''",
           "measure --out '' --sweep ssao.kernel_size=2",
           "measure --out out --presets ''",
           "tune --max-error 1 --out ''",
           "tune --max-error 1 --out out.toml --validate ''",
           "claims '' --out out",
           "stability --out ''",
           "effects --verify ''",
           "new-effect mist ''",
           "view --camera ''",
           "view --bookmarks ''",
       }) {
    expectRefused(words, 5101, "", 2);
  }
  expectRefused("render --camera ''", 5101, "--camera: the value is empty", 2);
  EXPECT_FALSE(fs::exists(folder_ / "grisaille.png"));
  // An empty list of effects is valid.
  EXPECT_EQ(run("render --size 8x8 --effects '' --write color=c.png").status, 0);
}

}  // namespace
}  // namespace grisaille::tests
