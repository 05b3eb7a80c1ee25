// SPDX-License-Identifier: MIT
// All placed shots: the map of each, and the lists of the world's cells. update() follows the
// host's list of shots from frame to frame.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "cell_table.h"
#include "muzzle.h"
#include "shares.h"
#include "survey.h"
#include "thinning.h"

namespace grisaille::sspm {

// Casts rays and writes one hit for each. Returns false if the host casts no rays.
using CastRays = std::function<bool(std::span<const grisaille_ray>, std::span<grisaille_hit>)>;

// The host's ways to tell what a muzzle sees. Depth pictures come first.
struct Sight {
  CastRays cast;
  DrawDepth draw;
};

inline double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

constexpr size_t kMostLooks = 4;      // surveys with depth pictures at the same time
constexpr uint32_t kMostLevels = 16;  // cell widths in use at the same time
constexpr size_t kRecordWords = 16;   // of a shot: Shot in shaders/sspm/walk.glsl

// Parameters that change where paint lies, or which paint hides which.
struct PaintRules {
  float range = 0;  // of shots without their own, metres
  float full = 0;   // r0, metres
  float fade = 0;   // edge_fade: share of the range

  // A shot's strength at a distance from its ray that is less than its range: step 2 of the
  // definition. own: its range, metres. times: how often its alpha counts.
  float strength(float across, float own, float times) const {
    const float alpha = std::min(1.0f, full / std::max(across, 1e-6f));
    const float rim = fade > 0 ? std::min(1.0f, (1 - across / own) / fade) : 1.0f;
    return std::min(times * alpha * rim, 1.0f);
  }

  bool operator==(const PaintRules&) const = default;
};

class PaintWorld {
 public:
  PaintWorld() : records_("shots"), blocks_("maps"), runs_(blocks_, 2) {}

  // Places the shots of a list, newest first, and forgets shots that have left it.
  // shots: the list, oldest first. kept: number of leading shots unchanged since the previous call.
  // patience: seconds after which it stops placing, but not before one step. If it is finite, it
  // also stops where much waits for its upload.
  // limit: most memory, host and device together, bytes. It gives up the oldest shots to stay
  // below. sight: answers the rays of the surveys. Returns the number of shots that are still
  // pending.
  size_t update(std::span<const Shot> shots, size_t kept, const PaintRules& rules, double patience,
                uint64_t limit, const Sight& sight);
  // The same without placing: forgets shots that have left the list, and notes the others as
  // pending.
  void follow(std::span<const Shot> shots, size_t kept, const PaintRules& rules, uint64_t limit);
  // Number of leading shots that the last update() gave up.
  size_t givenUp() const { return floors_.given; }
  // Number of shots with a coarse map.
  size_t coarse() const { return coarse_; }

  // A shot that reaches a point; its muzzle may not see the point.
  struct Reach {
    uint32_t shot = 0;  // index into the list
    float times = 1;    // how often its alpha counts: see Placed::counted
    // Offset of the point from the shot's ray, along the axes of its ShotFrame, metres.
    glm::dvec2 across = glm::dvec2(0);
  };
  // Appends to `reaches` the newest placed shots, at most `most`, that are older than shot `below`,
  // reach a point, and fire at the side of the surface that the normal points to. Newest first.
  // Reads only: threads may call it between two update() or follow().
  void reachesOf(const glm::dvec3& position, const glm::vec3& normal, uint32_t below, size_t most,
                 std::vector<Reach>& reaches) const;

  // Writes the changes of update() on the device. Call it inside record(), outside passes.
  void upload(const plugin::Frame& frame, Uploader& uploader);

  CellTable& cells() { return cells_; }
  DeviceWords& records() { return records_; }
  DeviceWords& blocks() { return blocks_; }
  std::span<const int32_t> levels() const { return levels_; }  // levelCode() of each level in use

 private:
  static constexpr uint32_t kNone = ~0u;
  struct State {
    // 0, or it is placed again once the list is shorter than this: 1 + the newest shot that hides
    // it in some cell, or more if a pass of thin() has hidden it.
    uint32_t lostTo = 0;
    uint32_t record = kNone;  // index into placed_
    // Its last survey was for both maps. Where it is placed again, the next one is too, also if it
    // is coarse then: a survey for the coarse map alone gives another coarse map.
    bool exact = false;
  };
  // A map on the device.
  struct MapRun {
    uint32_t base = 0;    // first block
    uint32_t blocks = 0;  // number of blocks
    uint32_t root = 0;
  };
  // A shot in at least one cell's list.
  struct Placed {
    uint32_t shot = 0;
    MapRun exact = {};     // no blocks: given up, or no surface
    MapRun coarse = {};    // no blocks: not much smaller than the exact map
    uint32_t cores = 0;    // number of its entries with Entry::core
    uint32_t others = 0;   // number of its other entries
    uint32_t counted = 0;  // twins that only count
    float slope = 0;       // of its frame
    float mapRange = 0;    // for which its maps were made, metres
    bool hidden = false;   // has lost all entries with Entry::core; paints nothing

    bool isCoarse() const { return exact.blocks == 0 && coarse.blocks > 0; }
  };
  // What tasks of a step take, in units of a ray among many.
  struct Effort {
    double shared = 0;   // by all threads together, or while the others wait
    double alone = 0;    // by one thread for each task
    double largest = 0;  // of these: of one task

    Effort with(const Effort& task) const;
    double rays() const;
  };
  // A shot under survey.
  struct Work {
    uint32_t id;
    Survey survey;
    std::optional<Muzzle> muzzle = {};  // if the host draws depth pictures
    std::vector<CellKey> cells = {};    // in which it was placed
    std::optional<CellGrid> grid = {};  // once the rough picture is complete
    int parts = 0;                      // done of those in Part
    ShotMap map = {}, coarse = {};
    std::vector<Share> shares = {};
    bool told = true;  // by the host, as far as it could
    int asked = 0;     // how often the host did not have its depth pictures

    // Whether no ray is left to cast.
    bool isSurveyed() const { return survey.rays().empty() && !survey.isRough(); }
    bool isComplete() const { return parts == kParts; }
    // Whether its rough picture is complete, and nothing has been made of it.
    bool isRoughComplete() const {
      return told && survey.isRough() && survey.rays().empty() && !grid;
    }
    // Of a round of rays, and of one part of the survey.
    Effort roundEffort() const;
    Effort partEffort(int part) const;
  };
  // What is taken of a complete survey, in this order.
  enum Part : int { kShares, kCoarseMap, kExactMap, kParts };
  struct Task {
    Work* work;
    int part;
  };
  // How fast steps go.
  struct Pace {
    double spent = 0;   // seconds, of the last steps
    double effort = 0;  // of the same steps; rays

    double effortIn(double seconds) const;
    double mostIn(double seconds) const;
    void note(double seconds, double done);
  };
  // What the limit of memory costs: older shots are given up, have coarse maps, or are found hidden
  // by samples.
  struct Floors {
    uint32_t given = 0;   // shots below are given up
    uint32_t coarse = 0;  // other shots below have coarse maps
    double thinned = 0;   // records in use after the last pass of thin()
  };
  // The floors before the list of this length raised them.
  struct Raise {
    size_t shots = 0;
    Floors before;
  };
  // A shot. Lengths in cells, from a cell's lower corner.
  struct CellRay {
    uint32_t shot = 0;
    glm::vec3 muzzle, direction;
    float range = 0;
  };
  // A group of twins.
  struct Twins {
    uint32_t newest = 0;
    uint32_t counted = 0;  // the others
  };

  float rangeOf(uint32_t id) const { return list_[id].rangeOr(rules_.range); }

  // paint_world.cpp
  void clear();
  enum class Changed : uint8_t { kNothing, kHiding, kRange };
  void forget(size_t count, Changed changed);
  void erase(const std::vector<bool>& gone);
  bool isUploadDue() const;
  void writeRecord(uint32_t record);

  // placing.cpp
  bool step(double most, double alone, const Sight& sight, std::vector<uint32_t>& unknown);
  void refine(Work& work);
  bool advance(Work& work, std::vector<uint32_t>& unknown);
  void placeComplete();
  bool placeRest();
  size_t completeCount() const;
  void dropDone();
  void sortPending();
  void refill();
  static int32_t levelFor(const ShotFrame& frame);
  bool isInUse(int32_t level) const { return std::ranges::find(levels_, level) != levels_.end(); }
  CellGrid gridFor(const ShotFrame& frame);
  void place(Work& work);
  void sharpen(const Work& work);
  bool isPlaced(uint32_t id) const { return states_[id].record != kNone; }
  bool isLost(uint32_t id) const { return !isPlaced(id) && states_[id].lostTo > 0; }
  void remove(uint32_t id, std::span<const CellKey> cells);

  // sight.cpp
  bool askFor(std::span<Work* const> works, std::span<Task> tasks, const Sight& sight);
  bool castFor(std::span<Work* const> works, std::span<Task> tasks, const CastRays& cast);
  bool lookFor(std::span<Work* const> works, const DrawDepth& draw);
  void proceed(Work& work);
  static void take(const Task& task);
  static void finish(std::span<const Task> tasks);
  void askAgain(const Sight& sight);

  // former.cpp
  uint32_t recordOf(const Entry& entry) const;
  uint32_t& slotOf(uint32_t record);
  void placeAnew(const std::vector<bool>& anew, size_t count);
  void retire(uint32_t id);
  bool isSettled() const { return pending_.empty() && work_.empty(); }
  void dropFormer();
  CellRay rayIn(const Cell& cell, const Entry& entry) const;
  void tighten(Cell& cell);
  void spread();
  void spread(Cell& cell);
  void spreadTo(const CellKey& key, uint64_t near, std::span<const CellRay> grown,
                const glm::ivec3& offset);

  // twins.cpp
  bool countTwin(uint32_t id);
  void joinTwins(uint32_t id, std::span<const CellKey> cells);
  void forgetTwins(std::vector<bool>& gone, size_t count);
  void writeCount(uint32_t id, uint32_t counted);

  // memory.cpp
  uint32_t takeRecord(uint32_t id);
  void unlist(const Entry& entry, uint32_t to);
  void release(uint32_t record);
  void hide(uint32_t record);
  bool isGone(const Entry& entry) const;
  bool sweep();
  void sweepCell(Cell& cell);
  uint64_t bytes() const;
  MapRun store(const ShotMap& map);
  void give(MapRun& run);
  uint64_t room() const;
  bool areMapsFull(uint64_t spare) const;
  bool fits(const ShotMap& map) const;
  bool isScarce() const;
  bool isFull() const;
  void planArrays();
  void makeRoom();
  void keepWithin();
  bool coarsen();
  bool giveUpOldest();
  void noteFloors();
  void giveUp(uint32_t floor);
  void takeUp(size_t shots);

  // thinning.cpp
  struct Spot;
  struct Cover;
  double placedCount() const { return static_cast<double>(placed_.size() - freeRecords_.size()); }
  bool isThinningDue() const;
  bool thin(const CastRays& cast, size_t most);
  void addSpots(size_t index, std::vector<Spot>& spots, std::vector<Cover>& covers);
  float strengthAt(const Spot& spot, const Entry& entry, grisaille_ray& ray) const;
  bool sumUp(std::vector<Spot>& spots, std::vector<Cover>& covers, const CastRays& cast);
  void cover(std::span<const Cover> covers);
  void hideOlder(const Spot& spot);
  void hideUnseen();

  // points.cpp
  bool reach(const glm::dvec3& position, const glm::vec3& normal, const Entry& entry,
             Reach& reach) const;

  // hiding.cpp
  void findHidden(const Work& work);
  void join(uint32_t record, const ShotFrame& frame, const CellGrid& grid, const ShotMap& map,
            const Share& share, bool thin);
  size_t learn(Cell& cell, const CellGrid& grid, const SurfacePoint& point);
  void prune(Cell& cell);

  std::span<const Shot> list_;  // of the last update() or follow(), as long as the host keeps it
  PaintRules rules_;
  std::deque<State> states_;       // one per shot
  uint32_t lengthBefore_ = 0;      // of the list, before it grew
  std::vector<uint32_t> pending_;  // ascending
  std::deque<Work> work_;          // under survey, newest first
  bool looks_ = false;             // the host has drawn depth pictures
  std::deque<Work> partly_;        // placed, with squares of which the host cannot tell yet
  std::unordered_map<uint64_t, Twins> twins_;
  CellTable cells_;
  std::vector<Placed> placed_;  // one per record
  // While shots are placed anew: the record of how each shot was placed before; kNone: none. Else
  // empty.
  std::vector<uint32_t> former_;
  std::vector<uint32_t> freeRecords_;
  DeviceWords records_, blocks_;
  Runs runs_;
  uint32_t placing_ = kNone;  // record of the shot that place() works on
  size_t entries_ = 0;        // of all cells
  size_t hidden_ = 0;         // of these: entries of hidden shots
  size_t swept_ = 0;          // cells of an unfinished sweep; 0: none
  bool lastSweep_ = false;    // that sweep removes the last entries of former_
  Thinning thinning_;
  bool sampled_ = false;  // passes have hidden shots
  Floors floors_;
  std::vector<Raise> raises_;  // ascending
  size_t coarse_ = 0;          // shots with Placed::isCoarse()
  uint32_t turn_ = kNone;      // shots below come next: the host did not have others' pictures
  Pace pace_;
  double uploadTime_ = 0;    // seconds, of the longest of the last uploads
  uint64_t limit_ = 0;       // bytes
  uint64_t plannedFor_ = 0;  // limit for which planArrays() has planned; 0: not yet
  enum class Lacks : uint8_t { kNothing, kExact, kCoarse };
  Lacks lacks_ = Lacks::kNothing;  // space for a map, since the last keepWithin()
  bool reserves_ = false;          // leaves a part of the limit to the next undo
  std::vector<int32_t> levels_;
};

}  // namespace grisaille::sspm
