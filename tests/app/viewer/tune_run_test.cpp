// SPDX-License-Identifier: MIT
// A search beside the window, with shell scripts in the place of `grisaille tune`.
#include "app/viewer/tune_run.h"

#include <signal.h>

#include <chrono>
#include <thread>

#include "tests/support/tables.h"

namespace grisaille::app::viewer {
namespace {

namespace fs = std::filesystem;

class TuneRunTest : public FolderTest {
 protected:
  TuneRunTest() { command_.effects = &list_; }

  // The script knows its --out as $out.
  static std::vector<std::string> script(const std::string& text) {
    return {"/bin/sh", "-c", "for out; do :; done\n" + text, "tune"};
  }

  static TuneRun::Outcome outcomeOf(TuneRun& run) {
    for (;;) {
      if (auto outcome = run.take()) return *outcome;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }

  TuneRun::Outcome outcomeOf(const std::string& text) const {
    TuneRun run(script(text));
    run.start(command_);
    return outcomeOf(run);
  }

  // Of a file that a script writes aside and renames.
  std::string waitFor(const std::string& name) const {
    while (!fs::exists(file(name))) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return contentOf(file(name));
  }

  // Says who it is and where it was to write.
  std::string introduction() const {
    return "printf '%s %s' $$ \"$out\" > '" + file("part") + "'; mv '" + file("part") + "' '" +
           file("who") + "'\n";
  }

  // Neither the process is there, nor a zombie of it, nor its folder.
  void expectGone() const {
    const std::string who = contentOf(file("who"));
    const size_t space = who.find(' ');
    ASSERT_NE(space, std::string::npos);
    EXPECT_EQ(kill(std::stoi(who.substr(0, space)), 0), -1);
    EXPECT_EQ(errno, ESRCH);
    EXPECT_FALSE(fs::exists(fs::path(who.substr(space + 1)).parent_path()));
  }

  Tables tables_;
  EffectList list_{tables_.registry};
  TuneCommand command_;
};

TEST_F(TuneRunTest, WhatIsFoundComesBack) {
  command_.vary = {"alpha.count", "alpha.amount"};
  TuneRun run(script(introduction() + R"(
    printf 'opengl: a device (a driver)\nRMSE 0.1010 at 41.234 ms (wall clock), 640x360 pixels\n'
    printf '  alpha.count=3\n57 evaluations: 7 starts, 50 steps\n'
    printf '  random 1: RMSE 0.2\nvalidated on cameras not tuned on: RMSE 0.1120\nwrote it\n'
    printf '\rtune [#...] 100 %% 57 evaluations\033[K\r\033[Kwarning: that is more\n' >&2
    printf 'effects = ["alpha"]\n[alpha]\ncount = 3\nhard = true\namount = 0.25\n' > "$out")"));
  run.start(command_);
  EXPECT_TRUE(run.started());
  const TuneRun::Outcome outcome = outcomeOf(run);
  EXPECT_FALSE(run.started());
  EXPECT_EQ(outcome.text, "RMSE 0.1010 at 41.234 ms, 57 evaluations; on unseen cameras 0.1120");
  EXPECT_EQ(outcome.warning, "warning: that is more");
  // By key; of a parameter that may not change nothing is said.
  ASSERT_TRUE(outcome.values);
  ASSERT_EQ(outcome.values->size(), 2u);
  EXPECT_EQ(outcome.values->at(0).key + outcome.values->at(0).text, "amount0.25");
  EXPECT_EQ(outcome.values->at(1).key + outcome.values->at(1).text, "count3");
  EXPECT_FALSE(run.take());
  expectGone();
}

TEST_F(TuneRunTest, ItsWordsTellHowFarItIs) {
  const auto untilThere = [&](const std::string& name) {
    return "\nwhile [ ! -e '" + file(name) + "' ]; do sleep 0.01; done\n";
  };
  TuneRun run(script("printf '\\rtruth 1 of 2 [#...]  25 %% 64 of 256 samples a pixel\\033[K' >&2" +
                     untilThere("traced") +
                     "printf '\\r\\033[K\\rtune [#...]   7 %% early\\033[K\\rtune [##..]  42 %% 34 "
                     "evaluations, 5 s left\\033[K' >&2" +
                     untilThere("go")));
  const auto until = [&](double done) {
    while (run.state().done != done) {
      EXPECT_FALSE(run.take());
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  };
  run.start(command_);
  until(0.25);
  EXPECT_EQ(run.state().text, "tracing truth 1 of 2: 64 of 256 samples a pixel");
  fileOf("traced", "");
  until(0.42);
  EXPECT_EQ(run.state().text, "34 evaluations, 5 s left");
  fileOf("go", "");
  outcomeOf(run);
}

TEST_F(TuneRunTest, ACancelledOneEnds) {
  // One that ends when it is asked to, and one that is deaf.
  for (const std::string listens : {"", "trap '' TERM\n"}) {
    {
      TuneRun run(script(listens + introduction() + "while :; do sleep 0.05; done"));
      run.start(command_);
      waitFor("who");
      run.cancel();
      EXPECT_EQ(run.state().text, "is being cancelled");
      const TuneRun::Outcome outcome = outcomeOf(run);
      EXPECT_FALSE(outcome.values);
      EXPECT_EQ(outcome.text, "cancelled");
      expectGone();
      // The next one starts afresh.
      fs::remove(file("who"));
      run.start(command_);
      EXPECT_NE(run.state().text, "is being cancelled");
      waitFor("who");
    }
    expectGone();
    fs::remove(file("who"));
  }
}

TEST_F(TuneRunTest, AFailureGivesItsLastLine) {
  EXPECT_EQ(outcomeOf("printf '\\rtune [#] 9 %% x\\033[K\\r\\033[Kerror E5303: no; allow more\\n' "
                      ">&2; exit 1")
                .text,
            "error E5303: no; allow more");
  EXPECT_EQ(outcomeOf("exit 3").text, "it failed without a word");
  EXPECT_EQ(outcomeOf("kill -9 $$").text, "a signal ended it");
  TuneRun missing({file("missing")});
  missing.start(command_);
  EXPECT_EQ(outcomeOf(missing).text, file("missing") + ": No such file or directory");
  // A success that leaves no settings is none.
  const TuneRun::Outcome empty = outcomeOf("exit 0");
  EXPECT_FALSE(empty.values);
  EXPECT_TRUE(empty.text.starts_with("error E")) << empty.text;
}

TEST_F(TuneRunTest, NothingIsLeftOfOneThatIsDestroyed) {
  {
    TuneRun run(script(introduction() + "printf part > \"$out.part\"\nexec sleep 1000"));
    run.start(command_);
    waitFor("who");
  }
  expectGone();
}

// Every value of an effect that is on is told, but for those that may change.
TEST_F(TuneRunTest, WhatMayNotChangeIsSet) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 200; ++i) {
    EffectList list(tables_.registry);
    randomise(random, list);
    command_.effects = &list;
    command_.vary.clear();
    std::vector<std::string> expected;
    std::string keys;
    for (const EffectList::Entry& entry : list.entries()) {
      if (entry.on) keys += (keys.empty() ? "" : ",") + std::string(entry.key());
      const effect::Values defaults(entry.values.effect());
      for (const grisaille_param_desc& param : entry.values.effect().params()) {
        const std::string name = std::string(entry.key()) + "." + param.key;
        const std::string text = entry.values.text(param.key);
        if (random() % 2 == 0) {
          command_.vary.push_back(name);
        } else if (entry.on && text != defaults.text(param.key)) {
          expected.push_back(name + "=" + text);
        }
      }
    }
    std::vector<std::string> sets;
    const std::vector<std::string> arguments = tuneArguments(command_);
    for (size_t k = 0; k + 1 < arguments.size(); ++k) {
      if (arguments[k] == "--set") sets.push_back(arguments[k + 1]);
      if (arguments[k] != "--effects") continue;
      EXPECT_EQ(arguments[k + 1], keys);
    }
    EXPECT_EQ(sets, expected);
  }
}

TEST(TuneSizeTest, IsTheViewsShape) {
  for (uint32_t x = 1; x < 5000; x = x * 3 / 2 + 1) {
    for (uint32_t y = 1; y < 5000; y = y * 4 / 3 + 1) {
      const glm::uvec2 size = tuneSize({x, y});
      EXPECT_GE(size.x, 1u);
      EXPECT_GE(size.y, 1u);
      EXPECT_LE(size.x, x);
      EXPECT_LE(size.y, y);
      const double pixels = static_cast<double>(size.x) * size.y;
      if (uint64_t{x} * y <= 640 * 360) {
        EXPECT_EQ(size, glm::uvec2(x, y));
      }
      // Half a pixel a side is rounded.
      EXPECT_LE(pixels, (640 * 360) + size.x + size.y);
      const double across = static_cast<double>(size.x) / x, down = static_cast<double>(size.y) / y;
      EXPECT_LE(std::abs(across - down), 0.5 / x + 0.5 / y + 1e-12);
    }
  }
  EXPECT_EQ(tuneSize({1280, 720}), glm::uvec2(640, 360));
}

}  // namespace
}  // namespace grisaille::app::viewer
