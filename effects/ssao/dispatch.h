// SPDX-License-Identifier: MIT
#pragma once

#include "grisaille/effect.hpp"

namespace grisaille::ssao {

// So many invocations, in groups of 8x8 as all shaders of this effect have them.
inline void dispatch(const plugin::Frame& frame, grisaille_pipeline pipeline,
                     std::span<const grisaille_binding> bindings, uint32_t width, uint32_t height) {
  constexpr uint32_t kGroup = 8;
  frame.dispatch(pipeline, bindings, plugin::groupsFor(width, kGroup),
                 plugin::groupsFor(height, kGroup));
}

}  // namespace grisaille::ssao
