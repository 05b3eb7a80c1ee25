// SPDX-License-Identifier: MIT
#include "app/verify/verify.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <thread>
#include <utility>

#include "app/process/child.h"
#include "core/base/error.h"

namespace grisaille::app {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kLook(10);

// The output of the checking process.
struct Transcript {
  size_t read = 0;  // bytes of the output that are printed
  bool ended = false;
  size_t faults = 0;
  std::string summary;

  // Prints the complete lines that arrived since the last call.
  void take(const std::string& out) {
    for (size_t end = 0; (end = out.find('\n', read)) != std::string::npos; read = end + 1) {
      const std::string_view line = std::string_view(out).substr(read, end - read);
      if (line.starts_with(Report::kEnd)) {
        ended = true;
        summary = line.substr(std::strlen(Report::kEnd));
        continue;
      }
      if (line.starts_with(Report::kFault)) ++faults;
      fmt::print("{}\n", line);
    }
    std::fflush(stdout);
  }
};

// The last step that the process announced.
std::string lastStep(const std::string& err) {
  const size_t at = err.rfind(Report::kStep);
  if (at == std::string::npos) return "starting";
  const size_t from = at + std::strlen(Report::kStep);
  return err.substr(from, err.find('\n', from) - from);
}

std::string endingOf(const Child& child, bool stalled, std::chrono::seconds patience) {
  if (stalled) return fmt::format("no progress for {} s", patience.count());
  if (child.signal() != 0) return fmt::format("the process ended: {}", strsignal(child.signal()));
  return fmt::format("the process ended with exit status {}", child.status());
}

}  // namespace

void verifyPlugin(const std::string& file, std::chrono::seconds patience) {
  Child child({"/proc/self/exe", "effects", "--verify", file, "--in-process"});
  Transcript said;
  size_t heard = 0;
  Clock::time_point last = Clock::now();
  bool stalled = false;
  while (child.running()) {
    said.take(child.out());
    const size_t words = child.out().size() + child.err().size();
    if (std::exchange(heard, words) != words) last = Clock::now();
    if (Clock::now() - last > patience) {
      stalled = true;
      child.end();
    }
    std::this_thread::sleep_for(kLook);
  }
  said.take(child.out());
  if (!said.ended) {
    ++said.faults;
    fmt::print("{}{} while: {}\n", Report::kFault, endingOf(child, stalled, patience),
               lastStep(child.err()));
    said.summary = fmt::format("{} faults; the check did not finish", said.faults);
  }
  if (said.faults > 0) throw Error(ErrorId::kEffectFaulty, "{}: {}", file, said.summary);
  fmt::print("{}: {}\n", file, said.summary);
}

void Report::step(const std::string& what) {
  fmt::print(stderr, "{}{}\n", kStep, oneLine(what));
}

void Report::note(const std::string& text) {
  fmt::print("{}{}\n", kNote, oneLine(text));
  std::fflush(stdout);
}

void Report::expect(bool holds, const std::string& fault, std::string_view cause) {
  ++checks_;
  if (holds) return;
  if (!causes_.emplace(cause.empty() ? fault : cause).second) {
    ++repeats_;
    return;
  }
  ++faults_;
  fmt::print("{}{}\n", kFault, oneLine(fault));
  std::fflush(stdout);
}

void Report::conclude(const std::string& what) {
  const size_t checks = checks_ - std::exchange(concludedChecks_, checks_);
  const size_t faults = faults_ - std::exchange(concludedFaults_, faults_);
  const size_t repeats = repeats_ - std::exchange(concludedRepeats_, repeats_);
  if (repeats > 0) note(fmt::format("{}: the same fault {} more times", what, repeats));
  if (faults + repeats > 0) return;
  fmt::print("{}{} ({} check{})\n", kOk, oneLine(what), checks, checks == 1 ? "" : "s");
  std::fflush(stdout);
}

void Report::end() {
  fmt::print("{}{} faults in {} checks\n", kEnd, faults_, checks_);
  std::fflush(stdout);
}

}  // namespace grisaille::app
