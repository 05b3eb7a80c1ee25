// SPDX-License-Identifier: MIT
#include "shot.h"

#include <bit>
#include <unordered_map>

namespace grisaille::sspm {

bool areTwins(const Shot& a, const Shot& b) {
  return std::ranges::equal(a.origin, b.origin) && std::ranges::equal(a.direction, b.direction) &&
         a.range == b.range;
}

uint64_t twinHash(const Shot& shot) {
  uint64_t hash = 14695981039346656037ull;
  const auto mix = [&](uint64_t word) {
    hash = (hash ^ word) * 0x9E3779B97F4A7C15ull;
    hash ^= hash >> 29;
  };
  for (const double x : shot.origin) mix(std::bit_cast<uint64_t>(x));
  for (const float x : shot.direction) mix(std::bit_cast<uint32_t>(x));
  mix(std::bit_cast<uint32_t>(static_cast<float>(shot.range)));
  return hash;
}

std::vector<Layer> layersOf(std::span<const Shot> shots, size_t count) {
  std::vector<Layer> layers;
  std::unordered_multimap<uint64_t, size_t> placed;  // twinHash(): index into `layers`
  for (size_t i = shots.size(); i > shots.size() - count; --i) {
    const Shot& shot = shots[i - 1];
    const auto [first, end] = placed.equal_range(twinHash(shot));
    const auto twin = std::find_if(
        first, end, [&](const auto& it) { return areTwins(shots[layers[it.second].shot], shot); });
    if (twin != end) {
      ++layers[twin->second].times;
      continue;
    }
    placed.emplace(twinHash(shot), layers.size());
    layers.push_back({.shot = i - 1});
  }
  return layers;
}

}  // namespace grisaille::sspm
