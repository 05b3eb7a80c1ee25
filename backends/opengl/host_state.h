// SPDX-License-Identifier: MIT
// Saves and restores the state that recording compute work changes in another program's context.
#pragma once

#include <array>
#include <cstdint>

#include "core/gpu/types.h"

namespace grisaille::opengl {

class HostState {
 public:
  HostState();  // the context must be current here and in all later calls

  void save();
  // Sets what uploads need, without a query.
  static void prepare();
  void restore() const;

 private:
  static constexpr uint32_t kSlots = GRISAILLE_SLOTS_PER_CLASS;
  struct Unit {
    int32_t texture = 0, array = 0, sampler = 0;
  };
  struct Image {
    int32_t texture = 0, level = 0, layered = 0, layer = 0, access = 0, format = 0;
  };
  struct Range {
    int32_t buffer = 0;
    int64_t offset = 0, size = 0;
  };
  struct Buffers {
    int32_t general = 0;  // the binding without an index
    std::array<Range, kSlots> slots;
  };

  uint32_t images_, storages_;  // number of slots that the context has, at most kSlots
  int32_t program_ = 0, activeUnit_ = 0, unpackBuffer_ = 0;
  std::array<int32_t, 8> unpack_ = {};
  std::array<Unit, kSlots> units_;
  std::array<Image, kSlots> image_;
  Buffers uniform_, storage_;
};

}  // namespace grisaille::opengl
