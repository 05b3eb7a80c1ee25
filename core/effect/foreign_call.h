// SPDX-License-Identifier: MIT
// Calls of a plugin's functions. No exception may cross the C interface. If one does, it is caught
// here, while the plugin's code is still loaded.
#pragma once

#include <exception>

#include "core/base/error.h"

namespace grisaille::effect {

// The plugin function that runs in this thread, for the crash handler's message.
struct RunningCall {
  const char* effect = nullptr;  // null: no function runs
  const char* function = nullptr;
};
inline thread_local RunningCall runningCall;

// Sets runningCall for a scope.
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

// Returns the result of `call`. Replaces any exception from it by an Error with this number.
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
