// SPDX-License-Identifier: MIT
// Runs the programs as users run them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace grisaille::tests {

struct Outcome {
  int status = -1;  // exit status; -1: ended by a signal or by the time limit
  std::string out, err;
};

// A fresh folder, deleted with the object.
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

// The program with the subcommand that begins the line: "grisaille" or "grisaille-lab".
std::string programOf(const std::string& words);

// Runs `grisaille ARGUMENTS`, or `grisaille-lab ARGUMENTS` for its subcommands, in `folder`.
// `environment`: variables ("NAME=value") to add. Kills the program after 600 seconds.
Outcome runProgram(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                   const std::vector<std::string>& environment = {});

// Runs a shell command line in `folder`, with both programs on the PATH and the same time limit.
Outcome runShell(const std::string& line, const std::filesystem::path& folder);

// The backends that have a device on this machine.
std::vector<std::string> backends();

std::string readFile(const std::filesystem::path& path);

// Path of the Sponza scene; "" if it is missing, and tests skip with kNoSponza.
std::string sponza();
std::string sponzaCamera(const std::string& name);
inline constexpr const char* kNoSponza =
    "Sponza.glb is neither at GRISAILLE_SPONZA nor at ../shared/scenes";

}  // namespace grisaille::tests
