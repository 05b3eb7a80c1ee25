// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "app/settings/presets.h"
#include "app/settings/toml_table.h"
#include "app/settings/toml_values.h"
#include "app/study/flicker_run.h"
#include "app/study/gallery.h"
#include "core/base/error.h"
#include "core/frame/renderer.h"
#include "core/objects/object_file.h"
#include "core/scene/built_in.h"
#include "core/scene/camera_path.h"
#include "lab/claims/claims.h"
#include "lab/claims/metrics.h"

namespace grisaille::lab::claims {
namespace {

namespace fs = std::filesystem;
using app::TomlTable;

constexpr uint32_t kMostShots = 65536;
constexpr uint32_t kLargestSide = 4096;  // pixels

// Calls `work`, and puts `place` before the message of an error that it throws.
template <typename Work>
auto at(const std::string& place, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    // An error in a file is not an error of the command line.
    const ErrorId id = error.id() == ErrorId::kUsage ? ErrorId::kSettingsInvalid : error.id();
    throw Error(id, "{}: {}", place, error.detail());
  }
}

// Throws unless `name` has 1 to 60 letters, digits, - and _.
void requireName(TomlTable& table, const std::string& key, const std::string& name) {
  const auto good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_';
  };
  if (!name.empty() && name.size() <= 60 && std::ranges::all_of(name, good)) return;
  table.refuse(table.require(key),
               fmt::format("'{}' is not 1 to 60 letters, digits, - and _", key));
}

std::string jsonOf(const toml::table& table) {
  std::ostringstream json;
  json << toml::json_formatter(table);
  return json.str();
}

scene::Camera cameraOf(const TomlTable& owner, const toml::table& table) {
  return scene::parseCamera(jsonOf(table), owner.placeOf(table));
}

// The cameras of `frames` frames, one per frame. 1: a picture, not a path. `animated`: one camera
// may see all frames.
std::vector<scene::Camera> camerasOf(TomlTable& table, uint32_t frames, bool animated) {
  std::vector<scene::Camera> keys;
  for (const toml::table* one : table.tables("camera")) keys.push_back(cameraOf(table, *one));
  const toml::node& node = table.require("camera");
  const bool fits = animated ? frames > 1 : (frames > 1) == (keys.size() > 1);
  if (!fits) {
    table.refuse(node,
                 "a path needs at least two cameras and 'frames'; a picture needs one camera; an "
                 "animation needs 'frames'");
  }
  if (keys.size() == 1) return {frames, keys[0]};
  return at(table.placeOf(node), [&] { return scene::camerasOf({keys, frames}); });
}

// The times of `frames` frames in an animation; none: the scene is at rest.
std::vector<double> secondsOf(TomlTable& table, uint32_t frames) {
  const std::vector<double> ends = table.numbers("seconds", 2);
  std::vector<double> times;
  for (uint32_t i = 0; !ends.empty() && i < frames; ++i) {
    times.push_back(ends[0] + (ends[1] - ends[0]) * i / std::max(frames - 1, 1u));
  }
  return times;
}

std::vector<Shot> shotsOf(TomlTable& table, const effect::Registry& registry) {
  const toml::node* node = table.find("shots");
  if (node == nullptr) return {};
  if (const auto* file = node->as_string()) {
    const fs::path path = fs::path(table.file()).parent_path() / file->get();
    return at(table.placeOf(*node), [&] { return loadShots(registry, path.string()); });
  }
  objects::Objects shots(shotTable(registry));
  for (const toml::table* one : table.tables("shots")) {
    at(table.placeOf(*one),
       [&] { shots.append(objects::parseObject(shots.table(), jsonOf(*one))); });
  }
  return lab::shotsOf(shots.view());
}

PictureDesc pictureOf(TomlTable& owner, const Claim& claim, bool alongPath) {
  PictureDesc desc;
  desc.crop = {0, 0, claim.size};
  const toml::node* node = owner.find("picture");
  if (node == nullptr) return desc;
  if (node->as_table() == nullptr) owner.refuse(*node, "'picture' is not a table");
  TomlTable table(owner.file(), *node->as_table());
  const std::string show = table.text("show", "output");
  if (show != "output" && show != "color" && show != "change") {
    table.refuse(*node, "'show' is not output, color or change");
  }
  desc.show = show == "color"    ? PictureKind::kColor
              : show == "change" ? PictureKind::kChange
                                 : PictureKind::kOutput;
  if (desc.show == PictureKind::kChange && !alongPath)
    table.refuse(*node, "'show' is change, which needs a path of cameras");
  if (const std::vector<double> crop = table.numbers("crop", 4); !crop.empty()) {
    for (int i = 0; i < 4; ++i) {
      const double value = crop[static_cast<size_t>(i)];
      const double room = i < 2 ? 0 : claim.size[i - 2] - crop[static_cast<size_t>(i) - 2];
      const bool good = value == std::floor(value) && value >= (i < 2 ? 0 : 1) &&
                        (i < 2 ? value < claim.size[i] : value <= room);
      if (!good)
        table.refuse(*node, "'crop' is not a rectangle of whole pixels inside the picture");
      desc.crop[i] = static_cast<uint32_t>(value);
    }
  }
  desc.zoom = table.whole("zoom", 1, 1, 16);
  desc.low = table.number("low", 0, -1e6, 1e6);
  desc.high = table.number("high", desc.show == PictureKind::kChange ? 0.25 : 1, -1e6, 1e6);
  if (!(desc.low < desc.high)) table.refuse(*node, "'low' is not less than 'high'");
  table.finish();
  return desc;
}

// Checks a run's values and output with its effects, after the whole claim is read.
void checkRun(const TomlTable& table, const Claim& claim, const ClaimRun& run,
              const effect::Registry& registry) {
  at(table.place(),
     [&] { frame::checkOutput(claim.output, selectionOf(registry, claim, &run).effects()); });
}

ClaimRun runOf(TomlTable& table, const Claim& claim, const std::vector<scene::Camera>& cameras) {
  ClaimRun run;
  run.name = table.text("name");
  requireName(table, "name", run.name);
  run.presets = table.texts("presets");
  run.sets = table.texts("set");
  run.cameras = cameras;
  if (table.find("camera") != nullptr) {
    run.cameras = camerasOf(table, static_cast<uint32_t>(cameras.size()), !claim.seconds.empty());
  }
  run.seconds = claim.seconds;
  run.still = table.flag("still", false);
  if (run.still && cameras.size() == 1) {
    table.refuse(table.require("still"), "'still' needs a path or an animation");
  }
  if (run.still) {
    std::ranges::fill(run.cameras, scene::Camera(run.cameras.back()));
    if (!run.seconds.empty()) std::ranges::fill(run.seconds, double{run.seconds.back()});
  }
  run.against = table.text("against", "");
  run.shots = table.whole("shots", static_cast<uint32_t>(claim.shots.size()), 0, kMostShots);
  if (run.shots > 0 && claim.shots.empty()) {
    table.refuse(table.require("shots"), "the claim has no shots");
  }
  const std::string noise = table.text("noise", "world");
  if (noise != "world" && noise != "screen") {
    table.refuse(table.require("noise"), "'noise' is not world or screen");
  }
  run.screenNoise = noise == "screen";
  if (run.screenNoise && claim.output != "sspm.paint") {
    table.refuse(table.require("noise"), "'noise' is screen, which needs the output sspm.paint");
  }
  table.finish();
  return run;
}

void addRuns(TomlTable& owner, Claim& claim, const std::vector<scene::Camera>& cameras,
             const effect::Registry& registry) {
  for (const toml::table* one : owner.tables("runs")) {
    TomlTable table(owner.file(), *one);
    ClaimRun run = runOf(table, claim, cameras);
    if (std::ranges::find(claim.runs, run.name, &ClaimRun::name) != claim.runs.end()) {
      table.refuse(*one, fmt::format("there are two runs '{}'", run.name));
    }
    checkRun(table, claim, run, registry);
    claim.runs.push_back(std::move(run));
  }
  for (const ClaimRun& run : claim.runs) {
    if (run.against.empty()) continue;
    const auto right = std::ranges::find(claim.runs, run.against, &ClaimRun::name);
    if (right == claim.runs.end()) {
      owner.refuse(
          owner.require("runs"),
          fmt::format("run '{}' is against '{}', but no run has that name", run.name, run.against));
    }
  }
}

void addExpectations(TomlTable& table, Claim& claim, bool alongPath) {
  const toml::node& node = table.require("expect");
  const toml::array* array = node.as_array();
  const std::vector<std::string> texts = table.texts("expect");
  if (texts.empty()) table.refuse(node, "'expect' is empty");
  for (size_t i = 0; i < texts.size(); ++i) {
    const toml::node& line = *array->get(i);
    const Expectation expectation =
        at(table.placeOf(line), [&] { return parseExpectation(texts[i]); });
    for (const Term* term :
         {&expectation.left, expectation.right ? &*expectation.right : nullptr}) {
      if (term == nullptr) continue;
      if (std::ranges::find(claim.runs, term->run, &ClaimRun::name) == claim.runs.end()) {
        table.refuse(line, fmt::format("this claim has no run '{}'", term->run));
      }
      if (findMetric(term->metric)->over != Over::kFirst && !alongPath) {
        table.refuse(line,
                     fmt::format("'{}' needs a path of cameras or an animation", term->metric));
      }
      if (claim.shots.empty() &&
          (term->metric == "mask_outside" || term->region.find("painted") != std::string::npos)) {
        table.refuse(line, fmt::format("'{}' needs shots", term->quantity()));
      }
    }
    claim.expectations.push_back(expectation);
  }
}

Claim claimOf(TomlTable& table, const effect::Registry& registry, const std::string& scenes) {
  Claim claim;
  claim.place = table.place();
  claim.key = table.text("key");
  requireName(table, "key", claim.key);
  claim.text = table.text("text");
  claim.source = table.text("source");
  claim.note = table.text("note", "");
  const std::string scene = table.text("scene", "");
  claim.scene = app::study::sceneFile(table.file(), scene, scenes);
  // A built-in scene is never missing.
  claim.optional = table.flag("optional", false) && scene::findBuiltIn(claim.scene) == nullptr;
  claim.floor = table.flag("floor", false);
  if (const std::vector<double> size = table.numbers("size", 2); !size.empty()) {
    for (int i = 0; i < 2; ++i) {
      const double side = size[static_cast<size_t>(i)];
      if (!(side >= 16 && side <= kLargestSide) || side != std::floor(side)) {
        table.refuse(table.require("size"),
                     fmt::format("'size' is not two whole numbers from 16 to {}", kLargestSide));
      }
      claim.size[i] = static_cast<uint32_t>(side);
    }
  }
  claim.radius = table.number("radius", claim.radius, 1e-6, 1e6);
  claim.distance = table.number("distance", claim.distance, 0, 1e9);
  claim.effects = table.texts("effects");
  if (claim.effects.empty()) claim.effects = {"ssao"};
  claim.output = table.text("output", "ssao.ao");
  claim.sets = table.texts("set");
  claim.shots = shotsOf(table, registry);
  const uint32_t frames = table.whole("frames", 1, 1, scene::kMostPathFrames);
  claim.seconds = secondsOf(table, frames);
  claim.animation = table.whole("animation", 0, 0, 65535);
  if (claim.seconds.empty() && table.find("animation") != nullptr) {
    table.refuse(table.require("animation"), "'animation' needs 'seconds'");
  }
  const std::vector<scene::Camera> cameras = camerasOf(table, frames, !claim.seconds.empty());
  at(table.place(), [&] { app::study::checkPathSize(claim.key, frames, claim.size); });
  addRuns(table, claim, cameras, registry);
  addExpectations(table, claim, frames > 1);
  claim.picture = pictureOf(table, claim, frames > 1);
  table.finish();
  return claim;
}

}  // namespace

effect::Selection selectionOf(const effect::Registry& registry, const Claim& claim,
                              const ClaimRun* run) {
  effect::Selection selection(registry, claim.effects);
  for (const std::string& set : claim.sets) selection.set(effect::parseAssignment(set));
  if (run == nullptr) return selection;
  app::applyPresets(run->presets, selection);
  for (const std::string& set : run->sets) selection.set(effect::parseAssignment(set));
  return selection;
}

ClaimsFile loadClaims(const std::string& path, const effect::Registry& registry,
                      const std::string& scenes) {
  const toml::table document = app::parseTomlFile(path);
  TomlTable table(path, document);
  ClaimsFile file{.title = table.text("title", "Claims"), .claims = {}};
  for (const toml::table* one : table.tables("claim")) {
    TomlTable claim(path, *one);
    file.claims.push_back(claimOf(claim, registry, scenes));
    const std::string& key = file.claims.back().key;
    if (std::ranges::count(file.claims, key, &Claim::key) > 1) {
      claim.refuse(*one, fmt::format("there are two claims '{}'", key));
    }
  }
  table.finish();
  return file;
}

Claim scaled(const Claim& claim, double scale) {
  const auto side = [scale](uint32_t pixels, double least) {
    return static_cast<uint32_t>(std::max(std::round(scale * pixels), least));
  };
  Claim result = claim;
  result.size = {side(claim.size.x, 16), side(claim.size.y, 16)};
  glm::uvec4& crop = result.picture.crop;
  for (int i = 0; i < 2; ++i) {
    crop[i] = std::min(side(crop[i], 0), result.size[i] - 1);
    crop[i + 2] = std::min(side(crop[i + 2], 1), result.size[i] - crop[i]);
  }
  return result;
}

}  // namespace grisaille::lab::claims
