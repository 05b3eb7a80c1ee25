// SPDX-License-Identifier: MIT
// The manual tells the truth: its commands run, its tables are the effects' own.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "tests/program/run.h"
#include "tests/support/display.h"

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = SOURCE_FOLDER;

// The lines of all ```sh blocks of a file.
std::vector<std::string> commandsOf(const fs::path& file) {
  std::istringstream text(readFile(file));
  std::vector<std::string> commands;
  bool inside = false;
  for (std::string line; std::getline(text, line);) {
    if (line.rfind("```", 0) == 0) {
      inside = !inside && line == "```sh";
    } else if (inside && !line.empty() && line[0] != '#') {
      commands.push_back(line);
    }
  }
  return commands;
}

// Runs a manual's commands in order in one folder, as a reader would. `./dev` builds and tests,
// which is what is being done here: only its subcommand is looked up.
void runCommands(const fs::path& file) {
  const TemporaryFolder folder;
  const Display display(1600, 1200);
  const std::string help = runShell("./dev help", kSource).out;
  size_t ran = 0;
  for (const std::string& command : commandsOf(file)) {
    SCOPED_TRACE(command);
    if (command.rfind("./dev", 0) == 0) {
      const size_t start = 6, end = std::min(command.find(' ', start), command.size());
      const std::string name = command.size() > start ? command.substr(start, end - start) : "help";
      EXPECT_TRUE(name == "help" || help.find("\n  " + name + " ") != std::string::npos);
      continue;
    }
    // A window stays until its reader closes it.
    const bool window =
        command.find("grisaille view") == 0 && command.find("--frames") == std::string::npos;
    const Outcome outcome = runShell(command + (window ? " --frames 2" : ""), folder.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    ++ran;
  }
  EXPECT_GT(ran, 0u) << file;
}

TEST(Readme, CommandsRun) {
  runCommands(kSource / "README.md");
}
TEST(Readme, SsaoCommandsRun) {
  runCommands(kSource / "effects/ssao/README.md");
}

TEST(Readme, SspmCommandsRun) {
  runCommands(kSource / "effects/sspm/README.md");
}

TEST(Readme, TablesAreTheEffectsOwn) {
  for (const std::string effect : {"ssao", "sspm"}) {
    const Outcome outcome = runProgram({"effects", "--markdown", effect}, ".");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    for (const std::string& file : {std::string("README.md"), "effects/" + effect + "/README.md"}) {
      EXPECT_NE(readFile(kSource / file).find(outcome.out), std::string::npos)
          << file << " lacks this table:\n"
          << outcome.out;
    }
  }
}

// The files that the pages of the repository link to or show, without anchors.
std::set<fs::path> linkedFiles() {
  std::vector<fs::path> pages = {kSource / "README.md", kSource / "CONTRIBUTING.md"};
  for (const char* folder : {"docs", "effects"}) {
    for (const auto& entry : fs::recursive_directory_iterator(kSource / folder)) {
      if (entry.path().extension() == ".md") pages.push_back(entry.path());
    }
  }
  std::set<fs::path> linked;
  for (const fs::path& page : pages) {
    const std::string text = readFile(page);
    for (size_t at = 0; (at = text.find("](", at)) != std::string::npos; ++at) {
      const std::string target = text.substr(at + 2, text.find_first_of(")#", at) - at - 2);
      if (target.empty() || target.rfind("http", 0) == 0) continue;
      linked.insert((page.parent_path() / target).lexically_normal());
    }
  }
  return linked;
}

TEST(Readme, EveryLinkedFileIsThere) {
  for (const fs::path& file : linkedFiles()) EXPECT_TRUE(fs::exists(file)) << file;
}

TEST(Readme, EveryPictureIsShown) {
  const std::set<fs::path> linked = linkedFiles();
  for (const auto& entry : fs::recursive_directory_iterator(kSource / "docs")) {
    const fs::path ending = entry.path().extension();
    if (entry.is_directory() || ending == ".md" || ending == ".json") continue;
    EXPECT_TRUE(linked.contains(entry.path())) << "no page shows " << entry.path();
  }
}

}  // namespace
}  // namespace grisaille::tests
