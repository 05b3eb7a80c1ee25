// SPDX-License-Identifier: MIT
// Checks the documentation: its commands run, its tables match the effects, its links lead to
// files, and a page shows each picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <set>
#include <sstream>

#include "tests/program/run.h"
#include "tests/support/display.h"

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = SOURCE_FOLDER;

// Need one shell session with files between the commands: tests/build runs them.
const std::set<fs::path> kTutorials = {"write_an_effect.md", "embed.md"};

// The lines of all ```sh blocks of a page, without comments.
std::vector<std::string> commandsOf(const fs::path& page) {
  std::istringstream text(readFile(page));
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

std::vector<fs::path> pagesOf(const fs::path& folder) {
  std::vector<fs::path> pages;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  }
  std::ranges::sort(pages);
  return pages;
}

// README, the manual and the effects' READMEs, if they contain commands; paths relative to the
// source folder.
std::vector<std::string> pagesWithCommands() {
  std::vector<fs::path> pages = {kSource / "README.md"};
  for (const char* folder : {"docs/manual", "effects"}) {
    std::ranges::copy(pagesOf(kSource / folder), std::back_inserter(pages));
  }
  std::vector<std::string> names;
  for (const fs::path& page : pages) {
    if (kTutorials.contains(page.filename()) || commandsOf(page).empty()) continue;
    names.push_back(fs::relative(page, kSource).string());
  }
  return names;
}

// For example "docs_manual_render" for "docs/manual/render.md".
std::string testName(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = fs::path(info.param).replace_extension("").string();
  std::ranges::replace_if(
      name, [](char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

class Page : public ::testing::TestWithParam<std::string> {};

// Runs the commands in order, in one empty folder, as a reader would. `./dev` itself builds and
// runs these tests: only its subcommand is checked.
TEST_P(Page, CommandsRun) {
  const TemporaryFolder folder;
  const Display display(1600, 1200);
  const std::string help = runShell("./dev help", kSource).out;
  for (const std::string& command : commandsOf(kSource / GetParam())) {
    SCOPED_TRACE(command);
    if (command.rfind("./dev", 0) == 0) {
      const size_t start = 6, end = std::min(command.find(' ', start), command.size());
      const std::string name = command.size() > start ? command.substr(start, end - start) : "help";
      EXPECT_TRUE(name == "help" || help.find("\n  " + name + " ") != std::string::npos);
      continue;
    }
    // Limits a window to two frames; a reader would close it.
    const bool window =
        command.find("grisaille view") == 0 && command.find("--frames") == std::string::npos;
    const Outcome outcome = runShell(command + (window ? " --frames 2" : ""), folder.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
}

INSTANTIATE_TEST_SUITE_P(Documentation, Page, ::testing::ValuesIn(pagesWithCommands()), testName);

TEST(Documentation, EveryManualPageBeginsWithAQuestion) {
  for (const fs::path& page : pagesOf(kSource / "docs/manual")) {
    std::istringstream text(readFile(page));
    std::string title;
    std::getline(text, title);
    EXPECT_TRUE(title.rfind("# ", 0) == 0 && title.ends_with('?')) << page << ": " << title;
  }
}

TEST(Documentation, TablesAreTheEffectsOwn) {
  size_t effects = 0;
  for (const auto& entry : fs::directory_iterator(kSource / "effects")) {
    const Outcome outcome =
        runProgram({"effects", "--markdown", entry.path().filename().string()}, ".");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(readFile(entry.path() / "README.md").find(outcome.out), std::string::npos)
        << entry.path() / "README.md"
        << " lacks this table:\n"
        << outcome.out;
    ++effects;
  }
  EXPECT_GE(effects, 2u);
}

// A page without its fenced blocks: a lambda in one looks like a link.
std::string withoutCode(const std::string& page) {
  std::istringstream lines(page);
  std::string text;
  bool code = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      code = !code;
    } else if (!code) {
      text += line + "\n";
    }
  }
  return text;
}

// Files that pages link to or show, without anchors.
std::set<fs::path> linkedFiles() {
  std::vector<fs::path> pages;
  for (const auto& entry : fs::directory_iterator(kSource)) {
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  }
  for (const char* folder : {"docs", "effects", "examples", "studies"}) {
    std::ranges::copy(pagesOf(kSource / folder), std::back_inserter(pages));
  }
  std::set<fs::path> linked;
  for (const fs::path& page : pages) {
    const std::string text = withoutCode(readFile(page));
    for (size_t at = 0; (at = text.find("](", at)) != std::string::npos; ++at) {
      const std::string target = text.substr(at + 2, text.find_first_of(")#", at) - at - 2);
      if (target.empty() || target.rfind("http", 0) == 0) continue;
      linked.insert((page.parent_path() / target).lexically_normal());
    }
  }
  return linked;
}

TEST(Documentation, EveryLinkedFileIsThere) {
  for (const fs::path& file : linkedFiles()) EXPECT_TRUE(fs::exists(file)) << file;
}

TEST(Documentation, EveryPictureIsShown) {
  const std::set<fs::path> linked = linkedFiles();
  for (const auto& entry : fs::recursive_directory_iterator(kSource / "docs")) {
    const std::set<fs::path> pictures = {".png", ".svg", ".jpg", ".html"};
    if (!pictures.contains(entry.path().extension())) continue;
    EXPECT_TRUE(linked.contains(entry.path())) << "no page shows " << entry.path();
  }
}

}  // namespace
}  // namespace grisaille::tests
