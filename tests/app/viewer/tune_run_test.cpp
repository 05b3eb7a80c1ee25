// SPDX-License-Identifier: MIT
// A search in the background of the viewer; shell scripts replace `grisaille tune`.
#include "app/viewer/tune_run.h"

#include <signal.h>

#include <chrono>
#include <thread>

#include "tests/support/folder_test.h"
#include "tests/support/selections.h"

namespace grisaille::app::viewer {
namespace {

namespace fs = std::filesystem;

using tests::randomise;
using tests::Tables;

class TuneRunTest : public tests::FolderTest {
 protected:
  TuneRunTest() { command_.effects = &list_; }

  static std::vector<std::string> script(const std::string& text) {
    return {"/bin/sh", "-c", text, "tune"};
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

  // Waits for a file that a script writes under another name and then renames.
  std::string waitFor(const std::string& name) const {
    while (!fs::exists(file(name))) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return contentOf(file(name));
  }

  // Script lines that write the process ID to the file `who`.
  std::string introduction() const {
    return "printf '%s' $$ > '" + file("part") + "'; mv '" + file("part") + "' '" + file("who") +
           "'\n";
  }

  // Expects neither the process nor a zombie of it.
  void expectGone() const {
    EXPECT_EQ(kill(std::stoi(contentOf(file("who"))), 0), -1);
    EXPECT_EQ(errno, ESRCH);
  }

  Tables tables_;
  effect::Selection list_{tables_.registry};
  TuneCommand command_;
};

TEST_F(TuneRunTest, WhatIsFoundComesBack) {
  TuneRun run(script(introduction() + R"(
    echo '{"progress": "tune", "share": 1, "text": "57 evaluations"}'
    echo '{"setting": {"alpha.amount": 0.25, "alpha.count": 3}, "rmse": 0.101,' \
         '"milliseconds": 41.234, "evaluations": 57, "unseen_rmse": 0.112,' \
         '"warning": "that is more"}')"));
  run.start(command_);
  EXPECT_TRUE(run.started());
  const TuneRun::Outcome outcome = outcomeOf(run);
  EXPECT_FALSE(run.started());
  EXPECT_EQ(outcome.text, "RMSE 0.1010 at 41.234 ms, 57 evaluations; on unseen cameras 0.1120");
  EXPECT_EQ(outcome.warning, "that is more");
  ASSERT_TRUE(outcome.values);
  const std::vector<effect::ParameterValue> expected = {
      {{.effect = "alpha", .key = "amount"}, 0.25}, {{.effect = "alpha", .key = "count"}, 3}};
  EXPECT_EQ(*outcome.values, expected);
  EXPECT_FALSE(run.take());
  expectGone();
}

TEST_F(TuneRunTest, ItsLinesTellHowFarItIs) {
  const auto untilThere = [&](const std::string& name) {
    return "\nwhile [ ! -e '" + file(name) + "' ]; do sleep 0.01; done\n";
  };
  TuneRun run(
      script(R"(echo '{"progress": "truth 1 of 2", "share": 0.25, "text": "64 of 256 samples"}')" +
             untilThere("traced") +
             R"(echo '{"progress": "tune", "share": 0.07, "text": "early"}'
         echo '{"progress": "tune", "share": 0.42, "text": "34 evaluations"}'
         printf '{"progress": "tune", "sha')" +  // an incomplete line is not parsed yet
             untilThere("go")));
  const auto until = [&](double done) {
    while (run.state().done != done) {
      EXPECT_FALSE(run.take());
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  };
  run.start(command_);
  until(0.25);
  EXPECT_EQ(run.state().text, "tracing truth 1 of 2: 64 of 256 samples");
  fileOf("traced", "");
  until(0.42);
  EXPECT_EQ(run.state().text, "34 evaluations");
  fileOf("go", "");
  outcomeOf(run);
}

TEST_F(TuneRunTest, ACancelledOneEnds) {
  // One script ends on SIGTERM; the other ignores it.
  for (const std::string listens : {"", "trap '' TERM\n"}) {
    {
      TuneRun run(script(listens + introduction() + "while :; do sleep 0.05; done"));
      run.start(command_);
      waitFor("who");
      run.cancel();
      EXPECT_EQ(run.state().text, "cancelling");
      const TuneRun::Outcome outcome = outcomeOf(run);
      EXPECT_FALSE(outcome.values);
      EXPECT_EQ(outcome.text, "cancelled");
      expectGone();
      // The next run starts from the beginning.
      fs::remove(file("who"));
      run.start(command_);
      EXPECT_NE(run.state().text, "cancelling");
      waitFor("who");
    }
    expectGone();
    fs::remove(file("who"));
  }
}

TEST_F(TuneRunTest, AFailureGivesItsLastLine) {
  EXPECT_EQ(outcomeOf("echo 'note: nothing'; echo 'error E5303: no; allow more' >&2; exit 1").text,
            "error E5303: no; allow more");
  EXPECT_EQ(outcomeOf("exit 3").text, "it failed without a message");
  EXPECT_EQ(outcomeOf("kill -9 $$").text, "a signal ended it");
  TuneRun missing({file("missing")});
  missing.start(command_);
  EXPECT_EQ(outcomeOf(missing).text, file("missing") + ": No such file or directory");
  // A successful run without a setting in its output is a failure.
  for (const char* told : {"exit 0", "echo '{\"share\": 1}'", "echo '{\"setting\": {\"a\": 1}}'"}) {
    const TuneRun::Outcome empty = outcomeOf(told);
    EXPECT_FALSE(empty.values) << told;
    EXPECT_FALSE(empty.text.empty()) << told;
  }
}

TEST_F(TuneRunTest, NothingIsLeftOfOneThatIsDestroyed) {
  {
    TuneRun run(script(introduction() + "exec sleep 1000"));
    run.start(command_);
    waitFor("who");
  }
  expectGone();
}

// The command sets every value of an effect that is on, so that the search starts from them.
TEST_F(TuneRunTest, StartsFromThePresentSetting) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 200; ++i) {
    effect::Selection list(tables_.registry);
    randomise(random, list);
    command_.effects = &list;
    command_.vary.clear();
    std::vector<std::string> expected;
    std::string keys;
    for (const effect::Selection::Entry& entry : list.entries()) {
      if (entry.on) keys += (keys.empty() ? "" : ",") + std::string(entry.key());
      const effect::Values defaults(entry.effect());
      for (const grisaille_param_desc& param : entry.effect().params()) {
        const effect::ParameterName name{.effect = entry.key(), .key = param.key};
        const std::string text = entry.values.text(param.key);
        if (random() % 2 == 0) command_.vary.push_back(name);
        if (entry.on && text != defaults.text(param.key)) {
          expected.push_back(name.text() + "=" + text);
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
      // Each side is rounded by up to half a pixel.
      EXPECT_LE(pixels, (640 * 360) + size.x + size.y);
      const double across = static_cast<double>(size.x) / x, down = static_cast<double>(size.y) / y;
      EXPECT_LE(std::abs(across - down), 0.5 / x + 0.5 / y + 1e-12);
    }
  }
  EXPECT_EQ(tuneSize({1280, 720}), glm::uvec2(640, 360));
}

}  // namespace
}  // namespace grisaille::app::viewer
