// SPDX-License-Identifier: MIT
// An effect as a host describes it, before it exists.
#pragma once

#include <string_view>

#include "core/effect/chain.h"
#include "host/device.h"

namespace grisaille::host {

// Throws kTextureSize.
void checkSize(const grisaille_host_device& device, uint32_t width, uint32_t height);

// Index of an output. Throws kOutputUnknown.
uint32_t indexOf(const effect::Effect& effect, std::string_view key);

// Number of views, at least 1, and of kept sizes. Throw kHostValue.
uint32_t layersOf(const grisaille_host_effect_desc& desc);
uint32_t keptSizesOf(const grisaille_host_effect_desc& desc);

// Throws the errors of grisaille_host_effect_create().
struct Wanted {
  Wanted(const grisaille_host_device& device, const grisaille_host_effect_desc& desc);

  effect::Chain chain;   // holds only this effect, with its values
  uint32_t outputs = 0;  // by bit
  uint32_t layers = 1;
  bool copies = false;  // each output is a copy of what the effect writes
};

// The memory that the effect will take. Throws the errors of grisaille_host_memory_needed().
gpu::MemoryUse memoryNeeded(const grisaille_host_device& device,
                            const grisaille_host_effect_desc& desc,
                            const grisaille_host_prepare& how);

}  // namespace grisaille::host
