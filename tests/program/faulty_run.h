// SPDX-License-Identifier: MIT
// Runs the program with injected faults, see faults.c.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/program/run.h"

namespace grisaille::tests {

// Environment in which `fault` strikes after this many successful calls. File faults apply to files
// under `folder`.
inline std::vector<std::string> faulty(const std::string& fault, int after,
                                       const std::string& folder) {
  return {"LD_PRELOAD=" FAULTS, "FAULT=" + fault, "FAULT_AFTER=" + std::to_string(after),
          "FAULT_FOLDER=" + folder};
}

// Expects that the run ends with this error, on its last line, and reports no other error.
inline void expectEnds(const Outcome& outcome, int number, const std::string& mention = "") {
  EXPECT_EQ(outcome.status, 1) << outcome.out << outcome.err;
  const size_t at = outcome.err.find("error E");
  ASSERT_NE(at, std::string::npos) << outcome.err;
  const std::string line = outcome.err.substr(at);
  EXPECT_EQ(line.rfind("error E" + std::to_string(number) + ": ", 0), 0u) << outcome.err;
  EXPECT_NE(line.find(mention), std::string::npos) << outcome.err;
  EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1) << outcome.err;
}

}  // namespace grisaille::tests
