// SPDX-License-Identifier: MIT
// A program that runs beside the window. Nothing here waits for it unless its name says so.
#pragma once

#include <sys/types.h>

#include <array>
#include <chrono>
#include <string>
#include <vector>

namespace grisaille::app {

class Child {
 public:
  // Words: the program, looked up in $PATH where it has no '/', and its arguments. It reads nothing
  // and is asked to end when the thread that started it ends, however that comes about. One that
  // cannot be started ends with status 127 and says why. Throws kUnexpected where there is no room
  // for a process.
  explicit Child(std::vector<std::string> words);
  ~Child();  // ends it and waits for that, kGrace at most
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  // Takes up what it has written meanwhile.
  bool running();

  // Asks it to end (SIGTERM). One that still runs after kGrace is killed by running().
  void end();

  // Until it has ended by itself.
  void wait();

  // Once it has ended: its exit status; -1: a signal ended it.
  int status() const { return status_; }
  // The signal that ended it; 0: none.
  int signal() const { return signal_; }

  // What it has written until now.
  const std::string& out() const { return streams_[0].text; }
  const std::string& err() const { return streams_[1].text; }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kGrace{1000};

  struct Stream {
    int file = -1;  // to read from
    std::string text = {};
  };
  void read();

  pid_t process_ = 0;  // 0: it has ended
  int status_ = -1;
  int signal_ = 0;
  std::array<Stream, 2> streams_ = {};  // standard output, standard error
  bool asked_ = false;
  Clock::time_point askedAt_ = {};
};

}  // namespace grisaille::app
