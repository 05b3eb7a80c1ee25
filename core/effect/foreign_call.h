// SPDX-License-Identifier: MIT
// Calls of a plugin's functions. No exception may cross the C interface; one that does ends here,
// while the code is loaded that it came from.
#pragma once

#include <exception>

#include "core/base/error.h"

namespace grisaille::effect {

// Which of a plugin's functions runs in this thread, for the last words of a program that crashes.
struct RunningCall {
  const char* effect = nullptr;  // null: none
  const char* function = nullptr;
};
inline thread_local RunningCall runningCall;

// Sets it for a scope.
class NamedCall {
 public:
  NamedCall(const char* effect, const char* function) : before_(runningCall) {
    runningCall = {effect, function};
  }
  ~NamedCall() { runningCall = before_; }
  NamedCall(const NamedCall&) = delete;
  NamedCall& operator=(const NamedCall&) = delete;

 private:
  RunningCall before_;
};

// What `call` returns. Throws an Error of this number where it throws anything.
template <typename Call>
auto foreignCall(ErrorId id, const char* effect, const char* function, Call&& call) {
  const NamedCall named(effect, function);
  try {
    return call();
  } catch (const std::exception& thrown) {
    throw Error(id, "{} lets an exception out of its {}(): {}", effect, function, thrown.what());
  } catch (...) {
    throw Error(id, "{} lets an exception out of its {}()", effect, function);
  }
}

}  // namespace grisaille::effect
