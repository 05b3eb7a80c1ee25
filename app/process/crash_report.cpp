// SPDX-License-Identifier: MIT
#include "app/process/crash_report.h"

#include <signal.h>
#include <unistd.h>

#include <array>
#include <cstring>

#include "core/effect/foreign_call.h"

namespace grisaille::app {
namespace {

struct Handled {
  int signal;
  struct sigaction before = {};
};
std::array<Handled, 5> handled = {{{.signal = SIGSEGV},
                                   {.signal = SIGBUS},
                                   {.signal = SIGFPE},
                                   {.signal = SIGILL},
                                   {.signal = SIGABRT}}};
std::array<char, 65536> stack;  // a crash may be that of a stack that is full

// A handler may write, and little else: no formatting, which takes memory.
void say(const char* text) {
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) return;
}

void tell(int signal, siginfo_t* info, void*) {
  const effect::RunningCall call = effect::runningCall;
  if (call.effect != nullptr) {
    say("error E3107: ");
    say(call.effect);
    say(" crashes in its ");
    say(call.function);
    say("(); repair the plugin, with what `grisaille effects --verify FILE` says of it\n");
  }
  for (const Handled& one : handled) {
    if (one.signal == signal) sigaction(signal, &one.before, nullptr);
  }
  // What the processor raised comes again by itself; what somebody sent does not.
  if (info->si_code <= 0) raise(signal);
}

}  // namespace

void nameCrashes() {
  stack_t own = {};
  own.ss_sp = stack.data();
  own.ss_size = stack.size();
  sigaltstack(&own, nullptr);
  struct sigaction action = {};
  action.sa_sigaction = tell;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  sigemptyset(&action.sa_mask);
  for (Handled& one : handled) sigaction(one.signal, &action, &one.before);
}

}  // namespace grisaille::app
