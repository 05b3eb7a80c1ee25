// SPDX-License-Identifier: MIT
// These tests call every function of the header, and the library exports no others.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>

#include "grisaille/host.h"
#include "tests/program/run.h"

extern "C" uint32_t hostVersionInC(void);

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

std::set<std::string> functionsOf(const std::string& header) {
  std::set<std::string> names;
  const std::regex declared("GRISAILLE_EXPORT[^;(]*?(grisaille_host_\\w+)\\(");
  for (std::sregex_iterator match(header.begin(), header.end(), declared), end; match != end;
       ++match) {
    names.insert((*match)[1]);
  }
  return names;
}

TEST(HostHeader, EveryFunctionIsTested) {
  const auto names =
      functionsOf(readFile(fs::path(SOURCE_FOLDER) / "host/include/grisaille/host.h"));
  ASSERT_EQ(names.size(), 28u);
  std::string tests;
  for (const auto& entry : fs::directory_iterator(fs::path(SOURCE_FOLDER) / "tests/host")) {
    if (entry.is_regular_file()) tests += readFile(entry.path());
  }
  for (const std::string& name : names) {
    EXPECT_NE(tests.find(name + "("), std::string::npos) << name;
  }
}

TEST(HostHeader, TheLibraryExportsItsFunctionsAlone) {
  if (SANITIZED) GTEST_SKIP() << "sanitizers export more functions";
  const auto names =
      functionsOf(readFile(fs::path(SOURCE_FOLDER) / "host/include/grisaille/host.h"));
  const Outcome outcome =
      runShell("nm -D --defined-only " BUILD_FOLDER "/lib/libgrisaille.so | awk '{print $3}'", ".");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  std::set<std::string> exported;
  for (std::string name; std::getline(lines, name);) {
    if (name != "_end" && name != "_edata" && name != "__bss_start") exported.insert(name);
  }
  EXPECT_EQ(exported, names);
}

TEST(HostHeader, IsPlainC) {
  EXPECT_EQ(hostVersionInC(), GRISAILLE_HOST_VERSION);
}

}  // namespace
}  // namespace grisaille::tests
