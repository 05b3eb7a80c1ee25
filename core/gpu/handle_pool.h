// SPDX-License-Identifier: MIT
// Slots behind handles. A handle holds a slot's index and generation, which detects stale handles.
// As in sokol_gfx, freeing a slot increments its generation.
#pragma once

#include <optional>
#include <vector>

#include "core/base/error.h"
#include "core/gpu/types.h"

namespace grisaille::gpu {

template <typename HandleType, typename Value>
class HandlePool {
 public:
  // `kind` is for messages: "texture".
  explicit HandlePool(const char* kind) : kind_(kind) {}

  // Throws kTooManyResources if 65535 values live already. Invalidates references from get().
  HandleType add(Value value) {
    uint32_t index = 0;
    if (!free_.empty()) {
      index = free_.back();
      free_.pop_back();
    } else {
      if (slots_.size() >= 0xffffu) {
        throw Error(ErrorId::kTooManyResources, "the limit of 65535 live {}s is reached", kind_);
      }
      index = static_cast<uint32_t>(slots_.size());
      slots_.emplace_back();
    }
    Slot& slot = slots_[index];
    slot.value.emplace(std::move(value));
    return {slot.generation << 16 | index};
  }

  // Throws kStaleHandle.
  Value& get(HandleType handle) {
    const Slot* slot = find(handle);
    if (slot == nullptr) {
      throw Error(ErrorId::kStaleHandle, "{} {:#x} does not exist or is destroyed", kind_,
                  handle.value);
    }
    return *const_cast<Slot*>(slot)->value;
  }
  const Value& get(HandleType handle) const { return const_cast<HandlePool*>(this)->get(handle); }

  // Throws kStaleHandle.
  Value remove(HandleType handle) {
    Value value = std::move(get(handle));
    Slot& slot = slots_[handle.index()];
    slot.value.reset();
    slot.generation = slot.generation == 0xffffu ? 1 : slot.generation + 1;
    free_.push_back(handle.index());
    return value;
  }

  // Calls visit(handle, value) for every live value.
  template <typename Visit>
  void forEach(Visit&& visit) {
    for (uint32_t i = 0; i < slots_.size(); ++i) {
      if (slots_[i].value) visit(HandleType{slots_[i].generation << 16 | i}, *slots_[i].value);
    }
  }

 private:
  struct Slot {
    uint32_t generation = 1;  // never 0, which keeps every handle different from 0
    std::optional<Value> value;
  };

  const Slot* find(HandleType handle) const {
    if (handle.index() >= slots_.size()) return nullptr;
    const Slot& slot = slots_[handle.index()];
    return slot.value && slot.generation == handle.generation() ? &slot : nullptr;
  }

  const char* kind_;
  std::vector<Slot> slots_;
  std::vector<uint32_t> free_;
};

}  // namespace grisaille::gpu
