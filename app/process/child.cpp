// SPDX-License-Identifier: MIT
#include "app/process/child.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <thread>

#include "core/base/error.h"

namespace grisaille::app {
namespace {

constexpr std::chrono::milliseconds kLook(10);  // polling interval of wait()

// Runs in the new process after fork(), before exec. Locks of other threads may be held for ever
// here: call no function that takes one.
[[noreturn]] void become(char* const* words, int out, int err, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(127);  // the parent ended before prctl()
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  close_range(STDERR_FILENO + 1, ~0u, 0);  // the display connections of the window
  execvp(words[0], words);
  const char* const why = strerrordesc_np(errno);
  for (const char* text : {static_cast<const char*>(words[0]), ": ", why, "\n"}) {
    if (write(STDERR_FILENO, text, std::strlen(text)) < 0) break;
  }
  _exit(127);
}

}  // namespace

Child::Child(std::vector<std::string> words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  int out[2] = {-1, -1}, err[2] = {-1, -1};
  const pid_t parent = getpid();
  const bool piped = pipe2(out, O_CLOEXEC) == 0 && pipe2(err, O_CLOEXEC) == 0;
  process_ = piped ? fork() : -1;
  if (process_ == 0) become(pointers.data(), out[1], err[1], parent);
  const int failed = process_ < 0 ? errno : 0;
  close(out[1]);
  close(err[1]);
  streams_[0].file = out[0];
  streams_[1].file = err[0];
  if (failed == 0) return;
  process_ = 0;
  for (const Stream& stream : streams_) close(stream.file);
  throw Error(ErrorId::kUnexpected, "{} cannot be started: {}", words[0], std::strerror(failed));
}

Child::~Child() {
  if (running()) end();
  wait();
  for (const Stream& stream : streams_) close(stream.file);
}

void Child::read() {
  for (Stream& stream : streams_) {
    for (;;) {
      pollfd ready = {.fd = stream.file, .events = POLLIN, .revents = 0};
      if (poll(&ready, 1, 0) <= 0) break;
      std::array<char, 4096> buffer;
      const ssize_t count = ::read(stream.file, buffer.data(), buffer.size());
      if (count <= 0) break;
      stream.text.append(buffer.data(), static_cast<size_t>(count));
    }
  }
}

bool Child::running() {
  if (process_ == 0) return false;
  if (asked_ && Clock::now() - askedAt_ > kGrace) kill(process_, SIGKILL);
  int status = 0;
  const bool ended = waitpid(process_, &status, WNOHANG) != 0;
  read();  // after waitpid(), to get the last output of an ended process
  if (!ended) return true;
  process_ = 0;
  status_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  signal_ = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  return false;
}

void Child::end() {
  if (process_ == 0 || asked_) return;
  asked_ = true;
  askedAt_ = Clock::now();
  kill(process_, SIGTERM);
}

void Child::wait() {
  while (running()) std::this_thread::sleep_for(kLook);
}

}  // namespace grisaille::app
