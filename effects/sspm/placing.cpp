// SPDX-License-Identifier: MIT
// Places pending shots: surveys them, some rays of several shots at a time, and lists them in
// cells.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "paint_world.h"
#include "threads.h"

namespace grisaille::sspm {
namespace {

constexpr size_t kMostWork = 64;       // shots under survey at the same time
constexpr double kMostEffort = 16384;  // of a step, except for a single shot
constexpr double kLeastEffort = 256;
constexpr double kRoundEffort = 24;   // of a round of a shot's rays, beside the rays; rays
constexpr double kPlaceEffort = 240;  // of listing a surveyed shot in its cells; rays
constexpr double kCastShare = 0.4;    // of a ray's effort, for the host's cast
// Of the parts of a survey, for each of its rays.
constexpr double kPartEffort[] = {0.3, 0.18, 0.16};
constexpr double kPaceMemory = 0.9;  // share of the mean that each step leaves
constexpr double kAim = 0.85;        // of the time left, for a step: some take twice the mean
// Complete surveys for which it is worth a thread to place them while the host casts the next rays.
constexpr size_t kWorthThread = 4;
constexpr int kMostAsks = 4;  // frames in a row that ask for one shot's depth pictures

}  // namespace

// Effort that takes about `seconds`, for tasks of several shots.
double PaintWorld::Pace::effortIn(double seconds) const {
  return std::clamp(mostIn(seconds), kLeastEffort, kMostEffort);
}

// The same for one task of one shot.
double PaintWorld::Pace::mostIn(double seconds) const {
  return effort > 0 ? kAim * seconds * effort / spent : kLeastEffort;
}

void PaintWorld::Pace::note(double seconds, double done) {
  spent = kPaceMemory * spent + seconds;
  effort = kPaceMemory * effort + done;
}

PaintWorld::Effort PaintWorld::Work::roundEffort() const {
  const auto rays = static_cast<double>(survey.rays().size());
  return {.shared = kRoundEffort + kCastShare * rays, .alone = (1 - kCastShare) * rays};
}

PaintWorld::Effort PaintWorld::Work::partEffort(int part) const {
  return {.shared = part + 1 == kParts ? kPlaceEffort : 0,
          .alone = kPartEffort[part] * static_cast<double>(survey.cast())};
}

// Adds a task. Threads that have ended theirs wait for the largest one.
PaintWorld::Effort PaintWorld::Effort::with(const Effort& task) const {
  return {.shared = shared + task.shared,
          .alone = alone + task.alone,
          .largest = std::max(largest, task.alone)};
}

double PaintWorld::Effort::rays() const {
  static const double threads = std::max(1u, std::thread::hardware_concurrency());
  return shared + std::max(alone, threads * largest);
}

// Takes the newest pending shots one step further: each by a round of rays, or by some of the parts
// of its survey. Returns false if no shot is pending, if all of
// them take too long, if the host can tell nothing, or if it does not have the depth pictures of a
// shot yet: others would only make it draw more pictures at a time.
// most: effort after which no further shot takes part. alone: effort up to which the newest takes
// part anyway. Both in rays.
// unknown: gets the shots of which the host cannot tell yet.
bool PaintWorld::step(double most, double alone, const Sight& sight,
                      std::vector<uint32_t>& unknown) {
  const auto start = std::chrono::steady_clock::now();
  refill();
  std::vector<Work*> now, asked, surveyed;
  std::vector<Task> tasks;
  Effort effort;
  const auto fits = [&](const Effort& more) {
    const Effort sum = effort.with(more);
    if (sum.rays() > (effort.rays() == 0 ? std::max(most, alone) : most)) return false;
    effort = sum;
    return true;
  };
  for (Work& work : work_) {
    if (work.isComplete()) continue;
    int part = work.parts;
    if (!work.isSurveyed()) {
      if (!fits(work.roundEffort())) break;
      asked.push_back(&work);
    } else {
      for (; part < kParts && fits(work.partEffort(part)); ++part) tasks.push_back({&work, part});
      if (part > work.parts) surveyed.push_back(&work);
    }
    if (asked.size() + surveyed.size() > now.size()) now.push_back(&work);
    if (work.isSurveyed() && part < kParts) break;
  }
  if (now.empty()) return placeRest();
  const bool can = askFor(asked, tasks, sight);
  for (Work* work : asked) {
    if (!can || !work->isRoughComplete()) continue;
    work->grid = gridFor(work->survey.frame());
    refine(*work);
  }
  bool late = !can;
  for (Work* each : can ? now : surveyed) {
    Work& work = *each;
    late = late || (looks_ && !work.told);
    if (!advance(work, unknown)) work.id = kNone;
  }
  dropDone();
  if (completeCount() < kWorthThread) placeRest();
  pace_.note(secondsSince(start), effort.rays());
  return !late;
}

// Continues with a shot whose rough picture is complete, unless newer paint hides it. It needs a
// grid. Several threads may call it, for different shots.
void PaintWorld::refine(Work& work) {
  if (!isPlaced(work.id)) findHidden(work);
  if (!isLost(work.id)) work.survey.refine();
}

// Continues with a shot after a round of rays or some of its parts. Returns false once its survey
// is not needed any more.
bool PaintWorld::advance(Work& work, std::vector<uint32_t>& unknown) {
  if (!work.told) {
    if (looks_ && work.asked < kMostAsks) return true;
    turn_ = looks_ ? work.id : kNone;
    unknown.push_back(work.id);
    return false;
  }
  if (!work.survey.rays().empty()) return true;
  if (isLost(work.id)) {
    retire(work.id);
    return false;
  }
  if (work.isComplete() && isPlaced(work.id) && work.survey.unknownInside() > 0) {
    unknown.push_back(work.id);
    return false;
  }
  return true;  // the other parts come in the next step, or placeComplete()
}

// Places the shots of complete surveys, and leaves it to dropDone() to remove these from the list.
// A thread may do so while the host casts rays, since nothing else uses cells and records then.
void PaintWorld::placeComplete() {
  for (Work& work : work_) {
    if (!work.isComplete() || work.id == kNone) continue;
    const uint32_t id = work.id;
    if (isPlaced(id)) {
      sharpen(work);
    } else if (fits(work.coarse.words.empty() ? work.map : work.coarse)) {
      place(work);
    } else {
      // It comes again, once older paint has made room.
      lacks_ = Lacks::kCoarse;
      pending_.insert(std::ranges::lower_bound(pending_, id), id);
    }
    work.id = kNone;
  }
}

// Places the shots of complete surveys at once. Returns whether there were any.
bool PaintWorld::placeRest() {
  const bool any = completeCount() > 0;
  placeComplete();
  dropDone();
  return any;
}

size_t PaintWorld::completeCount() const {
  return static_cast<size_t>(std::ranges::count_if(work_, &Work::isComplete));
}

void PaintWorld::dropDone() {
  std::erase_if(work_, [](const Work& work) { return work.id == kNone; });
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
      const bool exact = isPlaced(id) || states_[id].exact || id >= floors_.coarse;
      const auto detail = exact ? Survey::Detail::kExact : Survey::Detail::kCoarse;
      work_.push_back({.id = id, .survey = Survey(shot, rangeOf(id), detail)});
    } else {
      retire(id);
    }
  }
}

// Level for a shot: cells about two ranges wide, or wider if their numbers would not fit at the
// shot's position.
int32_t PaintWorld::levelFor(const ShotFrame& frame) {
  const glm::dvec3 far = glm::abs(frame.origin) + 2.0 * double{frame.range} / double{frame.slope};
  const double least = std::max({far.x, far.y, far.z}) * 0x1p-28;
  const int exponent =
      std::max(static_cast<int>(std::lround(std::log2(2 * std::max(frame.range, 8 * frame.bias)))),
               static_cast<int>(std::ceil(std::log2(least))));
  return levelCode(std::clamp(exponent, -40, 40));
}

// The grid of that level, or of another if all are in use.
CellGrid PaintWorld::gridFor(const ShotFrame& frame) {
  const int32_t code = levelFor(frame);
  if (isInUse(code)) return {frame.origin, code};
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
  states_[id].exact = !survey.isCoarse();
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
    cell->eraseIf(isIts);
    cell->unseal();
    cells_.change(*cell);
    unlist(entry, 0);
  }
}

}  // namespace grisaille::sspm
