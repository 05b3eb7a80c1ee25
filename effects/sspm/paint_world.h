// SPDX-License-Identifier: MIT
// All placed shots: the map of each, and the lists of the world's cells. update() follows the
// host's list of shots from frame to frame.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "cell_table.h"
#include "shares.h"
#include "survey.h"

namespace grisaille::sspm {

// Casts rays and writes one hit for each. Returns false if the host casts no rays.
using CastRays = std::function<bool(std::span<const grisaille_ray>, std::span<grisaille_hit>)>;

constexpr float kThrough = 1.0f / 512;  // least visible transmittance; see walk.glsl
constexpr uint32_t kMostLevels = 16;    // cell widths in use at the same time

// Parameters that change where paint lies, or which paint hides which.
struct PaintRules {
  float range = 0;  // of shots without their own, metres
  float full = 0;   // r0, metres
  float fade = 0;   // edge_fade: share of the range

  bool operator==(const PaintRules&) const = default;
};

class PaintWorld {
 public:
  PaintWorld() : records_("shots"), blocks_("maps"), runs_(blocks_, 2) {}

  // Places the shots of a list, newest first, and forgets shots that have left it.
  // shots: the list, oldest first. kept: number of leading shots unchanged since the previous call.
  // patience: seconds after which it stops placing, but not before one step.
  // cast: casts the rays of the surveys.
  // Returns the number of shots that are still pending.
  size_t update(std::span<const Shot> shots, size_t kept, const PaintRules& rules, double patience,
                const CastRays& cast);

  CellTable& cells() { return cells_; }
  Mirror& records() { return records_; }
  Mirror& blocks() { return blocks_; }
  std::span<const int32_t> levels() const { return levels_; }  // levelCode() of each level in use

 private:
  static constexpr uint32_t kNone = ~0u;
  struct State {
    uint32_t lostTo = 0;      // 1 + the newest shot that hides it in some cell; 0: none
    uint32_t record = kNone;  // index into placed_
  };
  // A shot in at least one cell's list.
  struct Placed {
    uint32_t shot = 0;
    uint32_t base = 0;    // first block of its map
    uint32_t blocks = 0;  // number of blocks of its map
    uint32_t cells = 0;   // number of cells that list it
  };
  // A shot under survey.
  struct Work {
    uint32_t id;
    Survey survey;
    std::vector<CellKey> cells = {};    // in which it was placed
    std::optional<CellGrid> grid = {};  // once the rough picture is complete
    // What the survey found, once it is complete.
    ShotMap map = {};
    std::vector<Share> shares = {};
    bool told = true;  // by the host, as far as it could
  };
  // Shots with the same origin, direction and range. Once enough of them hide everything older, the
  // effect does not place further older ones: it only counts their alphas.
  struct Twins {
    std::vector<uint32_t> ids;  // newest first
    uint32_t counted = 0;       // shots that only count, in the record of the newest
  };

  float rangeOf(uint32_t id) const { return list_[id].rangeOr(rules_.range); }

  // paint_world.cpp
  void clear();
  void forget(size_t count, bool allLost);
  std::vector<uint64_t> forgetTwins(const std::vector<bool>& gone);
  bool step(const CastRays& cast, std::vector<uint32_t>& unknown);
  void refill();
  bool castFor(std::span<Work* const> works, const CastRays& cast);
  void askAgain(const CastRays& cast);
  bool countTwin(uint32_t id);
  void joinTwins(uint32_t id, std::span<const CellKey> cells);
  CellGrid gridFor(const ShotFrame& frame);
  void place(Work& work);
  void publish(Cell& cell) {
    cells_.publish(cell, [&](uint32_t shot) { return states_[shot].record; });
  }
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
  std::deque<State> states_;       // one per shot
  std::vector<uint32_t> pending_;  // ascending
  std::deque<Work> work_;          // under survey, newest first
  std::deque<Work> partly_;        // placed, with squares of which the host cannot tell yet
  std::unordered_map<uint64_t, Twins> twins_;
  CellTable cells_;
  std::vector<Placed> placed_;  // one per record
  std::vector<uint32_t> freeRecords_;
  Mirror records_, blocks_;
  Runs runs_;
  std::vector<int32_t> levels_;
};

}  // namespace grisaille::sspm
