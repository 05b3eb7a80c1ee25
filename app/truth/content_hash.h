// SPDX-License-Identifier: MIT
// A hash of contents, for cache keys.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>

#include "core/scene/scene.h"

namespace grisaille::app::truth {

// FNV-1a, 64 bits. Each step is a bijection, so that a change of a single byte changes the hash.
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

// Hashes everything that rays can hit. It hashes the loaded scene, so that the external files of a
// .gltf and the built-in scene are covered like a .glb.
uint64_t hashOf(const scene::Scene& scene);

}  // namespace grisaille::app::truth
