// SPDX-License-Identifier: MIT
// Kernel and noise tile of the classic SSAO (Mittring 2007; hemisphere: Filion and McNaughton
// 2008), pseudo-random from a seed. The same on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace grisaille::ssao {

enum class Sampling : uint32_t { kHemisphere = 0, kSphere = 1 };

constexpr uint32_t kMostPoints = 256;  // shaders/ssao/occlusion.glsl repeats them, turned
constexpr uint32_t kNoiseSize = 4;     // width and height, pixels

// Sample points in the unit sphere, or in its half around +z; w is 0.
// The first points of it are as good a kernel as all of them.
std::array<glm::vec4, kMostPoints> makeKernel(Sampling sampling, uint32_t seed);

// Noise tile of kNoiseSize x kNoiseSize rotations, (cosine, sine): the angles divide the circle
// evenly, in random order.
std::vector<glm::vec2> makeNoise(uint32_t seed);

}  // namespace grisaille::ssao
