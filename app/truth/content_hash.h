// SPDX-License-Identifier: MIT
// A number that tells contents apart.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>

#include "core/scene/scene.h"

namespace grisaille::app::truth {

// FNV-1a, 64 bits: each step is a bijection, so that no single changed byte goes unseen.
class ContentHash {
 public:
  uint64_t value() const { return value_; }

  void add(std::string_view bytes) {
    for (const char c : bytes) value_ = (value_ ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  }
  // For types without padding.
  template <typename T>
  void add(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    number(values.size());
    add({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  }
  template <typename T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void number(T value) { add({reinterpret_cast<const char*>(&value), sizeof(T)}); }

 private:
  uint64_t value_ = 0xcbf29ce484222325u;
};

// Of all that rays can meet: the scene as it was read, so that the files beside a .gltf and the
// built-in scene count as well as one .glb.
uint64_t hashOf(const scene::Scene& scene);

}  // namespace grisaille::app::truth
