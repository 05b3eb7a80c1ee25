// SPDX-License-Identifier: MIT
#include "core/gpu/types.h"

#include <algorithm>

namespace grisaille::gpu {

const FormatInfo& formatInfo(Format format) {
  static constexpr FormatInfo kInfos[] = {
      {"none", 0, 0, false, false, false},    {"r8", 1, 1, false, true, true},
      {"rgba8", 4, 4, false, true, true},     {"srgb8_alpha8", 4, 4, false, false, true},
      {"r16f", 2, 1, false, true, true},      {"rgba16f", 8, 4, false, true, true},
      {"r32f", 4, 1, false, true, false},     {"rg32f", 8, 2, false, true, false},
      {"rgba32f", 16, 4, false, true, false}, {"r32ui", 4, 1, false, true, false},
      {"d32f", 4, 1, true, false, false},
  };
  return kInfos[static_cast<size_t>(format)];
}

uint64_t subresourceBytes(const TextureDesc& desc, uint32_t mip) {
  return uint64_t{std::max(1u, desc.width >> mip)} * std::max(1u, desc.height >> mip) *
         formatInfo(desc.format).texelBytes;
}

const char* clockName(Clock clock) {
  switch (clock) {
    case Clock::kNone:
      return "none";
    case Clock::kGpu:
      return "gpu";
    case Clock::kWall:
      return "wall";
  }
  return "none";
}

}  // namespace grisaille::gpu
