// SPDX-License-Identifier: MIT
// The whole check of a plugin, of one's own or another's: `grisaille effects --verify FILE`.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace grisaille::app {

// Runs checkPlugin() in a process of its own, so that a plugin which crashes or never ends is a
// fault in the report; `patience` is how long one step of it may take. Throws kEffectFaulty where
// there is a fault.
void verifyPlugin(const std::string& file, std::chrono::seconds patience);

// The report as the checks write it: on standard output a line each, which begins with one of the
// words below, at the end how many there were; on standard error what is being done.
class Report {
 public:
  static constexpr const char* kOk = "ok    ";
  static constexpr const char* kFault = "fault ";
  static constexpr const char* kNote = "note  ";
  static constexpr const char* kEnd = "end   ";
  static constexpr const char* kStep = "step  ";

  // What is about to be done.
  void step(const std::string& what);
  void note(const std::string& text);

  // One check: counted, and a line where it fails, unless kMostFaults did since the last summary.
  void expect(bool holds, const std::string& fault);
  void fault(const std::string& text) { expect(false, text); }

  // A line that sums up what was checked since the last one, or how many more faults it had.
  void conclude(const std::string& what);
  void end();

  size_t faults() const { return faults_; }

 private:
  static constexpr size_t kMostFaults = 4;
  size_t checks_ = 0, faults_ = 0;
  size_t concludedChecks_ = 0, concludedFaults_ = 0;
};

// Every check, in this process: that the plugin loads, that its tables fit, and on every backend
// with all validation on that each of its effects draws whole pictures at any size and with every
// parameter at its extremes and all of them at random. Faults are the report's; throws nothing for
// them.
void checkPlugin(const std::string& file, Report& report);

}  // namespace grisaille::app
