// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <initializer_list>

#include "grisaille/effect.hpp"

namespace grisaille::ssao {

// Bindings of one dispatch, at most twelve. An array, so that recording a frame allocates no
// memory. add() throws std::out_of_range beyond twelve.
class Bindings {
 public:
  Bindings(std::initializer_list<grisaille_binding> first) {
    for (const grisaille_binding& binding : first) add(binding);
  }
  void add(const grisaille_binding& binding) { list_.at(count_++) = binding; }
  operator std::span<const grisaille_binding>() const { return {list_.data(), count_}; }

 private:
  std::array<grisaille_binding, 12> list_ = {};
  size_t count_ = 0;
};

// The specialization constant ORTHOGRAPHIC_ID of shaders/common/view.glsl, as the shaders of this
// effect define it.
inline grisaille_constant cameraKind(const plugin::Frame& frame) {
  return plugin::specialize(7, frame.view().orthographic != 0);
}

// Dispatches at least width x height invocations, in groups of 8x8: the local size of all shaders
// of this effect.
inline void dispatch(const plugin::Frame& frame, grisaille_pipeline pipeline,
                     std::span<const grisaille_binding> bindings, uint32_t width, uint32_t height) {
  constexpr uint32_t kGroup = 8;
  frame.dispatch(pipeline, bindings, plugin::groupsFor(width, kGroup),
                 plugin::groupsFor(height, kGroup));
}

}  // namespace grisaille::ssao
