// SPDX-License-Identifier: MIT
#include "app/study/tuning.h"

#include <algorithm>
#include <map>

#include "app/settings/presets.h"

namespace grisaille::app::study {

std::vector<Point> startsOf(const Subject& subject, const std::vector<Axis>& axes) {
  effect::Selection defaults(*subject.registry, subject.effects);
  fit(defaults, subject.lengths);
  effect::Selection present = defaults;
  for (const effect::Assignment& set : subject.sets) present.set(set);
  std::map<std::string, Presets> presets;  // by effect
  for (const effect::Effect* effect : defaults.effects()) {
    presets.emplace(effect->desc->key, loadPresets(*effect));
  }
  std::vector<Point> points;
  const auto add = [&](const effect::Selection& selection) {
    Point point;
    for (const Axis& axis : axes) {
      point.push_back(selection.find(axis.name.effect)->values.get(axis.name.key));
    }
    if (std::ranges::find(points, point) == points.end()) points.push_back(std::move(point));
  };
  add(present);
  for (const char* name : kPresetNames) {
    effect::Selection selection = present;
    for (const auto& [effect, own] : presets) {
      if (!own.all.empty()) applyPreset(selection.values(effect), own, name);
    }
    add(selection);
  }
  add(defaults);
  return points;
}

Setting Bench::settingOf(const Point& point) const {
  Setting setting;
  for (size_t i = 0; i < axes_.size(); ++i) setting.push_back({axes_[i].name, point[i]});
  return setting;
}

double Bench::error(const Point& point) {
  double sum = 0;
  for (const CameraErrors& e : measurer_.errors(running(point))) sum += e.rmse;
  return sum / static_cast<double>(subject_.views.size());
}

double Bench::cost(const Point& point) {
  effect::Chain& own = running(point);
  std::vector<double> all;
  for (int i = 0; i < kRounds; ++i) all.push_back(measurer_.cost(own));
  return medianOf(all);
}

double Bench::costBeside(const Point& point, const Evaluated& known) {
  effect::Chain& a = running(known.point);
  effect::Chain& b = running(point);
  std::vector<double> ratios;
  for (int i = 0; i < kRounds; ++i) {
    const double first = measurer_.cost(a);
    ratios.push_back(measurer_.cost(b) / first);
  }
  return known.cost * medianOf(ratios);
}

effect::Chain& Bench::running(const Point& point) {
  auto found = std::ranges::find(running_, point, &Kept::point);
  if (found == running_.end()) {
    if (running_.size() == kKept) running_.erase(running_.begin());
    running_.push_back({point, measurer_.start(settingOf(point))});
    measurer_.cost(*running_.back().chain);  // pipelines are created outside the clock
  } else {
    std::rotate(found, found + 1, running_.end());
  }
  return *running_.back().chain;
}

}  // namespace grisaille::app::study
