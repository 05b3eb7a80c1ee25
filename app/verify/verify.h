// SPDX-License-Identifier: MIT
// Checks a plugin: `grisaille effects --verify FILE`.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <string_view>

namespace grisaille::app {

// Runs checkPlugin() in a process of its own, so that a plugin that crashes or never returns is a
// fault in the report. `patience`: longest time without output of that process. Throws
// kEffectFaulty if there is a fault.
void verifyPlugin(const std::string& file, std::chrono::seconds patience);

// The report of the checks. Standard output gets one line per result, which begins with one of the
// prefixes below, and at the end a line with the number of faults and checks. Standard error gets
// one line per step.
class Report {
 public:
  static constexpr const char* kOk = "ok    ";
  static constexpr const char* kFault = "fault ";
  static constexpr const char* kNote = "note  ";
  static constexpr const char* kEnd = "end   ";
  static constexpr const char* kStep = "step  ";

  // Announces the next step.
  void step(const std::string& what);
  void note(const std::string& text);

  // Counts one check. If `holds` is false, prints `fault`, unless a fault of the same cause was
  // printed before, on any backend. `cause`: what the line says without place and number; "": the
  // line itself.
  void expect(bool holds, const std::string& fault, std::string_view cause = {});
  void fault(const std::string& text) { expect(false, text); }

  // Ends a group of checks: prints an ok line if all passed, or how many failed of known causes.
  void conclude(const std::string& what);
  void end();

  size_t faults() const { return faults_; }

 private:
  size_t checks_ = 0, faults_ = 0, repeats_ = 0;
  // At the last conclude().
  size_t concludedChecks_ = 0, concludedFaults_ = 0, concludedRepeats_ = 0;
  std::set<std::string, std::less<>> causes_;
};

// Runs all checks in this process. The plugin must load, and its tables must be valid. Then, on
// every backend with all validation on, each of its effects must draw complete pictures: at several
// sizes, with each parameter at its extremes, and with random values of all parameters. Faults go
// to `report`; they throw nothing.
void checkPlugin(const std::string& file, Report& report);

}  // namespace grisaille::app
