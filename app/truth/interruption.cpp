// SPDX-License-Identifier: MIT
#include "app/truth/interruption.h"

#include <signal.h>

namespace grisaille::app::truth {
namespace {

volatile sig_atomic_t asked_ = 0;

void ask(int) {
  asked_ = 1;
}

void handle(void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

Interruption::Interruption() {
  asked_ = 0;
  handle(ask);
}

Interruption::~Interruption() {
  handle(SIG_DFL);
}

bool Interruption::asked() {
  return asked_ != 0;
}

}  // namespace grisaille::app::truth
