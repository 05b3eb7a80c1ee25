// SPDX-License-Identifier: MIT
#include "paint_world.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

namespace grisaille::sspm {
namespace {

constexpr uint64_t kWaitingShare = 32;  // of the limit: what may wait for its upload
constexpr uint64_t kEarlyShare = 8;     // of the limit: largest array before it is planned
constexpr double kUploadMemory = 0.9;   // share of the longest upload that each frame leaves
// Longest step, seconds and share of the patience, whichever is more: short ones complete the
// newest shots before others begin.
constexpr double kLongestStep = 0.002, kStepShare = 0.016;
// Set aside for steps that take longer than usual: least share of the patience, and most seconds.
constexpr double kLateShare = 0.25, kMostLate = 0.002;
// Of a record's root; same as in shaders/sspm/walk.glsl.
constexpr uint32_t kCoarse = 1u << 16, kMapRangeShift = 17;
constexpr size_t kFewSpots = 512, kManySpots = 8192;  // that thin() looks at without a pause

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
  lengthBefore_ = std::min(lengthBefore_, static_cast<uint32_t>(states_.size()));
  if (shots.size() > states_.size()) {
    lengthBefore_ = static_cast<uint32_t>(states_.size());
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
  // A fourth of a patience up to 2.7 ms; of a longer one what is over 2 ms, at most 2 ms.
  const double late = std::min(std::max(kLateShare * patience, patience - kMostLate), kMostLate);
  const double usual = patience - late;
  const double placing = usual - std::min(uploadTime_, usual / 2);
  const auto left = [&] { return placing - secondsSince(start); };
  const size_t spots = std::isfinite(patience) ? kFewSpots : kManySpots;
  const double longest =
      std::isfinite(patience) ? std::max(kLongestStep, kStepShare * patience) : patience;
  double alone = std::numeric_limits<double>::infinity();  // the first step, however long it takes
  while (!(thinning_.isActive() && isFull()) &&
         step(pace_.effortIn(std::min(left(), longest)), alone, sight, unknown)) {
    alone = pace_.mostIn(left());
    makeRoom();
    while (thin(sight.cast, spots) && left() > 0) continue;
    while (isFull() && sweep()) continue;
    keepWithin();
    if (left() <= 0 || (std::isfinite(patience) && isUploadDue())) break;
  }
  if (placeRest()) keepWithin();
  if (!unknown.empty()) {
    pending_.insert(pending_.end(), unknown.begin(), unknown.end());
    std::ranges::sort(pending_);
  }
  while (thin(sight.cast, spots) && left() > 0) continue;
  while (sweep() && left() > 0) continue;
  return pending_.size() + work_.size() + partly_.size();
}

// Whether changes wait that take much of the limit, which counts them until they are uploaded.
bool PaintWorld::isUploadDue() const {
  return records_.waitingBytes() + blocks_.waitingBytes() > limit_ / kWaitingShare;
}

void PaintWorld::upload(const plugin::Frame& frame, Uploader& uploader) {
  const auto start = std::chrono::steady_clock::now();
  cells_.write([&](const Entry& entry) { return recordOf(entry); });
  uploader.upload(frame, cells_.slots(), 0, 0);
  for (DeviceWords* words : {&cells_.words(), &records_, &blocks_}) {
    uploader.upload(frame, *words, room() - std::min(room(), bytes()), limit_ / kEarlyShare);
  }
  uploadTime_ = std::max(secondsSince(start), kUploadMemory * uploadTime_);
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
  sampled_ = sampled_ && !allLost;
  const size_t least = allLost ? 0 : count;
  std::vector<bool> gone(states_.size()), anew(states_.size());
  for (uint32_t id = 0; id < gone.size(); ++id) {
    gone[id] = id >= count;
    anew[id] = gone[id] || states_[id].lostTo > least ||
               (changed == Changed::kRange && list_[id].range <= 0);
  }
  forgetTwins(anew, count);
  for (Cell& cell : cells_.cells()) {
    const bool coveredSince = cell.coveredBelow > 0 && cell.coverer >= count;
    if (allLost || coveredSince) cell.unseal();
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
    const auto erased = cell.eraseIf([&](const Entry& entry) { return gone[entry.shot]; });
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
    const uint32_t lostTo = isLost(id) ? states_[id].lostTo : 0;
    for (const uint32_t record : {states_[id].record, id < former_.size() ? former_[id] : kNone}) {
      if (record == kNone) continue;
      Placed& placed = placed_[record];
      if (placed.hidden) hidden_ -= placed.others;
      placed.cores = placed.others = 0;
      release(record);
    }
    states_[id] = {.lostTo = lostTo, .exact = states_[id].exact};
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
