// SPDX-License-Identifier: MIT
// A child process. Only wait() and the destructor wait for it.
#pragma once

#include <sys/types.h>

#include <array>
#include <chrono>
#include <string>
#include <vector>

namespace grisaille::app {

class Child {
 public:
  // `words`: the program, searched in $PATH if it has no '/', and its arguments. Its standard input
  // is /dev/null. The kernel sends it SIGTERM when the thread that started it ends. A program that
  // cannot be executed ends with status 127 and the reason in err(). Throws kUnexpected if the
  // process cannot be created.
  explicit Child(std::vector<std::string> words);
  ~Child();  // calls end() and waits, about kGrace at most
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  // Whether the process still runs. Also reads its new output into out() and err().
  bool running();

  // Sends SIGTERM. If the process still runs after kGrace, running() kills it.
  void end();

  // Waits until the process has ended.
  void wait();

  // The exit status of the ended process; -1: a signal ended it.
  int status() const { return status_; }
  // The signal that ended it; 0: none.
  int signal() const { return signal_; }

  // Output read so far.
  const std::string& out() const { return streams_[0].text; }
  const std::string& err() const { return streams_[1].text; }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kGrace{1000};

  struct Stream {
    int file = -1;  // read end of the pipe
    std::string text = {};
  };
  void read();

  pid_t process_ = 0;  // 0: the process has ended
  int status_ = -1;
  int signal_ = 0;
  std::array<Stream, 2> streams_ = {};  // standard output, standard error
  bool asked_ = false;
  Clock::time_point askedAt_ = {};
};

}  // namespace grisaille::app
