// SPDX-License-Identifier: MIT
#include "lab/stability/combinations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/base/error.h"

namespace grisaille::lab::stability {
namespace {

using Kind = Scenery::Kind;

struct Variant {
  const char* name;
  const char* effect;
  const char* output;
  Settings settings;
};

const std::vector<Variant>& variants() {
  static const std::vector<Variant> kVariants = {
      {"slices", "ssao", "ao", {}},
      {"slices, raw", "ssao", "ao", {{"resolution", "full"}, {"blur_size", "0"}}},
      {"slices, quarter",
       "ssao",
       "ao",
       {{"resolution", "quarter"}, {"edge_slices", "2"}, {"refine", "nothing"}}},
      {"slices, refined", "ssao", "ao", {{"resolution", "quarter"}, {"refine", "contrasts"}}},
      {"slices, exact",
       "ssao",
       "ao",
       {{"resolution", "full"},
        {"slices", "32"},
        {"kernel_size", "4096"},
        {"blur_size", "0"},
        {"backs", "assumed"},
        {"thickness", "10"},
        {"guard_band", "0.2"}}},
      {"slices, backs",
       "ssao",
       "ao",
       {{"resolution", "full"}, {"blur_size", "0"}, {"backs", "drawn"}}},
      {"slices, next",
       "ssao",
       "ao",
       {{"resolution", "full"}, {"blur_size", "0"}, {"backs", "peeled"}, {"thickness", "1"}}},
      {"slices, assumed", "ssao", "ao", {{"backs", "assumed"}, {"thickness", "0.7"}}},
      {"history", "ssao", "ao", {{"history", "4"}}},
      {"open directions", "ssao", "bent_normal", {}},
      {"tint", "ssao", "tint", {{"bounce", "base_colour"}}},
      {"classic",
       "ssao",
       "ao",
       {{"estimator", "classic"}, {"kernel_size", "64"}, {"blur_size", "4"}}},
      {"classic, raw",
       "ssao",
       "ao",
       {{"estimator", "classic"}, {"kernel_size", "64"}, {"blur_size", "0"}}},
      {"sphere",
       "ssao",
       "ao",
       {{"estimator", "classic"},
        {"kernel_size", "64"},
        {"blur_size", "4"},
        {"sampling", "sphere"}}},
      {"edge-aware",
       "ssao",
       "ao",
       {{"estimator", "classic"},
        {"kernel_size", "64"},
        {"blur_size", "4"},
        {"blur", "edge_aware"}}},
      {"paint", "sspm", "paint", {{"mode", "per_shot"}}},
      {"paint on surfaces", "sspm", "paint", {{"mode", "surface"}}},
  };
  return kVariants;
}

std::string lengthText(double metres) {
  return fmt::format("{}", std::clamp(metres, 1e-6, 1e6));
}

// Random numbers that are the same on every machine.
class Draws {
 public:
  explicit Draws(uint32_t seed) : random_(seed) {}
  double unit() { return static_cast<double>(random_()) * 0x1p-32; }
  double decades(double low, double high) { return std::pow(10.0, low + (high - low) * unit()); }
  uint32_t below(uint32_t count) { return static_cast<uint32_t>(unit() * count); }
  template <typename T>
  T of(std::initializer_list<T> values) {
    return values.begin()[below(static_cast<uint32_t>(values.size()))];
  }

 private:
  std::mt19937 random_;
};

void drawOcclusion(Draws& draw, Case& one) {
  const auto set = [&](const char* key, std::string value) {
    one.settings.emplace_back(key, std::move(value));
  };
  const double scale = one.scenery.scale;
  set("estimator", draw.of({"slices", "classic"}));
  set("radius", lengthText(scale * draw.decades(-3, 2)));
  set("slices", std::to_string(1 + draw.below(4)));
  set("thickness", fmt::format("{}", draw.decades(-2, 1)));
  set("resolution", draw.of({"full", "half", "quarter"}));
  set("refine", draw.of({"nothing", "edges", "contrasts"}));
  set("blur_size", std::to_string(draw.of({0, 2, 4, 7, 8, 10, 20})));
  set("intensity", fmt::format("{}", 2 * draw.unit()));
  set("power", fmt::format("{}", 0.5 + draw.unit()));
  set("bounce", draw.of({"none", "none", "albedo"}));
  set("seed", std::to_string(draw.below(65536)));
  set("kernel_size", std::to_string(2 + draw.below(300)));
  set("bias", fmt::format("{}", std::min(scale * draw.decades(-4, 0), 1e6)));
  set("sampling", draw.of({"hemisphere", "hemisphere", "sphere"}));
  set("rotation", draw.of({"noise", "noise", "none"}));
  set("range_check", draw.of({"linear", "linear", "raw_depth", "none"}));
  set("blur", draw.of({"box", "edge_aware"}));
  set("edge_slices", std::to_string(1 + draw.below(4)));
  set("backs", draw.of({"assumed", "bodies", "drawn", "peeled"}));
  set("edge_denoise", std::to_string(draw.of({0, 1, 6, 6, 9, 32})));
  set("contrast", fmt::format("{}", draw.decades(-2, 0)));
}

void drawPaint(Draws& draw, Case& one, uint32_t seed) {
  const auto set = [&](const char* key, std::string value) {
    one.settings.emplace_back(key, std::move(value));
  };
  const double scale = one.scenery.scale;
  const bool surface = one.scenery.kind == Kind::kCorner && draw.below(2) == 0;
  one.variant = surface ? "paint on surfaces" : "paint";
  set("mode", surface ? "surface" : "per_shot");
  set("paint_range", lengthText(scale * draw.decades(-1.5, 1)));
  set("r0", lengthText(scale * draw.decades(-2, 1)));
  set("edge_fade", fmt::format("{}", draw.unit()));
  set("splat_scale", lengthText(scale * draw.decades(-2, 0)));
  set("splat_sharpness", fmt::format("{}", 0.9 * draw.unit()));
  set("noise_seed", std::to_string(draw.below(65536)));
  one.shots = makeShots(one.scenery, 1 + draw.below(24), seed);
}

Scenery drawScenery(Draws& draw) {
  const double scale = draw.of({1e-3, 0.1, 1.0, 1.0, 1.0, 30.0, 1e4});
  // Small scenes stay closer to the origin, so that doubles resolve them.
  const double away = std::min(scale, 1.0) * draw.of({0.0, 0.0, 1e3, 1e6, 1e7});
  return {.kind = draw.of({Kind::kRoom, Kind::kRoom, Kind::kCorner, Kind::kWires}),
          .scale = scale,
          .origin = away * glm::dvec3(0.3, 1, -0.8)};
}

Case randomCase(uint32_t seed) {
  Draws draw(seed);
  const Scenery scenery = drawScenery(draw);
  Case one = usualCase(draw.below(3) < 2 ? "slices" : "paint", scenery);
  one.group = "at random";
  one.every = true;
  one.name = fmt::format("seed {}, {}, scale {}", seed, nameOf(scenery.kind), scenery.scale);
  one.size = {1 + draw.below(120), 1 + draw.below(90)};
  one.camera.eye =
      scenery.placed({3 * draw.unit() - 1.5, 0.2 + 2 * draw.unit(), 1.2 + 2 * draw.unit()});
  one.camera.target = scenery.placed({draw.unit() - 0.5, draw.unit(), 0.8 * draw.unit()});
  one.camera.fovyDegrees = draw.of({5.0, 30.0, 60.0, 60.0, 100.0, 150.0});
  one.camera.nearPlane = scenery.scale * draw.decades(-4, -1);
  one.settings.clear();
  if (one.effect == "ssao") {
    drawOcclusion(draw, one);
    one.variant = one.settings.front().second;
  } else {
    drawPaint(draw, one, seed);
  }
  return one;
}

}  // namespace

Case usualCase(const std::string& variant, const Scenery& scenery) {
  const auto found = std::ranges::find(variants(), variant, &Variant::name);
  if (found == variants().end()) {
    throw Error(ErrorId::kUnexpected, "the sweep has no variant '{}'", variant);
  }
  const double scale = scenery.scale;
  Case one;
  one.variant = variant;
  one.scenery = scenery;
  one.effect = found->effect;
  one.output = found->output;
  one.settings = found->settings;
  one.camera = {.eye = scenery.placed({0.5, 1.1, 2.6}),
                .target = scenery.placed({0, 0.45, 0.2}),
                .nearPlane = std::min(0.01 * scale, 1e6)};
  if (one.effect == "ssao") {
    one.settings.emplace_back("radius", lengthText(0.5 * scale));
    one.settings.emplace_back("bias", fmt::format("{}", 0.01 * scale));
  } else {
    one.settings.emplace_back("paint_range", lengthText(0.25 * scale));
    one.settings.emplace_back("r0", lengthText(scale));
    one.settings.emplace_back("splat_scale", lengthText(0.06 * scale));
    one.shots = makeShots(scenery, 12, 3);
  }
  return one;
}

std::vector<Case> randomCases(uint32_t count, uint32_t seed) {
  std::vector<Case> all;
  for (uint32_t i = 0; i < count; ++i) {
    all.push_back(randomCase(seed + i));
    all.back().edge = edgeOf(all.back());
    all.back().quick = i < 4;
  }
  return all;
}

const std::vector<Edge>& edges() {
  static const std::vector<Edge> kEdges = {
      {"thin things before a muzzle", 0.02,
       "A shot's map has squares of 8 mm, but of at most a 32nd and at least a 128th of the range. "
       "Beside a thinner object, the border of the paint is off by up to one square."},
      {"far muzzle", 0.08,
       "In `surface` mode the shader computes positions as offsets from the muzzle, in single "
       "precision. From 10^5 m on they are centimetres off, which moves rims. `per_shot` mode "
       "computes them from the ray, and stays within the limit."},
      {"a direction between two sectors", 0.025,
       "The bent normal looks directions up in 32 sectors, each occluded or open. If an occluded "
       "sector ends at a direction, rounding decides whether that direction counts. Bent normals "
       "around it then turn by half a degree."},
      {"edges without normals", 0.005,
       "Without normals, the effect assumes that every surface faces the camera. All slopes are "
       "then close to the edge criterion, and rounding decides whether a texel is an edge."},
      {"ten times the occlusion", 0.005,
       "Rounding may decide whether one of 32 sectors is occluded, or whether a texel is an edge. "
       "An intensity of 10, the largest, multiplies the difference by ten."},
  };
  return kEdges;
}

std::string edgeOf(const Case& one) {
  if (one.variant.starts_with("slices") &&
      (one.scenery.kind == Kind::kNoNormals || one.scenery.kind == Kind::kNormless))
    return "edges without normals";
  if (one.variant.starts_with("slices") && one.group == "intensity")
    return "ten times the occlusion";
  if (one.variant == "open directions" &&
      (one.scenery.kind == Kind::kNoNormals || one.scenery.kind == Kind::kBackNormals))
    return "a direction between two sectors";
  if (one.variant != "paint on surfaces") return "";
  if (one.scenery.kind == Kind::kWires) return "thin things before a muzzle";
  const bool far = std::ranges::any_of(one.shots, [&](const Shot& shot) {
    const glm::dvec3 origin(shot.origin[0], shot.origin[1], shot.origin[2]);
    return glm::distance(origin, one.camera.eye) > 5e4 * one.scenery.scale;
  });
  return far ? "far muzzle" : "";
}

}  // namespace grisaille::lab::stability
