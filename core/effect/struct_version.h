// SPDX-License-Identifier: MIT
// Structs of the C interface that grow with its versions: each begins with its size in the version
// that its writer was built with. Fields beyond that size read as zero.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <string>

#include "core/base/error.h"

namespace grisaille::effect {

// `sizes`: the struct's size in each version, this program's first. `owner` names the struct in
// messages. Throws kPluginTable.
inline void checkStructSize(const std::string& owner, uint32_t size,
                            std::initializer_list<size_t> sizes) {
  const size_t known = *sizes.begin();
  if (size > known) {
    throw Error(ErrorId::kPluginTable,
                "{}.struct_size is {}, more than the {} that this program knows", owner, size,
                known);
  }
  if (std::ranges::find(sizes, size) != sizes.end()) return;
  throw Error(ErrorId::kPluginTable, "{}.struct_size is {}, which no version has; versions have {}",
              owner, size, fmt::join(sizes, ", "));
}

// A copy of a struct with a checked size; fields beyond that size are zero.
template <typename Desc>
Desc whole(const Desc* desc) {
  Desc copy = {};
  std::memcpy(&copy, desc, desc->struct_size);
  return copy;
}

}  // namespace grisaille::effect
