// SPDX-License-Identifier: MIT
#include "tests/program/run.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

extern char** environ;

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kLimit(600);

std::vector<char*> pointers(std::vector<std::string>& strings) {
  std::vector<char*> list;
  for (std::string& string : strings) list.push_back(string.data());
  list.push_back(nullptr);
  return list;
}

// Returns the exit status, or -1 after a signal or at the time limit.
int waitFor(pid_t child) {
  const auto end = std::chrono::steady_clock::now() + kLimit;
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > end) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      return -1;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Keeps Mesa's shader cache in its usual folder, even if a test sets its own cache folder:
// compiling shaders takes most of a short run.
std::string shaderCache() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  const fs::path folder = cache != nullptr  ? fs::path(cache)
                          : home != nullptr ? fs::path(home) / ".cache"
                                            : fs::temp_directory_path();
  return "MESA_SHADER_CACHE_DIR=" + folder.string();
}

Outcome run(std::vector<std::string> arguments, const fs::path& folder,
            std::vector<std::string> environment) {
  if (std::getenv("MESA_SHADER_CACHE_DIR") == nullptr) environment.push_back(shaderCache());
  const size_t given = environment.size();
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string text = *variable;
    const std::string name = text.substr(0, text.find('=') + 1);
    const bool replaced = std::any_of(environment.begin(), environment.begin() + given,
                                      [&](const std::string& g) { return g.rfind(name, 0) == 0; });
    if (!replaced) environment.push_back(text);
  }
  const TemporaryFolder output;
  const std::string out = output / "out", err = output / "err";
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), O_WRONLY | O_CREAT, 0600);
  pid_t child = 0;
  const int failed = posix_spawn(&child, arguments[0].c_str(), &actions, nullptr,
                                 pointers(arguments).data(), pointers(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw std::runtime_error(arguments[0] + ": " + std::strerror(failed));
  Outcome outcome;
  outcome.status = waitFor(child);
  outcome.out = readFile(out);
  outcome.err = readFile(err);
  return outcome;
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "grisaille-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw std::runtime_error("cannot create a folder in " + name);
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string TemporaryFolder::write(const std::string& name, std::string_view content) const {
  std::ofstream(path_ / name, std::ios::binary) << content;
  return (path_ / name).string();
}

std::vector<std::string> TemporaryFolder::files() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(path_)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

std::string programOf(const std::string& words) {
  const std::string command = words.substr(0, words.find(' '));
  return command == "claims" || command == "stability" ? "grisaille-lab" : "grisaille";
}

Outcome runProgram(const std::vector<std::string>& arguments, const fs::path& folder,
                   const std::vector<std::string>& environment) {
  const std::string program = programOf(arguments.empty() ? "" : arguments[0]);
  std::vector<std::string> all = {fs::path(PROGRAM).parent_path() / program};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return run(std::move(all), folder, environment);
}

Outcome runShell(const std::string& line, const fs::path& folder) {
  const char* path = std::getenv("PATH");
  return run({"/bin/bash", "-c", line}, folder,
             {"PATH=" + fs::path(PROGRAM).parent_path().string() + ":" + (path ? path : "")});
}

std::vector<std::string> backends() {
  const Outcome outcome = runProgram({"backends", "--json"}, ".");
  std::vector<std::string> names;
  for (const auto& backend : nlohmann::json::parse(outcome.out)) {
    if (!backend["devices"].empty()) names.push_back(backend["backend"]);
  }
  return names;
}

std::string readFile(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string sponza() {
  const char* given = std::getenv("GRISAILLE_SPONZA");
  const fs::path path =
      given != nullptr ? fs::path(given) : fs::path(SOURCE_FOLDER) / "../shared/scenes/Sponza.glb";
  return fs::exists(path) ? fs::canonical(path).string() : "";
}

std::string sponzaCamera(const std::string& name) {
  return (fs::path(sponza()).parent_path() / "../cameras" / (name + ".json")).lexically_normal();
}

}  // namespace grisaille::tests
