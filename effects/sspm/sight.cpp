// SPDX-License-Identifier: MIT
// Answers the rays of surveys, by the host's rays or depth pictures.
#include <algorithm>
#include <functional>
#include <future>
#include <iterator>
#include <utility>

#include "paint_world.h"
#include "threads.h"

namespace grisaille::sspm {
namespace {

constexpr size_t kCoarseShare = 3;  // quarters of a map: a coarse map must be smaller

}  // namespace

// Answers the rays of several surveys, by the host's depth pictures if it draws any, and takes
// parts of surveys meanwhile. Returns false if there are rays and the host can tell nothing.
bool PaintWorld::askFor(std::span<Work* const> works, std::span<Task> tasks, const Sight& sight) {
  const bool looks = !works.empty() && lookFor(works, sight.draw);
  const bool can = castFor(looks ? std::span<Work* const>() : works, tasks, sight.cast);
  finish(tasks);
  return can;
}

// Casts the rays of several surveys in one batch. Returns false if the host casts no rays.
bool PaintWorld::castFor(std::span<Work* const> works, std::span<Task> tasks,
                         const CastRays& cast) {
  std::vector<grisaille_ray> rays;
  std::vector<size_t> first;
  for (const Work* work : works) {
    const auto asked = work->survey.rays();
    first.push_back(rays.size());
    rays.insert(rays.end(), asked.begin(), asked.end());
  }
  std::vector<grisaille_hit> hits(rays.size());
  std::future<void> placing;
  if (completeCount() > 0) placing = std::async(std::launch::async, [&] { placeComplete(); });
  const bool can = works.empty() || cast(rays, hits);
  if (placing.valid()) placing.get();
  // The largest first, so that threads end together.
  std::ranges::sort(tasks, std::ranges::greater(),
                    [](const Task& task) { return task.work->partEffort(task.part).alone; });
  onAllThreads(tasks.size() + (can ? works.size() : 0), [&](size_t i) {
    if (i < tasks.size()) {
      take(tasks[i]);
      return;
    }
    i -= tasks.size();
    Survey& survey = works[i]->survey;
    works[i]->told = survey.take(std::span(hits).subspan(first[i], survey.rays().size()));
    proceed(*works[i]);
  });
  return can;
}

// Goes on to the map, unless the shot needs a level that is not in use yet.
void PaintWorld::proceed(Work& work) {
  if (!work.isRoughComplete()) return;
  const ShotFrame& frame = work.survey.frame();
  const int32_t level = levelFor(frame);
  if (!isInUse(level)) return;
  work.grid = {frame.origin, level};
  refine(work);
}

// Completes the rough picture or the map of several surveys, by depth pictures, up to the first
// whose pictures the host does not have yet. Returns false if the host draws none.
bool PaintWorld::lookFor(std::span<Work* const> works, const DrawDepth& draw) {
  size_t known = 0;
  for (; known < works.size(); ++known) {
    Work& work = *works[known];
    if (!work.muzzle) work.muzzle = Muzzle::look(work.survey.frame(), draw);
    if (!work.muzzle) return false;
    looks_ = true;
    work.told = work.muzzle->isKnown();
    if (work.told) continue;
    work.muzzle.reset();
    ++work.asked;
    break;
  }
  onAllThreads(known, [&](size_t i) {
    Work& work = *works[i];
    std::vector<grisaille_hit> hits;
    while (work.told && !work.survey.rays().empty()) {
      const auto rays = work.survey.rays();
      hits.resize(rays.size());
      std::ranges::transform(rays, hits.begin(),
                             [&](const grisaille_ray& ray) { return work.muzzle->see(ray); });
      work.told = work.survey.take(hits);
    }
    proceed(work);
  });
  return true;
}

// Takes a part of a survey.
void PaintWorld::take(const Task& task) {
  Work& work = *task.work;
  const Survey& survey = work.survey;
  switch (task.part) {
    case kShares:
      work.shares = sharesOf(survey.frame(), *work.grid, survey.patches());
      break;
    case kCoarseMap:
      work.coarse = survey.coarseMap();
      break;
    default:
      if (!survey.isCoarse()) work.map = survey.map();
      break;
  }
}

// After tasks: notes what has been taken.
void PaintWorld::finish(std::span<const Task> tasks) {
  for (const Task& task : tasks) {
    Work& work = *task.work;
    work.parts = std::max(work.parts, task.part + 1);
  }
  for (const Task& task : tasks) {
    Work& work = *task.work;
    if (task.part + 1 != kParts) continue;
    if (work.survey.isCoarse()) {
      work.map = work.coarse;
      continue;
    }
    const size_t most = work.map.words.size() * kCoarseShare / 4;
    if (work.coarse.words.size() > most) work.coarse = {};
  }
}

// Asks again for placed shots with unknown squares, and places the shots again if the host can tell
// more.
void PaintWorld::askAgain(const Sight& sight) {
  for (std::deque<Work> asked = std::exchange(partly_, {}); !asked.empty(); asked.pop_front()) {
    Work& work = asked.front();
    const size_t before = work.survey.unknown();
    work.survey.askAgain();
    bool can = true, first = true, learned = false;
    while (can && !work.survey.rays().empty()) {
      Work* one = &work;
      can = askFor(std::span(&one, 1), {}, sight) && work.told;
      learned = can && (learned || !first || work.survey.unknown() < before);
      first = false;
    }
    if (learned) {
      Task tasks[] = {{&work, kShares}, {&work, kCoarseMap}, {&work, kExactMap}};
      askFor({}, tasks, sight);
      remove(work.id, work.cells);
      place(work);
      continue;
    }
    work.muzzle.reset();
    work.told = true;
    partly_.push_back(std::move(work));
    if (!looks_) continue;
    // The host draws the pictures of one of these shots a frame.
    asked.pop_front();
    partly_.insert(partly_.begin(), std::move_iterator(asked.begin()),
                   std::move_iterator(asked.end()));
    return;
  }
}

}  // namespace grisaille::sspm
