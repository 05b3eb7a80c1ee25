// SPDX-License-Identifier: MIT
// Runs the programs as their users do.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace grisaille::tests {

struct Outcome {
  int status = -1;  // exit status; -1: ended by a signal or by the time limit
  std::string out, err;
};

// A fresh folder, removed with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  // Writes a file and returns its path.
  std::string write(const std::string& name, std::string_view content) const;
  std::vector<std::string> files() const;  // names, sorted

 private:
  std::filesystem::path path_;
};

// The program whose subcommand begins the words: "grisaille" or "grisaille-lab".
std::string programOf(const std::string& words);

// `grisaille ARGUMENTS` in `folder`, or `grisaille-lab ARGUMENTS` for a subcommand of that program;
// with variables ("NAME=value") added to the environment; killed after 600 seconds.
Outcome runProgram(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                   const std::vector<std::string>& environment = {});

// The same for a shell's command line, with both programs on the PATH.
Outcome runShell(const std::string& line, const std::filesystem::path& folder);

std::string readFile(const std::filesystem::path& path);

// "" where Sponza is not there: then tests skip with kNoSponza.
std::string sponza();
std::string sponzaCamera(const std::string& name);
inline constexpr const char* kNoSponza =
    "Sponza.glb is neither at GRISAILLE_SPONZA nor at ../shared/scenes";

}  // namespace grisaille::tests
