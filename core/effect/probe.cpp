// SPDX-License-Identifier: MIT
#include "core/effect/probe.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <iterator>
#include <string_view>

#include "core/base/error.h"
#include "core/base/library_folder.h"

extern char** environ;

namespace grisaille::effect {
namespace {

constexpr size_t kLongestAnswer = 4096;  // bytes; a pipe takes this many in one write

// The pipe through which the probe process answers.
class Answer {
 public:
  Answer() {
    if (pipe2(ends_, O_CLOEXEC | O_NONBLOCK) == 0) return;
    throw Error(ErrorId::kPluginCrashes, "cannot start the probe process: {}",
                std::strerror(errno));
  }
  ~Answer() {
    close(ends_[0]);
    close(ends_[1]);
  }
  Answer(const Answer&) = delete;
  Answer& operator=(const Answer&) = delete;

  int writingEnd() const { return ends_[1]; }

  // Does not wait: a process that the plugin started may keep the other end open.
  std::string text() const {
    std::string text(kLongestAnswer, '\0');
    const ssize_t count = read(ends_[0], text.data(), text.size());
    text.resize(count > 0 ? static_cast<size_t>(count) : 0);
    return text;
  }

 private:
  int ends_[2] = {-1, -1};
};

// Starts the probe process. Discards its output: the plugin prints the same when the host loads it.
pid_t start(const std::string& program, const std::string& plugin, const Answer& answer) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, answer.writingEnd(), kProbeAnswer);
  std::string words[] = {program, plugin};
  char* const arguments[] = {words[0].data(), words[1].data(), nullptr};
  pid_t process = 0;
  const int failed = posix_spawn(&process, program.c_str(), &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed == 0) return process;
  throw Error(ErrorId::kPluginCrashes, "cannot start the probe process: {}: {}", program,
              std::strerror(failed));
}

// Waits until the process ends. Returns false if it still runs after `patience`.
bool ends(pid_t process, std::chrono::milliseconds patience) {
  // Not pidfd_open(): glibc 2.36 declares it without C linkage.
  const auto file = static_cast<int>(syscall(SYS_pidfd_open, process, 0));
  if (file < 0) return true;  // waitpid() in probe() then waits without a limit
  pollfd ended = {.fd = file, .events = POLLIN, .revents = 0};
  int ready = 0;
  do {
    ready = poll(&ended, 1, static_cast<int>(patience.count()));
  } while (ready < 0 && errno == EINTR);
  close(file);
  return ready != 0;
}

// Throws the error in the process's answer. Returns if the answer is not an error of a plugin.
void throwRefusal(const std::string& answer) {
  int number = 0;
  const char* end = answer.data() + answer.size();
  const auto [rest, status] = std::from_chars(answer.data(), end, number);
  const ErrorId known[] = {ErrorId::kPluginUnloadable, ErrorId::kPluginSymbol, ErrorId::kPluginAbi,
                           ErrorId::kPluginTable, ErrorId::kPluginDuplicate};
  const auto found = std::ranges::find(known, static_cast<ErrorId>(number));
  if (status != std::errc() || rest == end || found == std::end(known)) return;
  throw Error(*found, std::string_view(rest + 1, end));
}

}  // namespace

void probe(const std::string& path, std::chrono::milliseconds patience) {
  const Answer answer;
  const pid_t process = start(libraryFolder() / "grisaille_probe_plugin", path, answer);
  const bool ended = ends(process, patience);
  if (!ended) kill(process, SIGKILL);
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (!ended) {
    throw Error(ErrorId::kPluginCrashes, "loading it does not end within {} ms", patience.count());
  }
  if (WIFSIGNALED(status)) {
    throw Error(ErrorId::kPluginCrashes, "loading it ends the process: {}",
                strsignal(WTERMSIG(status)));
  }
  if (WEXITSTATUS(status) == kProbeRefused) throwRefusal(answer.text());
  if (WEXITSTATUS(status) != kProbeAccepted) {
    throw Error(ErrorId::kPluginCrashes, "loading it ends the process with exit status {}",
                WEXITSTATUS(status));
  }
}

}  // namespace grisaille::effect
