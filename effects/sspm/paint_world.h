// SPDX-License-Identifier: MIT
// Where all shots' paint lies: each shot's map, and the lists of the world's cells. Follows the
// list of shots from frame to frame.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "cell_table.h"
#include "shot_map.h"

namespace grisaille::sspm {

// What the paint depends on besides the shots. A change makes everything anew.
struct PaintRules {
  float range = 0;  // metres, of shots without one of their own
  // Within this distance of a shot's ray, metres, nothing older shows: its alpha is 1, unfaded.
  float solid(float shotRange) const { return glm::min(full, shotRange * (1 - fade)); }
  float full = 0;  // r0, metres
  float fade = 0;  // share of the range

  bool operator==(const PaintRules&) const = default;
};

class PaintWorld {
 public:
  PaintWorld() : shots_("shots"), blocks_("maps"), runs_(blocks_, 4) {}

  // Brings all up to `shots`, of which the first `kept` are as in the call before; the newest
  // first, until `patience` seconds are over (at least one shot). Returns how many still wait.
  size_t update(std::span<const grisaille_shot> shots, size_t kept, const PaintRules& rules,
                double patience, const CastRays& cast);

  CellTable& cells() { return cells_; }
  Mirror& shots() { return shots_; }
  Mirror& blocks() { return blocks_; }
  std::span<const int32_t> levels() const { return levels_; }  // codes in use, without facing

  // Of memory, on the host and on the device together.
  size_t bytes() const;

 private:
  struct State {
    uint32_t lostTo = 0;  // 1 + the newest shot that took a cell of this one
    uint32_t base = 0;    // its map's first block
    uint32_t blocks = 0;  // of its map; 0: none
    uint32_t cells = 0;   // that list it
  };
  // What a shot brings to one cell.
  struct Share {
    std::vector<uint32_t> points;
    uint64_t parts = 0;
    glm::vec4 plane = glm::vec4(0);
    bool plain = true;  // one plane all over
    bool ragged = false;
  };
  struct KeyHash {
    size_t operator()(const CellKey& key) const { return hashOf(key); }
  };
  using Shares = std::unordered_map<CellKey, Share, KeyHash>;

  void drop(size_t count);
  bool place(uint32_t id, const CastRays& cast, MapState& state);
  int32_t levelFor(float range, const glm::dvec3& origin);
  void spread(const ShotMap& map, const Patch& patch, int32_t level, Shares& shares) const;
  bool join(uint32_t id, const ShotMap& map, const CellKey& key, const Share& share);
  bool seals(const ShotMap& map, const Cell& cell, const Share& share) const;
  bool paintsAll(uint32_t id, const Cell& cell, const Share& share) const;
  void unlist(uint32_t id, uint32_t to);
  void writeRecord(uint32_t id, const ShotMap& map, uint32_t base);
  ShotFrame frameOf(uint32_t id) const;

  std::span<const grisaille_shot> list_;  // during update()
  PaintRules rules_;
  std::vector<State> states_;
  std::vector<uint32_t> pending_;  // ascending
  CellTable cells_;
  Mirror shots_, blocks_;
  Runs runs_;
  std::vector<int32_t> levels_;
};

}  // namespace grisaille::sspm
