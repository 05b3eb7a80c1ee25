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
std::array<char, 65536> stack;  // the handler's own: the crash may be a stack overflow

// write() is allowed in a signal handler; formatting, which allocates memory, is not.
void say(const char* text) {
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) return;
}

void tell(int signal, siginfo_t* info, void*) {
  const effect::RunningCall call = effect::runningCall;
  if (call.effect != nullptr) {
    say("error E3107: ");
    say(call.effect);
    say(" crashed in its ");
    say(call.function);
    say("(); check the plugin with `grisaille effects --verify FILE` and repair it\n");
  }
  for (const Handled& one : handled) {
    if (one.signal == signal) sigaction(signal, &one.before, nullptr);
  }
  // A fault of the processor (si_code > 0) repeats when the handler returns; a sent signal does
  // not.
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
