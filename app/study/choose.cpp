// SPDX-License-Identifier: MIT
#include "app/study/choose.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "core/base/atomic_file.h"
#include "core/base/error.h"

namespace grisaille::app::study {
namespace {

bool isWhole(const Record& r) {
  return !r.errors.empty() && r.cost() > 0;
}

std::map<std::string, double> medianCosts(std::span<const Record> records) {
  std::map<std::string, std::vector<double>> costs;
  for (const Record& r : records) {
    if (isWhole(r)) costs[r.backend].push_back(r.cost());
  }
  std::map<std::string, double> medians;
  for (const auto& [backend, all] : costs) medians[backend] = medianOf(all);
  return medians;
}

// Throws kUsage unless all settings are of one and the same effect.
void requireOneEffect(std::span<const Choice> choices) {
  std::set<std::string> effects;
  for (const Choice& choice : choices) {
    for (const effect::Assignment& one : choice.setting) effects.insert(one.name.effect);
  }
  if (effects.size() != 1) {
    throw Error(ErrorId::kUsage, "--presets needs settings of one effect; --out holds {} effects",
                effects.size());
  }
}

std::string sentenceOf(std::span<const Record> records) {
  const Record& r = records.front();
  std::vector<std::string> backends, cameras;
  for (const std::string& backend : backendsOf(records)) {
    const auto own = std::ranges::find(records, backend, &Record::backend);
    backends.push_back(fmt::format("{} on {}, {} clock", backend, own->device, own->clock));
  }
  for (const CameraErrors& e : r.errors) cameras.push_back(e.camera);
  constexpr size_t kMostNames = 8;
  const std::string seen = cameras.size() > kMostNames
                               ? fmt::format("{} cameras", cameras.size())
                               : fmt::format("cameras {}", fmt::join(cameras, ", "));
  const size_t from = r.study.find("size ") + 5;
  return fmt::format("{}; {} pixels; {}; {} settings; {}; commit {}", fmt::join(backends, "; "),
                     r.study.substr(from, r.study.find('\n', from) - from), seen,
                     records.size() / backends.size(), r.machine, r.commit);
}

}  // namespace

std::vector<Choice> choicesOf(std::span<const Record> records) {
  const std::map<std::string, double> medians = medianCosts(records);
  std::vector<Choice> choices;
  std::map<SettingText, std::vector<const Record*>> settings;
  for (const Record& r : records) {
    if (isWhole(r)) settings[r.setting].push_back(&r);
  }
  for (const Record& r : records) {
    const auto own = settings.find(r.setting);
    if (own == settings.end() || own->second.size() != medians.size()) continue;
    Choice choice{.setting = r.setting, .price = {.cost = 0, .error = 0}, .errors = {}};
    choice.errors.resize(r.errors.size());
    for (const Record* one : own->second) {
      for (size_t i = 0; i < one->errors.size() && i < choice.errors.size(); ++i) {
        choice.errors[i] += one->errors[i].rmse / static_cast<double>(medians.size());
      }
      choice.price.error += one->rmse() / static_cast<double>(medians.size());
      choice.price.cost += std::log(one->cost() / medians.at(one->backend));
    }
    choice.price.cost = std::exp(choice.price.cost / static_cast<double>(medians.size()));
    choices.push_back(std::move(choice));
    settings.erase(own);
  }
  return choices;
}

double worstLoss(std::span<const double> dearer, std::span<const double> cheaper) {
  double worst = -std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < dearer.size(); ++i) worst = std::max(worst, dearer[i] - cheaper[i]);
  return worst;
}

std::vector<size_t> presetsOn(std::span<const Price> front,
                              std::span<const std::vector<double>> errors) {
  constexpr size_t kCount = std::size(kPresetNames);
  if (front.size() < kCount) {
    throw Error(ErrorId::kFrontSmall, "the front has {} settings; presets need at least {}",
                front.size(), kCount);
  }
  const size_t reference = front.size() - 1;
  std::vector<size_t> chosen = {reference};
  // The most that any chosen preset loses against point i.
  const auto loss = [&](size_t i) {
    double most = -std::numeric_limits<double>::infinity();
    for (const size_t dearer : chosen) {
      if (!errors.empty()) most = std::max(most, worstLoss(errors[dearer], errors[i]));
    }
    return most;
  };
  for (size_t k = kCount - 1; k-- > 0;) {
    const double most = kMostShare[k] * front[reference].cost;
    size_t dearest = 0;
    while (dearest + 1 < reference && front[dearest + 1].cost <= most) ++dearest;
    if (front[0].cost > most) dearest = (k * reference + 1) / (kCount - 1);
    // Cheaper presets need k points below.
    dearest = std::clamp(dearest, k, chosen.back() - 1);
    size_t best = dearest;
    for (size_t i = dearest; i + 1 > k && loss(best) > kMostLoss; --i) {
      if (loss(i) < loss(best)) best = i;
    }
    chosen.push_back(best);
  }
  std::ranges::reverse(chosen);
  return chosen;
}

std::vector<size_t> worthwhile(std::span<const Price> prices, std::span<const size_t> front) {
  std::vector<size_t> worth;
  double same = 0;  // up to this cost, points cost as much as the last one
  for (const size_t i : front) {
    if (!worth.empty() && prices[i].error >= kWorth * prices[worth.back()].error) continue;
    if (prices[i].cost <= same) {
      worth.back() = i;
    } else {
      worth.push_back(i);
      same = (1 + kClockNoise) * prices[i].cost;
    }
  }
  return worth;
}

NamedPreset parseNamedPreset(const std::string& text) {
  const size_t name = text.find('='), value = text.find('=', name + 1);
  const auto refuse = [&](const std::string& why) {
    throw Error(ErrorId::kUsage, "--also '{}' {}; write NAME=EFFECT.KEY=VALUE", oneLine(text), why);
  };
  if (name == std::string::npos || value == std::string::npos) refuse("has fewer than two '='");
  NamedPreset named;
  named.name = text.substr(0, name);
  if (!isPresetName(named.name)) refuse("begins with no name of a preset (a-z, 0-9, _)");
  if (std::ranges::count(kPresetNames, named.name) > 0) refuse("names a preset of the front");
  named.value = {effect::parseParameterName(text.substr(name + 1, value - name - 1)),
                 text.substr(value + 1)};
  return named;
}

void writePresets(std::span<const Record> records, std::span<const NamedPreset> more,
                  const std::string& file) {
  const std::vector<Choice> choices = choicesOf(records);
  requireOneEffect(choices);
  std::vector<Price> prices, front;
  for (const Choice& choice : choices) prices.push_back(choice.price);
  const std::vector<size_t> order = worthwhile(prices, frontOf(prices));
  std::vector<std::vector<double>> errors;
  for (const size_t i : order) {
    front.push_back(prices[i]);
    errors.push_back(choices[i].errors);
  }
  const std::vector<size_t> chosen = presetsOn(front, errors);
  Presets presets{.study = sentenceOf(records), .all = {}};
  const auto add = [&](const std::string& name, const Choice& choice) {
    Preset preset{.name = name,
                  .error = choice.price.error,
                  .cost = choice.price.cost / front[chosen[1]].cost,
                  .values = {}};
    for (const effect::Assignment& one : choice.setting) {
      preset.values.emplace_back(one.name.key, one.value);
    }
    presets.all.push_back(std::move(preset));
  };
  for (size_t i = 0; i < chosen.size(); ++i) add(kPresetNames[i], choices[order[chosen[i]]]);
  for (const NamedPreset& named : more) {
    const Choice* best = nullptr;
    for (const Choice& choice : choices) {
      const bool has = std::ranges::any_of(choice.setting, [&](const effect::Assignment& one) {
        return one.text() == named.value.text();
      });
      if (has && (best == nullptr || choice.price.error < best->price.error)) best = &choice;
    }
    if (best == nullptr) {
      throw Error(ErrorId::kUsage, "--also {}: no measured setting has {}", named.name,
                  named.value.text());
    }
    add(named.name, *best);
  }
  writeFileAtomically(file, presetsToml(presets));
}

}  // namespace grisaille::app::study
