// SPDX-License-Identifier: MIT
// Where all shots' paint lies: each shot's map, and the lists of the world's cells. Follows the
// list of shots from frame to frame.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <unordered_map>
#include <vector>

#include "cell_table.h"
#include "shares.h"
#include "survey.h"

namespace grisaille::sspm {

// Rays in, hits out; false where rays cannot be cast.
using CastRays = std::function<bool(std::span<const grisaille_ray>, std::span<grisaille_hit>)>;

constexpr float kThrough = 1.0f / 512;  // shows no more; as in shaders/sspm/surface.comp
constexpr uint32_t kMostLevels = 16;    // widths of cells in use at once

// What the paint depends on besides the shots.
struct PaintRules {
  float range = 0;  // metres, of shots without one of their own
  float full = 0;   // r0, metres
  float fade = 0;   // share of the range

  bool operator==(const PaintRules&) const = default;
};

class PaintWorld {
 public:
  PaintWorld() : records_("shots"), blocks_("maps"), runs_(blocks_, 4) {}

  // Brings all up to `shots`, of which the first `kept` are as in the call before; the newest
  // first, until `patience` seconds are over (one step at least). Returns how many still wait.
  size_t update(std::span<const Shot> shots, size_t kept, const PaintRules& rules, double patience,
                const CastRays& cast);

  CellTable& cells() { return cells_; }
  Mirror& records() { return records_; }
  Mirror& blocks() { return blocks_; }
  std::span<const int32_t> levels() const { return levels_; }  // codes in use, without facing

 private:
  static constexpr uint32_t kNone = ~0u;
  struct State {
    uint32_t lostTo = 0;  // 1 + the newest shot that hides it in some cell
    uint32_t record = kNone;
  };
  // A shot that some cell lists.
  struct Placed {
    uint32_t shot = 0;
    uint32_t base = 0;    // its map's first block
    uint32_t blocks = 0;  // of its map
    uint32_t cells = 0;   // that list it
  };
  struct Work {
    uint32_t id;
    Survey survey;
    std::vector<CellKey> cells;  // that it was placed in
  };
  // Shots of one origin, direction and range. As soon as nothing older shows through so many of
  // them, the older ones only count.
  struct Twins {
    std::vector<uint32_t> ids;  // newest first
    uint32_t counted = 0;       // by the newest, besides itself
  };

  float rangeOf(uint32_t id) const { return list_[id].rangeOr(rules_.range); }

  // paint_world.cpp
  void clear();
  void forget(size_t count, bool allLost);
  std::vector<uint64_t> forgetTwins(const std::vector<bool>& gone);
  bool step(const CastRays& cast, std::vector<uint32_t>& unknown);
  void refill();
  bool castFor(std::span<Work*> works, const CastRays& cast, std::vector<bool>& told);
  void askAgain(const CastRays& cast);
  bool countTwin(uint32_t id);
  void joinTwins(uint32_t id, std::span<const CellKey> cells);
  CellGrid gridFor(const ShotFrame& frame);
  void place(uint32_t id, Survey& survey);
  void remove(uint32_t id, std::span<const CellKey> cells);
  void writeRecord(uint32_t id, const ShotFrame& frame, const ShotMap& map);
  void writeCount(uint32_t id, uint32_t counted);
  ShotFrame frameOf(uint32_t id) const;

  // hiding.cpp
  bool isHidden(uint32_t id, const Survey& survey, const CellGrid& grid);
  bool join(uint32_t id, const ShotFrame& frame, const CellGrid& grid, const ShotMap& map,
            const Share& share);
  size_t learn(Cell& cell, const glm::dvec3& origin, const CellGrid& grid,
               const SurfacePoint& point);
  bool paintsPoint(const Entry& entry, const glm::dvec3& origin, const SurfacePoint& point) const;
  void prune(Cell& cell);
  void unlist(uint32_t id, uint32_t to);

  std::span<const Shot> list_;  // during update()
  PaintRules rules_;
  std::deque<State> states_;       // one a shot
  std::vector<uint32_t> pending_;  // ascending
  std::deque<Work> work_;          // under way, newest first
  std::deque<Work> partly_;        // placed as far as the host can tell
  std::unordered_map<uint64_t, Twins> twins_;
  CellTable cells_;
  std::vector<Placed> placed_;  // one a record
  std::vector<uint32_t> freeRecords_;
  Mirror records_, blocks_;
  Runs runs_;
  std::vector<int32_t> levels_;
};

}  // namespace grisaille::sspm
