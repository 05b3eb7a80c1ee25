// SPDX-License-Identifier: MIT
// Names the place of an error inside a glTF file.
#pragma once

#include <string>
#include <utility>

#include "core/base/error.h"

namespace grisaille::scene {

// Calls `read` and puts `place`, a path into the JSON, before the text of its errors.
template <typename F>
decltype(auto) inPlace(const std::string& place, F&& read) {
  try {
    return std::forward<F>(read)();
  } catch (const Error& error) {
    throw Error(error.id(), "{}: {}", place, error.detail());
  }
}

}  // namespace grisaille::scene
