// SPDX-License-Identifier: MIT
// The sample points and the rotations of the classic SSAO (Mittring 2007; in a hemisphere: Filion
// and McNaughton 2008), drawn at random once from a seed.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace grisaille::ssao {

enum class Sampling : uint32_t { kHemisphere = 0, kSphere = 1 };

constexpr uint32_t kMaxKernelSize = 256;
constexpr uint32_t kNoiseSize = 4;  // pixels a side

// `size` points inside the unit sphere, or its half about +z, 1 ... kMaxKernelSize; w is 0.
std::array<glm::vec4, kMaxKernelSize> makeKernel(uint32_t size, Sampling sampling, uint32_t seed);

// kNoiseSize squared rotations, (cosine, sine): all angles of an even division of the circle, in
// random places.
std::vector<glm::vec2> makeNoise(uint32_t seed);

}  // namespace grisaille::ssao
