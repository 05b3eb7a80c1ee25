// SPDX-License-Identifier: MIT
#include "app/options/pose_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "app/options/option_checks.h"
#include "core/base/error.h"
#include "core/base/nearest.h"
#include "core/base/quote.h"
#include "core/scene/framing.h"

namespace grisaille::app {
namespace {

// Files hold times as 32-bit numbers, so that an animation of "0.7 s" may end a little earlier.
constexpr double kRounding = 1e-6;

// The number that `text` is, whole and without a sign.
std::optional<size_t> numberIn(const std::string& text) {
  size_t number = 0;
  const char* end = text.data() + text.size();
  const auto [at, failed] = std::from_chars(text.data(), end, number);
  return failed == std::errc() && at == end ? std::optional(number) : std::nullopt;
}

}  // namespace

void PoseOptions::addTo(CLI::App& command) {
  command
      .add_option(
          "--animation", animation,
          "Animation that poses the scene; N counts from 0, see `grisaille scene`; default: "
          "0 if --time is given, else the scene at rest")
      ->type_name("NAME|N");
  command
      .add_option("--time", time,
                  "Time in the animation, from 0 to its end; default: 0 if --animation is given")
      ->type_name("SECONDS")
      ->check(zeroOrMore());
}

scene::Pose PoseOptions::poseOf(const scene::Scene& scene) const {
  if (!given()) return {};
  const scene::Pose pose{.animation = animationOf(scene, animation), .seconds = time.value_or(0)};
  requireWithin(scene, *pose.animation, pose.seconds);
  return pose;
}

const std::vector<scene::Animation>& animationsOf(const scene::Scene& scene) {
  static const std::vector<scene::Animation> kNone;
  return scene.rig ? scene.rig->animations : kNone;
}

size_t animationOf(const scene::Scene& scene, const std::string& text) {
  const std::vector<scene::Animation>& all = animationsOf(scene);
  if (all.empty())
    throw Error(ErrorId::kSceneAnimation,
                "the scene has no animations, which --animation, --time and --times need");
  if (text.empty()) return 0;
  if (const auto number = numberIn(text)) {
    if (*number < all.size()) return *number;
    throw Error(ErrorId::kSceneAnimation,
                "there is no animation {}; the scene has {}, from 0 to {}", *number, all.size(),
                all.size() - 1);
  }
  const auto found = std::ranges::find(all, text, &scene::Animation::name);
  if (found != all.end()) return static_cast<size_t>(found - all.begin());
  std::vector<std::string> names;
  for (const scene::Animation& one : all) {
    if (!one.name.empty()) names.push_back(one.name);
  }
  const std::string near = nearest(text, names);
  throw Error(ErrorId::kSceneAnimation, "there is no animation '{}'{}", oneLine(text),
              near.empty() ? "" : fmt::format(", did you mean '{}'?", oneLine(near)));
}

void requireWithin(const scene::Scene& scene, size_t animation, double seconds) {
  const double duration = animationsOf(scene)[animation].duration;
  if (seconds <= duration * (1 + kRounding)) return;
  throw Error(ErrorId::kSceneAnimation, "{:g} s is after the end of {}; give 0 to {}", seconds,
              labelOf(scene, animation), secondsText(duration));
}

std::string labelOf(const scene::Scene& scene, size_t animation) {
  const std::string& name = animationsOf(scene)[animation].name;
  return name.empty() ? fmt::format("animation {}", animation) : oneLine(name);
}

std::string secondsText(double duration) {
  return fmt::format("{:g}", std::floor(duration * (1 + kRounding) * 1000) / 1000);
}

scene::Camera defaultCamera(scene::Scene& scene, const scene::Pose& pose, double aspect) {
  if (!pose.animation || scene.camera) return scene::defaultCamera(scene, aspect);
  return scene::framingCamera(scene, *pose.animation, aspect);
}

std::vector<std::string> poseArguments(const scene::Pose& pose) {
  if (!pose.animation) return {};
  return {"--animation", fmt::format("{}", *pose.animation), "--time",
          fmt::format("{}", pose.seconds)};
}

}  // namespace grisaille::app
