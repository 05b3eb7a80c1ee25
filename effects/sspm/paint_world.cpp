// SPDX-License-Identifier: MIT
#include "paint_world.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <utility>

namespace grisaille::sspm {
namespace {

constexpr size_t kMostWork = 64;       // shots under survey at the same time
constexpr double kMostEffort = 16384;  // of a step, except for a single shot
constexpr double kLeastEffort = 256;
constexpr double kShotEffort = 128;     // of a shot in a step, beside its rays; rays
constexpr double kPaceMemory = 0.9;     // share of the mean that each step leaves
constexpr uint64_t kWaitingShare = 32;  // of the limit: what may wait for its upload
// Of a record's root; same as in shaders/sspm/walk.glsl.
constexpr uint32_t kCoarse = 1u << 16, kMapRangeShift = 17;
constexpr size_t kFewSpots = 512, kManySpots = 8192;  // that thin() looks at without a pause
constexpr int kMostAsks = 4;  // frames in a row that ask for one shot's depth pictures

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

void PaintWorld::follow(std::span<const Shot> shots, size_t kept, const PaintRules& rules,
                        uint64_t limit) {
  list_ = shots;
  const bool sameRange = rules.range == rules_.range;
  const bool same = rules == rules_;
  rules_ = rules;
  // Arrays do not shrink: a limit that they exceed starts anew.
  const bool tooLarge = limit < limit_ && bytes() > limit;
  Changed changed = Changed::kNothing;
  // More memory brings back what samples have hidden.
  if (!same || (limit > limit_ && sampled_)) changed = Changed::kHiding;
  if (!sameRange) changed = Changed::kRange;
  forget(tooLarge ? 0 : std::min({kept, shots.size(), states_.size()}), changed);
  if (std::exchange(limit_, limit) < limit) takeUp(0);
  // What an undo brings back may need a little more memory than it had: new shots leave some.
  if (shots.size() > states_.size()) {
    reserves_ = true;
    turn_ = kNone;
  }
  for (size_t i = states_.size(); i < shots.size(); ++i) {
    pending_.push_back(static_cast<uint32_t>(i));
  }
  states_.resize(shots.size());
  keepWithin();
}

size_t PaintWorld::update(std::span<const Shot> shots, size_t kept, const PaintRules& rules,
                          double patience, uint64_t limit, const Sight& sight) {
  const auto start = std::chrono::steady_clock::now();
  follow(shots, kept, rules, limit);
  std::vector<uint32_t> unknown;
  askAgain(sight);
  const auto left = [&] { return patience - secondsSince(start); };
  const size_t spots = std::isfinite(patience) ? kFewSpots : kManySpots;
  while (step(pace_.effortIn(left()), sight, unknown)) {
    while (thin(sight.cast, spots) && left() > 0) continue;
    keepWithin();
    if (left() <= 0 || (std::isfinite(patience) && isUploadDue())) break;
  }
  if (!unknown.empty()) {
    pending_.insert(pending_.end(), unknown.begin(), unknown.end());
    std::ranges::sort(pending_);
  }
  while (thin(sight.cast, spots) && left() > 0) continue;
  while (sweep() && left() > 0) continue;
  return pending_.size() + work_.size() + partly_.size();
}

// Effort that takes about `seconds`.
double PaintWorld::Pace::effortIn(double seconds) const {
  const double most = effort > 0 ? seconds * effort / spent : kLeastEffort;
  return std::clamp(most, kLeastEffort, kMostEffort);
}

void PaintWorld::Pace::note(double seconds, double done) {
  spent = kPaceMemory * spent + seconds;
  effort = kPaceMemory * effort + done;
}

// Whether changes wait that take much of the limit, which counts them until they are uploaded.
bool PaintWorld::isUploadDue() const {
  return records_.waitingBytes() + blocks_.waitingBytes() > limit_ / kWaitingShare;
}

void PaintWorld::upload(const plugin::Frame& frame, Uploader& uploader) {
  cells_.write([&](const Entry& entry) { return recordOf(entry); });
  for (DeviceWords* words : {&cells_.slots(), &cells_.words(), &records_, &blocks_}) {
    uploader.upload(frame, *words);
  }
}

void PaintWorld::clear() {
  cells_.clear();
  runs_.clear();
  blocks_.clear();
  records_.clear();
  entries_ = hidden_ = 0;
  floors_ = {};
  plannedFor_ = 0;
  raises_.clear();
  coarse_ = 0;
  turn_ = kNone;
  states_.clear();
  pending_.clear();
  work_.clear();
  partly_.clear();
  twins_.clear();
  placed_.clear();
  thinning_ = {};
  thinned_ = 0;
  sampled_ = false;
  former_.clear();
  freeRecords_.clear();
  levels_.clear();
}

// Forgets all shots but the first `count`. Places those anew that a forgotten one hid; with a
// change, all that another one hid; and with a change of the range, all that follow it.
void PaintWorld::forget(size_t count, Changed changed) {
  if (count == 0) {
    clear();
    return;
  }
  const bool allLost = changed != Changed::kNothing;
  if (count >= states_.size() && !allLost) return;
  thinning_ = {};
  thinned_ = 0;
  sampled_ = sampled_ && !allLost;
  const size_t least = allLost ? 0 : count;
  std::vector<bool> gone(states_.size()), anew(states_.size());
  for (uint32_t id = 0; id < gone.size(); ++id) {
    gone[id] = id >= count;
    anew[id] = gone[id] || states_[id].lostTo > least ||
               (changed == Changed::kRange && list_[id].range <= 0);
  }
  forgetTwins(anew, count);
  if (allLost) {
    for (Cell& cell : cells_.cells()) {
      cell.unseal();
    }
  }
  erase(gone);
  placeAnew(anew, count);
  if (changed == Changed::kRange) spread();
  if (count < states_.size()) reserves_ = false;
  states_.resize(count);
  takeUp(allLost ? 0 : count);
}

// Removes shots from everything.
void PaintWorld::erase(const std::vector<bool>& gone) {
  size_t empty = 0;
  for (Cell& cell : cells_.cells()) {
    const auto erased = cell.entries.eraseIf([&](const Entry& entry) { return gone[entry.shot]; });
    empty += cell.entries.empty() ? 1 : 0;
    if (erased == 0) continue;
    entries_ -= erased;
    cell.unseal();
    cells_.change(cell);
  }
  if (empty > cells_.cells().size() / 8 && !thinning_.isActive()) cells_.removeEmpty();
  const auto isGone = [&](const Work& work) { return static_cast<bool>(gone[work.id]); };
  std::erase_if(work_, isGone);
  std::erase_if(partly_, isGone);
  std::erase_if(pending_, [&](uint32_t id) { return static_cast<bool>(gone[id]); });
  for (uint32_t id = 0; id < gone.size(); ++id) {
    if (!gone[id]) continue;
    for (const uint32_t record : {states_[id].record, id < former_.size() ? former_[id] : kNone}) {
      if (record == kNone) continue;
      Placed& placed = placed_[record];
      if (placed.hidden) hidden_ -= placed.others;
      placed.cores = placed.others = 0;
      release(record);
    }
    states_[id] = {};
  }
}

// Asks one round of rays for the newest pending shots. Returns false if no shot is pending, if the
// host can tell nothing, or if it does not have the depth pictures of a shot yet: others would only
// make it draw more pictures at a time.
// most: effort after which no further shot takes part; rays.
// unknown: gets the shots of which the host cannot tell yet.
bool PaintWorld::step(double most, const Sight& sight, std::vector<uint32_t>& unknown) {
  const auto start = std::chrono::steady_clock::now();
  refill();
  if (work_.empty()) return false;
  std::vector<Work*> now;
  double effort = 0;
  for (Work& work : work_) {
    const double more = static_cast<double>(work.survey.rays().size()) + kShotEffort;
    if (!now.empty() && effort + more > most) break;
    now.push_back(&work);
    effort += more;
  }
  if (!askFor(now, sight)) return false;
  bool late = false;
  for (Work* each : now) {
    Work& work = *each;
    late = late || (looks_ && !work.told);
    if (!advance(work, unknown)) work.id = kNone;
  }
  std::erase_if(work_, [](const Work& work) { return work.id == kNone; });
  pace_.note(secondsSince(start), effort);
  return !late;
}

// Continues with a shot after a round of rays. Returns false once its survey is not needed any
// more.
bool PaintWorld::advance(Work& work, std::vector<uint32_t>& unknown) {
  if (!work.told) {
    if (looks_ && work.asked < kMostAsks) return true;
    turn_ = looks_ ? work.id : kNone;
    unknown.push_back(work.id);
    return false;
  }
  if (!work.survey.rays().empty()) return true;
  const bool again = isPlaced(work.id);  // to be sharpened
  const auto isLost = [&] { return !again && states_[work.id].lostTo > 0; };
  if (!isLost() && work.survey.isRough()) {
    work.grid = gridFor(work.survey.frame());
    if (!again) findHidden(work.id, work.survey, *work.grid);
  }
  if (isLost()) {
    retire(work.id);
    return false;
  }
  if (work.survey.isRough()) {
    work.survey.refine();
    return true;
  }
  if (!again && !fits(work.coarse.words.empty() ? work.map : work.coarse)) {
    // It comes again, once older paint has made room.
    lacks_ = Lacks::kCoarse;
    pending_.insert(std::ranges::lower_bound(pending_, work.id), work.id);
  } else if (!again) {
    place(work);
  } else if (work.survey.unknownInside() > 0) {
    unknown.push_back(work.id);
  } else {
    sharpen(work);
  }
  return false;
}

// Sorts the pending shots, and removes those that are listed twice.
void PaintWorld::sortPending() {
  std::ranges::sort(pending_);
  pending_.erase(std::unique(pending_.begin(), pending_.end()), pending_.end());
}

void PaintWorld::refill() {
  const size_t mostWork = looks_ ? kMostLooks : kMostWork;
  while (work_.size() < mostWork && !pending_.empty()) {
    auto next = std::ranges::lower_bound(pending_, turn_);
    if (next == pending_.begin()) {
      turn_ = kNone;
      next = pending_.end();
    }
    const uint32_t id = *--next;
    const Shot& shot = list_[id];
    // Places its twin first.
    if (std::ranges::any_of(work_, [&](const Work& w) { return areTwins(list_[w.id], shot); }))
      return;
    pending_.erase(next);
    // Newer paint hides a shot that was to be sharpened, or a newer twin stands for it.
    if (isPlaced(id) || (states_[id].lostTo == 0 && !countTwin(id))) {
      const bool exact = isPlaced(id) || id >= floors_.coarse;
      const auto detail = exact ? Survey::Detail::kExact : Survey::Detail::kCoarse;
      work_.push_back({.id = id, .survey = Survey(shot, rangeOf(id), detail)});
    } else {
      retire(id);
    }
  }
}

// Level for a shot: cells about two ranges wide, or wider if their numbers would not fit at the
// shot's position.
CellGrid PaintWorld::gridFor(const ShotFrame& frame) {
  const glm::dvec3 far = glm::abs(frame.origin) + 2.0 * double{frame.range} / double{frame.slope};
  const double least = std::max({far.x, far.y, far.z}) * 0x1p-28;
  const int exponent =
      std::max(static_cast<int>(std::lround(std::log2(2 * std::max(frame.range, 8 * frame.bias)))),
               static_cast<int>(std::ceil(std::log2(least))));
  const int32_t code = levelCode(std::clamp(exponent, -40, 40));
  if (std::ranges::find(levels_, code) != levels_.end()) return {frame.origin, code};
  if (levels_.size() < kMostLevels) {
    levels_.push_back(code);
    return {frame.origin, code};
  }
  // All levels are in use. Any width is correct, but wider cells are slower: takes the next wider
  // one, or the widest.
  int32_t best = *std::ranges::max_element(levels_);
  for (const int32_t level : levels_) {
    if (level >= code) best = std::min(best, level);
  }
  return {frame.origin, best};
}

void PaintWorld::place(Work& work) {
  const uint32_t id = work.id;
  const Survey& survey = work.survey;
  const ShotMap& map = work.map;
  std::vector<Share>& shares = work.shares;
  const bool partly = survey.unknownInside() > 0;
  retire(id);
  if (!shares.empty()) {
    const uint32_t record = takeRecord(id);
    placing_ = record;
    // Cells that its surfaces only come close to matter as long as other cells show it.
    const auto others = std::partition(shares.begin(), shares.end(),
                                       [](const Share& share) { return !share.points.empty(); });
    const bool thin = others == shares.begin();
    for (const Share& share : shares) {
      join(record, survey.frame(), *work.grid, map, share, thin);
    }
    placing_ = kNone;
    Placed& placed = placed_[record];
    if (placed.cores > 0) {
      placed.coarse = store(work.coarse);
      // A map for which no space is large enough would make the array grow beyond the limit.
      const bool hasRoom = placed.coarse.blocks == 0 || fits(map);
      if (!hasRoom) lacks_ = Lacks::kExact;
      const bool isCoarse =
          (survey.isCoarse() || id < floors_.coarse || !hasRoom) && placed.coarse.blocks > 0;
      if (!isCoarse) placed.exact = store(map);
      coarse_ += isCoarse ? 1 : 0;
    }
    placed.slope = survey.frame().slope;
    placed.mapRange = survey.frame().range;
    writeRecord(record);
    release(record);
  }
  work.cells.resize(shares.size());
  std::ranges::transform(shares, work.cells.begin(), &Share::key);
  joinTwins(id, work.cells);
  work.muzzle.reset();
  if (partly) partly_.push_back(std::move(work));
}

// Gives a placed shot its exact map back.
void PaintWorld::sharpen(const Work& work) {
  const uint32_t record = states_[work.id].record;
  Placed& placed = placed_[record];
  if (!placed.isCoarse()) return;
  if (!fits(work.map)) {
    lacks_ = Lacks::kExact;
    return;
  }
  placed.exact = store(work.map);
  --coarse_;
  writeRecord(record);
}

// Removes a shot from all lists. cells: those in which it was placed.
void PaintWorld::remove(uint32_t id, std::span<const CellKey> cells) {
  for (const CellKey& key : cells) {
    Cell* cell = cells_.find(key);
    if (cell == nullptr) continue;
    const auto isIts = [&](const Entry& it) { return it.shot == id && !it.former; };
    const auto listed = std::ranges::find_if(cell->entries, isIts);
    if (listed == cell->entries.end()) continue;
    const Entry entry = *listed;
    cell->entries.eraseIf(isIts);
    cell->unseal();
    cells_.change(*cell);
    unlist(entry, 0);
  }
}

void PaintWorld::writeRecord(uint32_t index) {
  const Placed& placed = placed_[index];
  const Shot& shot = list_[placed.shot];
  const auto record = records_.write(index * kRecordWords, kRecordWords);
  // Rounds to the nearest metre: small scenes around the world's origin keep all digits of their
  // floats.
  const glm::dvec3 origin(shot.origin[0], shot.origin[1], shot.origin[2]);
  const glm::dvec3 whole = glm::round(origin);
  for (int axis = 0; axis < 3; ++axis) {
    const size_t i = static_cast<size_t>(axis);
    record[i] = static_cast<uint32_t>(static_cast<int32_t>(whole[axis]));
    record[4 + i] = std::bit_cast<uint32_t>(static_cast<float>(origin[axis] - whole[axis]));
    record[8 + i] = std::bit_cast<uint32_t>(shot.direction[i]);
  }
  // No point is within a negative range.
  record[3] = std::bit_cast<uint32_t>(placed.hidden ? -1.0f : rangeOf(placed.shot));
  record[7] = std::bit_cast<uint32_t>(placed.slope);
  record[11] = placed.shot + 1;
  // The shot's alpha counts once, and once for each of the twins that it hides.
  const float times = std::min(1.0f + static_cast<float>(placed.counted), 65504.0f);
  record[12] = glm::packHalf2x16(glm::vec2(shot.color[0], shot.color[1]));
  record[13] = glm::packHalf2x16(glm::vec2(shot.color[2], times));
  const MapRun& map = placed.isCoarse() ? placed.coarse : placed.exact;
  record[14] = map.base;
  // Within what a half float holds: a larger or smaller share serves as well.
  const float share = placed.mapRange / rangeOf(placed.shot);
  record[15] = map.root | (placed.isCoarse() ? kCoarse : 0) |
               glm::packHalf2x16({glm::clamp(share, 1e-4f, 65504.0f), 0}) << kMapRangeShift;
}

}  // namespace grisaille::sspm
