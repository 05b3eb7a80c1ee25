// SPDX-License-Identifier: MIT
// `grisaille effects --verify`: sound plugins pass, each fault is named with the step at which it
// shows, and one that ends the process is a fault like another.
#include <gtest/gtest.h>

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
         {"draws whole pictures with its defaults", "writes every pixel", "is resized",
          "writes what is wanted alone", "draws with every parameter at its extremes",
          "draws with values drawn at random", "is destroyed and made anew"}) {
      EXPECT_TRUE(holds(outcome.out, std::string("ok    ") + backend + ": sound: " + line))
          << line << outcome.out;
    }
  }
  EXPECT_TRUE(holds(outcome.out, ": 0 faults in ")) << outcome.out;
}

// The program's own effects: with values at the ends of what is allowed and at random.
TEST(Verify, TheProgramsOwnEffectsPassOnBothBackends) {
  for (const std::string name : {"ssao", "sspm"}) {
    const Outcome outcome = verify(fs::path(EFFECTS_FOLDER) / (name + ".so"));
    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    for (const std::string backend : {"opengl", "vulkan"}) {
      const std::string line =
          "ok    " + backend + ": " + name + ": draws with values drawn at random";
      EXPECT_TRUE(holds(outcome.out, line)) << outcome.out;
    }
  }
}

TEST(Verify, FaultsAreNamedWithTheStep) {
  expectFault("nan", "opengl: nan: level = 1: nan.first holds 1 values that are no finite numbers");
  expectFault("leaves", "vulkan: leaves: 5184 of 5184 pixels of leaves.first are not written");
  expectFault("between", "opengl: between: with level=0.");
  expectFault("range", "vulkan: range: level = 1: range.first holds 1 values outside 0 to 1");
}

TEST(Verify, WhatEndsTheProcessIsAFaultToo) {
  expectFault("crashes", "the process ended: Aborted while: opengl: crashes: level = 1");
  expectFault("exits", "the process ended with exit status 0 while: opengl: exits: level = 1");
}

TEST(Verify, WhatIsNoPluginIsAFault) {
  const Outcome outcome = verify(fs::path(SOURCE_FOLDER) / "LICENSE");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(holds(outcome.out, "fault ")) << outcome.out;
  EXPECT_TRUE(holds(verify("/nothing/there.so").out, "No such file")) << outcome.out;
}

}  // namespace
}  // namespace grisaille::tests
