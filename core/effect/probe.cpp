// SPDX-License-Identifier: MIT
#include "core/effect/probe.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"
#include "core/library_folder.h"

extern char** environ;

namespace grisaille::effect {
namespace {

// Its output is nobody's: what the plugin says while it loads, it says again to the host.
pid_t start(const std::string& program, const std::string& plugin) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::string words[] = {program, plugin};
  char* const arguments[] = {words[0].data(), words[1].data(), nullptr};
  pid_t process = 0;
  const int failed = posix_spawn(&process, program.c_str(), &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed == 0) return process;
  throw Error(ErrorId::kPluginCrashes, "it cannot be tried out: {}: {}", program,
              std::strerror(failed));
}

// Whether it ended by itself.
bool ends(pid_t process, std::chrono::milliseconds patience) {
  // Not by pidfd_open(): glibc 2.36 declares it without C linkage.
  const auto file = static_cast<int>(syscall(SYS_pidfd_open, process, 0));
  if (file < 0) return true;  // then the wait below is without a limit
  pollfd ended = {.fd = file, .events = POLLIN, .revents = 0};
  int ready = 0;
  do {
    ready = poll(&ended, 1, static_cast<int>(patience.count()));
  } while (ready < 0 && errno == EINTR);
  close(file);
  return ready != 0;
}

}  // namespace

void probe(const std::string& path, std::chrono::milliseconds patience) {
  const pid_t process = start(libraryFolder() / "grisaille_probe_plugin", path);
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
  if (WEXITSTATUS(status) != kProbeSurvived) {
    throw Error(ErrorId::kPluginCrashes, "loading it ends the process with exit status {}",
                WEXITSTATUS(status));
  }
}

}  // namespace grisaille::effect
