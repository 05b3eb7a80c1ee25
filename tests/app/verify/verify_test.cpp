// SPDX-License-Identifier: MIT
// `grisaille effects --verify`: valid plugins pass. Each fault is named with the step that shows
// it, including plugins that end the process.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <future>

#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

Outcome verify(const fs::path& plugin) {
  return runProgram({"effects", "--verify", plugin}, "/");
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

void expectFault(const std::string& name, const std::string& fault) {
  const Outcome outcome = verify(fs::path(PLUGINS) / ("verified_" + name + ".so"));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(holds(outcome.out, "\nfault " + fault)) << outcome.out;
  EXPECT_EQ(outcome.err.rfind("error E3206: ", 0), 0u) << outcome.err;
}

TEST(Verify, ASoundPluginPassesOnBothBackends) {
  const Outcome outcome = verify(fs::path(PLUGINS) / "verified_sound.so");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* backend : {"opengl", "vulkan"}) {
    for (const char* line :
         {"draws complete pictures with its defaults", "writes every pixel", "draws at other sizes",
          "writes each output alone", "draws with every parameter at its extremes",
          "draws with random values", "is destroyed and created again"}) {
      EXPECT_TRUE(holds(outcome.out, std::string("ok    ") + backend + ": sound: " + line))
          << line << outcome.out;
    }
  }
  EXPECT_TRUE(holds(outcome.out, ": 0 faults in ")) << outcome.out;
}

// The program's own effects, with extreme and random values.
TEST(Verify, TheProgramsOwnEffectsPassOnBothBackends) {
  for (const std::string name : {"ssao", "sspm"}) {
    const Outcome outcome = verify(fs::path(EFFECTS_FOLDER) / (name + ".so"));
    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    for (const std::string backend : {"opengl", "vulkan"}) {
      const std::string line = "ok    " + backend + ": " + name + ": draws with random values";
      EXPECT_TRUE(holds(outcome.out, line)) << outcome.out;
    }
  }
}

TEST(Verify, FaultsAreNamedWithTheStep) {
  expectFault("nan", "opengl: nan: level = 1: nan.first holds 1 values that are not finite");
  expectFault("leaves", "opengl: leaves: with its defaults: leaves.first: it is not written");
  expectFault("between", "opengl: between: with level=0.");
  expectFault("range", "opengl: range: level = 1: range.first holds 1 values outside 0 to 1");
}

// However many pictures show it, on both backends.
TEST(Verify, OneCauseIsOneFault) {
  for (const std::string name : {"nan", "leaves", "range", "clock", "leaks", "hoards", "reads_past",
                                 "writes_beside", "races", "loops", "removed"}) {
    const Outcome outcome = verify(fs::path(PLUGINS) / ("verified_" + name + ".so"));
    EXPECT_EQ(outcome.status, 1);
    // A driver that never ends the loop does not let the check finish.
    EXPECT_TRUE(holds(outcome.err, name == "loops" ? ": 1 faults" : ": 1 faults in "))
        << outcome.out << outcome.err;
  }
}

TEST(Verify, WhatGrowsFromFrameToFrameIsAFault) {
  expectFault("leaks", "opengl: leaks: the memory of the process grows by 16");
  expectFault("hoards", "opengl: hoards: it keeps 16 more textures, buffers, samplers");
}

TEST(Verify, FaultsOfShadersAreNamed) {
  const std::string output = ".first: the output depends on ";
  const auto expectHolds = [&](const std::string& name, const std::string& what) {
    const Outcome outcome = verify(fs::path(PLUGINS) / ("verified_" + name + ".so"));
    EXPECT_TRUE(holds(outcome.out, what)) << outcome.out;
  };
  expectHolds("reads_past", output + "an access out of range: an index past a storage buffer");
  expectHolds("writes_beside", output + "an access out of range");
  // Some drivers end such a loop, others never do.
  const Outcome loops = verify(fs::path(PLUGINS) / "verified_loops.so");
  EXPECT_TRUE(holds(loops.out, output + "a loop that does not end") ||
              holds(loops.out, "no progress for 120 s while: opengl: loops"))
      << loops.out;
  expectHolds("races", output + "the order of threads: a race in shared memory");
  expectFault("removed",
              "opengl: removed: with its defaults: removed cannot record: dispatch: E1206");
}

TEST(Verify, OutputsThatDependOnTheClockOrEarlierFramesAreAFault) {
  expectFault("clock", "opengl: clock: 1 of 5184 values of clock.first: the output differs when");
  expectFault("remembers",
              "opengl: remembers: 1 of 5184 values of remembers.first: the output differs between");
}

TEST(Verify, WhatEndsTheProcessIsAFaultToo) {
  expectFault("crashes", "the process ended: Aborted while: opengl: crashes: level = 1");
  expectFault("exits", "the process ended with exit status 0 while: opengl: exits: level = 1");
}

// Its thread needs the plugin's code after the refusal.
TEST(Verify, ARefusedPluginWhoseThreadRunsOnIsAFault) {
  const fs::path folder = THREADED_PLUGINS;
  for (const auto& [name, reason] : {std::pair{"major", "it was built for interface version "},
                                     std::pair{"range", "effects[0].params[0]."}}) {
    const Outcome outcome = verify(folder / fmt::format("threaded_{}.so", name));
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(holds(outcome.out, reason)) << outcome.out;
    EXPECT_FALSE(holds(outcome.out, "the process ended")) << outcome.out;
  }
}

TEST(FaultyEffects, ThatAreRefusedLeaveTheProgramRunning) {
  const TemporaryFolder folder;
  const Outcome list = runProgram({"effects", "--plugin-path", THREADED_PLUGINS}, folder.path());
  EXPECT_EQ(list.status, 0) << list.err;
  EXPECT_TRUE(holds(list.out, "E3103")) << list.out;
  EXPECT_TRUE(holds(list.out, "E3104")) << list.out;
  for (const char* backend : {"opengl", "vulkan"}) {
    const Outcome render = runProgram({"render", "--size", "16x9", "--backend", backend,
                                       "--plugin-path", THREADED_PLUGINS, "--write", "ao=a.exr"},
                                      folder.path());
    EXPECT_EQ(render.status, 0) << render.err;
  }
}

// An effect without the wrapper throws. Its message lies in the plugin and is read before
// unloading.
TEST(Verify, AnExceptionThatCrossesTheInterfaceIsAFault) {
  for (const std::string function : {"create", "reads", "record", "destroy"}) {
    const std::string name = "throws_" + function;
    expectFault(name, "opengl: " + name);
    const Outcome outcome = verify(fs::path(PLUGINS) / ("verified_" + name + ".so"));
    EXPECT_TRUE(holds(outcome.out,
                      name + " lets an exception out of its " + function + "(): thrown on purpose"))
        << outcome.out;
    EXPECT_FALSE(holds(outcome.out, "the process ended")) << outcome.out;
  }
}

// Both run at the same time and wait for the time limit.
TEST(Verify, WhatNeverReturnsIsAFault) {
  const auto wait = [](const std::string& name) {
    return std::async(std::launch::async, [name] {
      return runProgram({"effects", "--verify", fs::path(PLUGINS) / ("verified_" + name + ".so"),
                         "--patience", "5"},
                        "/");
    });
  };
  auto made = wait("unmade"), recorded = wait("hangs");
  const Outcome unmade = made.get(), hangs = recorded.get();
  EXPECT_TRUE(holds(unmade.out, "fault no progress for 5 s while: opengl: unmade: creating it"))
      << unmade.out;
  EXPECT_TRUE(holds(hangs.out, "fault no progress for 5 s while: opengl: hangs: level = 1"))
      << hangs.out;
  EXPECT_EQ(unmade.status, 1);
  EXPECT_EQ(hangs.status, 1);
}

Outcome render(const TemporaryFolder& folder, const std::string& effect,
               const std::vector<std::string>& more) {
  std::vector<std::string> words = {"render", "--size",    "16x9", "--plugin-path",
                                    PLUGINS,  "--effects", effect};
  words.insert(words.end(), more.begin(), more.end());
  return runProgram(words, folder.path());
}

TEST(FaultyEffects, ThatThrowEndTheRenderByAnError) {
  const TemporaryFolder folder;
  for (const std::string function : {"create", "reads", "record"}) {
    const Outcome outcome = render(folder, "throws_" + function, {"--write", "none=a.exr"});
    EXPECT_EQ(outcome.status, 1);
    const std::string number = function == "create" ? "3202" : "3203";
    EXPECT_EQ(outcome.err.rfind("error E" + number + ": throws_" + function + " lets", 0), 0u)
        << outcome.err;
    EXPECT_TRUE(holds(outcome.err, "thrown on purpose")) << outcome.err;
  }
  EXPECT_TRUE(folder.files().empty());
  // The list of all effects reports the fault for this effect.
  const Outcome list = runProgram({"effects", "--plugin-path", PLUGINS}, folder.path());
  EXPECT_EQ(list.status, 0) << list.err;
  EXPECT_TRUE(holds(list.out, "throws_reads lets an exception out of its reads()")) << list.out;
  EXPECT_TRUE(holds(list.out, "throws_record")) << list.out;
  // Too late to affect the picture, which is complete.
  const Outcome outcome = render(folder, "throws_destroy", {"--write", "depth=a.exr"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_TRUE(holds(outcome.err, "error E3203: throws_destroy lets")) << outcome.err;
}

TEST(FaultyEffects, ThatCrashAreNamed) {
  const TemporaryFolder folder;
  const Outcome outcome =
      render(folder, "crashes", {"--set", "crashes.level=1", "--write", "first=a.exr"});
  EXPECT_EQ(outcome.status, -1);  // ended by a signal
  EXPECT_EQ(outcome.err.rfind("error E3107: crashes crashed in its record(); ", 0), 0u)
      << outcome.err;
  EXPECT_TRUE(folder.files().empty());
}

// The picture is written unchanged, for debugging.
TEST(FaultyEffects, WhatIsNotFiniteIsAWarningOfRender) {
  const TemporaryFolder folder;
  const Outcome sound = render(folder, "nan", {"--write", "first=a.exr"});
  EXPECT_EQ(sound.status, 0);
  EXPECT_EQ(sound.err, "");
  const Outcome nan = render(folder, "nan", {"--set", "nan.level=1", "--write", "first=a.exr"});
  EXPECT_EQ(nan.status, 0);
  EXPECT_EQ(nan.err.rfind("warning: first holds 1 values that are not finite", 0), 0u) << nan.err;
}

// Otherwise these pixels would count as exact.
TEST(FaultyEffects, WhatIsNotFiniteIsNotMeasured) {
  const TemporaryFolder folder;
  const Outcome outcome =
      runProgram({"measure", "--plugin-path", PLUGINS, "--sweep", "nan.level=0.5,1", "--size",
                  "16x9", "--samples", "16", "--rounds", "1", "--backend", "opengl", "--out", "m"},
                 folder.path());
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(holds(outcome.err, "error E3207: level=1: nan.first holds 1 values")) << outcome.err;
}

TEST(Verify, WhatIsNoPluginIsAFault) {
  const Outcome outcome = verify(fs::path(SOURCE_FOLDER) / "LICENSE");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(holds(outcome.out, "fault ")) << outcome.out;
  EXPECT_TRUE(holds(verify("/nothing/there.so").out, "No such file")) << outcome.out;
}

}  // namespace
}  // namespace grisaille::tests
