// SPDX-License-Identifier: MIT
// Calls of a plugin's functions. No exception may cross the C interface; one that does ends here,
// while the code is loaded that it came from.
#pragma once

#include <exception>

#include "core/error.h"

namespace grisaille::effect {

// What `call` returns. Throws an Error of this number where it throws anything.
template <typename Call>
auto foreignCall(ErrorId id, const char* effect, const char* function, Call&& call) {
  try {
    return call();
  } catch (const std::exception& thrown) {
    throw Error(id, "{} lets an exception out of its {}(): {}", effect, function, thrown.what());
  } catch (...) {
    throw Error(id, "{} lets an exception out of its {}()", effect, function);
  }
}

}  // namespace grisaille::effect
