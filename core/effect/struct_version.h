// SPDX-License-Identifier: MIT
// Structs of the C interface that grow with its versions: each begins with its size as the side
// that filled it knows it. Fields beyond that size read as zero.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <string>

#include "core/base/error.h"

namespace grisaille::effect {

// `sizes`: of each version, this program's first. `owner` names the struct in messages. Throws
// kPluginTable.
inline void checkStructSize(const std::string& owner, uint32_t size,
                            std::initializer_list<size_t> sizes) {
  const size_t known = *sizes.begin();
  if (size > known) {
    throw Error(ErrorId::kPluginTable,
                "{}.struct_size is {}, more than the {} that this program knows", owner, size,
                known);
  }
  if (std::ranges::find(sizes, size) != sizes.end()) return;
  throw Error(ErrorId::kPluginTable, "{}.struct_size is {}, which no version has; there are {}",
              owner, size, fmt::join(sizes, ", "));
}

// A struct whose size is checked, with the fields that it lacks as zero.
template <typename Desc>
Desc whole(const Desc* desc) {
  Desc copy = {};
  std::memcpy(&copy, desc, desc->struct_size);
  return copy;
}

}  // namespace grisaille::effect
