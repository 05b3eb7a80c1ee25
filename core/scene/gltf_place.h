// SPDX-License-Identifier: MIT
// Names the place of an error inside a glTF file.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "core/base/error.h"

namespace grisaille::scene {

// Whether the text of an error begins with a path that continues another, such as
// "attributes.NORMAL: ...".
inline bool continuesPlace(std::string_view detail) {
  return detail.starts_with("attributes.") || detail.starts_with("targets[") ||
         detail.starts_with("indices: ");
}

// Calls `read` and puts `place`, a path into the JSON, before the text of its errors.
template <typename F>
decltype(auto) inPlace(const std::string& place, F&& read) {
  try {
    return std::forward<F>(read)();
  } catch (const Error& error) {
    throw Error(error.id(), "{}{}{}", place, continuesPlace(error.detail()) ? "." : ": ",
                error.detail());
  }
}

}  // namespace grisaille::scene
