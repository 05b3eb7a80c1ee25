// SPDX-License-Identifier: MIT
// Output files: no two outputs share a file; an overwritten file keeps its owner and mode; symbolic
// links, devices and pipes work.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

struct stat statOf(const std::string& path) {
  struct stat status = {};
  EXPECT_EQ(lstat(path.c_str(), &status), 0) << path;
  return status;
}

class OutputPaths : public testing::Test {
 protected:
  Outcome run(const std::string& words) const {
    return runShell("XDG_CACHE_HOME=$PWD/cache timeout 60 grisaille " + words, folder_.path());
  }
  void expectWritten(const std::string& words) const {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 0) << words << outcome.err;
  }
  TemporaryFolder folder_;
};

TEST_F(OutputPaths, TwoOutputsOfOneFileAreRefusedBeforeAnyWork) {
  fs::create_symlink("x.exr", folder_ / "link.exr");
  fs::create_symlink(".", folder_ / "here");
  const std::string render = "render --size 8x8 ", sspm = render + "--effects sspm ";
  for (const std::string& words : {
           render + "--write ao=x.exr --write depth=x.exr",
           render + "--write ao=x.exr --write depth=./x.exr",
           render + "--write ao=x.exr --write depth=$PWD/x.exr",
           render + "--write ao=x.exr --write depth=link.exr",
           render + "--write ao=link.exr --write depth=here/x.exr",
           render + "--write ao=x.exr --timings x.exr",
           render + "--timings grisaille.png",
           sspm + "--timings x.csv --coverage ./x.csv",
           sspm + "--save sspm=x.json --coverage x.json",
           sspm + "--save sspm=x.json --save sspm=x.json",
           std::string("apply --depth d.exr --write ao=x.exr --write depth=x.exr"),
           std::string("truth --size 8x8 --write ao=x.exr --write depth=here/x.exr"),
           std::string("scene --write x.glb --write-camera ./x.glb"),
           std::string("measure --out s --sweep ssao.kernel_size=2 --presets s/results.csv"),
           std::string("view --capture x.png --layout ./x.png"),
       }) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 2) << words << outcome.err;
    EXPECT_EQ(outcome.err.rfind("error E5101: ", 0), 0u) << words << outcome.err;
    EXPECT_NE(outcome.err.find("the same file"), std::string::npos) << words << outcome.err;
    EXPECT_EQ(outcome.out, "") << words;
  }
  EXPECT_EQ(folder_.files(), (std::vector<std::string>{"here", "link.exr"}));
  const Outcome named = run(render + "--write ao=x.exr --write depth=./x.exr");
  EXPECT_NE(named.err.find("--write ao=x.exr and --write depth=./x.exr"), std::string::npos)
      << named.err;
}

TEST_F(OutputPaths, FramesOfASequenceMustNotMeet) {
  expectWritten("render --size 8x8 --write depth=d.1.exr");
  fs::copy_file(folder_ / "d.1.exr", folder_ / "d.11.exr");
  const Outcome outcome =
      run("apply --depth d.%d.exr --write ao=a.%d1.exr --write depth=a.1%d.exr");
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("a.11.exr"), std::string::npos) << outcome.err;
}

TEST_F(OutputPaths, AReplacedFileKeepsItsMode) {
  for (const char* name : {"ao.exr", "t.csv", "s.json"}) {
    chmod(folder_.write(name, "old").c_str(), 0640);
  }
  expectWritten(
      "render --size 8x8 --effects ssao,sspm --write ao=ao.exr --timings t.csv --save sspm=s.json");
  for (const char* name : {"ao.exr", "t.csv", "s.json"}) {
    EXPECT_NE(readFile(folder_ / name), "old");
    EXPECT_EQ(statOf(folder_ / name).st_mode & 07777, 0640u) << name;
  }
  const Outcome fresh =
      runShell("umask 027; grisaille render --size 8x8 --write ao=new.exr", folder_.path());
  EXPECT_EQ(fresh.status, 0) << fresh.err;
  EXPECT_EQ(statOf(folder_ / "new.exr").st_mode & 07777, 0640u);
}

TEST_F(OutputPaths, AReplacedFileKeepsItsOwner) {
  if (geteuid() != 0) GTEST_SKIP() << "only root may change a file's owner";
  const std::string file = folder_.write("ao.exr", "old");
  ASSERT_EQ(chown(file.c_str(), 1234, 4321), 0);
  expectWritten("render --size 8x8 --write ao=ao.exr");
  EXPECT_EQ(statOf(file).st_uid, 1234u);
  EXPECT_EQ(statOf(file).st_gid, 4321u);
}

TEST_F(OutputPaths, ASymbolicLinkStaysAndItsTargetIsWritten) {
  fs::create_directory(folder_ / "elsewhere");
  folder_.write("elsewhere/target.exr", "old");
  fs::create_symlink("elsewhere/target.exr", folder_ / "link.exr");
  fs::create_symlink("link.exr", folder_ / "second.exr");
  fs::create_symlink("elsewhere/new.exr", folder_ / "dangling.exr");
  expectWritten("render --size 8x8 --write ao=second.exr --write depth=dangling.exr");
  for (const char* link : {"second.exr", "link.exr", "dangling.exr"}) {
    EXPECT_TRUE(fs::is_symlink(folder_ / link)) << link;
  }
  EXPECT_GT(fs::file_size(folder_ / "elsewhere/target.exr"), 100u);
  EXPECT_TRUE(fs::is_regular_file(folder_ / "elsewhere/new.exr"));
  // A link to itself is an error.
  fs::create_symlink("loop.exr", folder_ / "loop.exr");
  const Outcome loop = run("render --size 8x8 --write ao=loop.exr");
  EXPECT_EQ(loop.err.rfind("error E4103: loop.exr: ", 0), 0u) << loop.err;
}

TEST_F(OutputPaths, ADeviceIsWrittenAndNeverReplaced) {
  const std::string null = folder_ / "null.csv";
  if (mknod(null.c_str(), S_IFCHR | 0666, makedev(1, 3)) != 0) {
    GTEST_SKIP() << "cannot create a device node here";
  }
  if (const int opened = open(null.c_str(), O_WRONLY); opened < 0) {
    GTEST_SKIP() << "device nodes do not work here";
  } else {
    close(opened);
  }
  expectWritten("render --size 8x8 --write ao=a.exr --timings null.csv");
  EXPECT_TRUE(S_ISCHR(statOf(null).st_mode));
  fs::create_symlink("null.csv", folder_ / "null.png");
  expectWritten("render --size 8x8 --write ao=null.png");
  EXPECT_TRUE(S_ISCHR(statOf(null).st_mode));
  EXPECT_TRUE(fs::is_symlink(folder_ / "null.png"));
}

TEST_F(OutputPaths, ANamedPipeIsWrittenAndNeverReplaced) {
  const std::string pipe = folder_ / "pipe.csv";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const Outcome outcome = runShell(
      "timeout 60 cat pipe.csv > read.csv & timeout 60 grisaille render --size 8x8 "
      "--write ao=a.exr --timings pipe.csv; status=$?; wait; exit $status",
      folder_.path());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(readFile(folder_ / "read.csv").rfind("frame,effect,pass,", 0), 0u);
}

// Uses a copy of the link /dev/stdout, in a folder where a faulty program could replace it. Also
// with standard output redirected to a file.
TEST_F(OutputPaths, StandardOutputByNameIsWrittenInTurn) {
  const std::string link = folder_ / "stdout.csv";
  fs::create_symlink("/proc/self/fd/1", link);
  expectWritten("render --size 8x8 --write ao=a.exr --timings stdout.csv > out.txt");
  const std::string text = readFile(folder_ / "out.txt");
  EXPECT_NE(text.find("wrote a.exr\nframe,effect,pass,"), std::string::npos) << text;
  EXPECT_TRUE(fs::is_symlink(link));
  const Outcome piped =
      run("render --size 8x8 --write ao=a.exr --timings stdout.csv | cat > piped.txt");
  EXPECT_EQ(piped.status, 0) << piped.err;
  EXPECT_NE(readFile(folder_ / "piped.txt").find("frame,effect,pass,"), std::string::npos);
  EXPECT_TRUE(fs::is_symlink(link));
}

}  // namespace
}  // namespace grisaille::tests
