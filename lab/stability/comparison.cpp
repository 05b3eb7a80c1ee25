// SPDX-License-Identifier: MIT
#include "lab/stability/comparison.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <optional>

#include "core/trace/ray_tracer.h"
#include "lab/oracle/occlusion.h"
#include "lab/oracle/paint.h"

namespace grisaille::lab::stability {
namespace {

// A value rounded to single precision: the effect's host code passes it to the shader as a float.
double single(const effect::Values& values, const char* key) {
  return static_cast<float>(values.get(key));
}

int whole(const effect::Values& values, const char* key) {
  return static_cast<int>(values.get(key));
}

oracle::OcclusionSettings occlusionOf(const effect::Values& values) {
  return {.classic = values.text("estimator") == "classic",
          .radius = single(values, "radius"),
          .kernelSize = whole(values, "kernel_size"),
          .blurSize = whole(values, "blur_size"),
          .bias = single(values, "bias"),
          .slices = whole(values, "slices"),
          .edgeSlices = whole(values, "edge_slices"),
          .thickness = single(values, "thickness"),
          .backs = static_cast<oracle::OcclusionSettings::Backs>(whole(values, "backs")),
          .history = whole(values, "history"),
          .scale = 1 << whole(values, "resolution"),
          .refine = static_cast<oracle::OcclusionSettings::Refine>(whole(values, "refine")),
          .contrast = single(values, "contrast"),
          .edgeDenoise = whole(values, "edge_denoise"),
          .intensity = single(values, "intensity"),
          .power = single(values, "power"),
          .albedo = values.text("bounce") == "albedo" ? single(values, "albedo") : 0,
          .baseColour = values.text("bounce") == "base_colour",
          .seed = static_cast<uint32_t>(values.get("seed")),
          .sphere = values.text("sampling") == "sphere",
          .rotated = values.text("rotation") == "noise",
          .edgeAware = values.text("blur") == "edge_aware",
          .range = static_cast<oracle::OcclusionSettings::Range>(whole(values, "range_check"))};
}

oracle::PaintSettings paintSettingsOf(const effect::Values& values) {
  return {.paintRange = single(values, "paint_range"),
          .full = single(values, "r0"),
          .shotLimit = static_cast<size_t>(values.get("shot_limit")),
          .edgeFade = single(values, "edge_fade"),
          .splatScale = values.get("splat_scale"),
          .splatSharpness = single(values, "splat_sharpness"),
          .noiseSeed = static_cast<uint32_t>(values.get("noise_seed"))};
}

float difference(double a, double b) {
  return std::isfinite(a) ? static_cast<float>(std::abs(a - b)) : 1;
}

// A picture of the same size and channels, filled with NaN.
image::Image likeOf(const image::Image& picture) {
  image::Image like = picture;
  std::ranges::fill(like.pixels, std::numeric_limits<float>::quiet_NaN());
  return like;
}

// The largest difference of a pixel's first `channels` from `value`. Stores `value` in `expected`,
// and the picture's own value in the channels that no oracle knows.
float compareAt(const image::Image& picture, const glm::ivec2& pixel, const glm::dvec4& value,
                uint32_t channels, image::Image& expected) {
  const glm::uvec2 at(pixel);
  float worst = 0;
  for (uint32_t c = 0; c < picture.channels; ++c) {
    const float own = picture.at(at.x, at.y, c);
    const double one = c < channels ? value[static_cast<int>(c)] : own;
    worst = c < channels ? std::max(worst, difference(own, one)) : worst;
    expected.pixels[(size_t{at.y} * picture.width + at.x) * picture.channels + c] =
        static_cast<float>(one);
  }
  return worst;
}

glm::dvec3 placeOf(const Case& one, const oracle::View& view, const glm::ivec2& pixel) {
  return view.eye() + scene::worldFromView(one.camera) * view.position(pixel);
}

// The rms error over the middle half of the picture, where no sphere extends beyond the picture.
double cornerErrorOf(const Case& one, const oracle::View& view, const image::Image& ao,
                     double radius) {
  double sum = 0, count = 0;
  const glm::ivec2 size = view.size();
  for (int y = size.y / 4; y < size.y * 3 / 4; ++y) {
    for (int x = size.x / 4; x < size.x * 3 / 4; ++x) {
      const glm::dvec3 place = placeOf(one, view, {x, y}) - one.scenery.origin;
      const double away = std::max(place.y, place.z) / radius;  // the other coordinate is 0
      const double error =
          ao.at(static_cast<uint32_t>(x), static_cast<uint32_t>(y)) - cornerVisibility(away);
      sum += error * error;
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

// Casts rays to find whether a shot's muzzle sees a place. The rays end before the place's own
// surface.
class Sights {
 public:
  explicit Sights(const scene::Scene& scene)
      : tracer_(scene, (scene.bounds.min + scene.bounds.max) / 2.0) {}

  bool sees(const Shot& shot, const glm::dvec3& place) const {
    const glm::dvec3 origin(shot.origin[0], shot.origin[1], shot.origin[2]);
    const glm::dvec3 way = place - origin;
    const double distance = glm::length(way);
    const glm::vec3 direction(way / distance);
    grisaille_ray ray{};
    for (int i = 0; i < 3; ++i) {
      ray.origin[i] = origin[i];
      ray.direction[i] = direction[i];
    }
    ray.reach = static_cast<float>(distance * (1 - 1e-3));
    grisaille_hit hit{};
    tracer_.castRays({&ray, 1}, {&hit, 1});
    return hit.kind != GRISAILLE_HIT_SURFACE;
  }

 private:
  trace::RayTracer tracer_;
};

// Sceneries where one surface may hide another from a muzzle.
bool hides(Scenery::Kind kind) {
  return kind == Scenery::Kind::kRoom || kind == Scenery::Kind::kWires;
}

}  // namespace

double cornerVisibility(double radii) {
  if (radii >= 1) return 1;
  const double t = std::max(radii, 0.0);
  return 1 - (std::acos(t) - t * std::sqrt(1 - t * t)) / glm::pi<double>();
}

std::vector<float> differences(const image::Image& a, const image::Image& b) {
  std::vector<float> all(size_t{a.width} * a.height);
  for (size_t i = 0; i < all.size(); ++i) {
    for (size_t c = 0; c < a.channels; ++c) {
      const float x = a.pixels[i * a.channels + c], y = b.pixels[i * a.channels + c];
      all[i] = std::max(all[i], std::isfinite(x) && std::isfinite(y) ? std::abs(x - y) : 1.0f);
    }
  }
  return all;
}

std::vector<glm::ivec2> pixelsToCompare(const glm::ivec2& size) {
  constexpr int kAll = 100000, kTiles = 8, kTile = 32;
  std::vector<glm::ivec2> pixels;
  const bool all = size.x * size.y <= kAll;
  for (int y = 0; y < size.y; ++y) {
    // Tiles at regular distances, and one at the far edge.
    const int row = y % std::max(size.y / kTiles, 1);
    if (!all && row >= kTile && y < size.y - kTile) continue;
    for (int x = 0; x < size.x; ++x) {
      const int column = x % std::max(size.x / kTiles, 1);
      if (all || column < kTile || x >= size.x - kTile) pixels.emplace_back(x, y);
    }
  }
  return pixels;
}

image::Image compareOcclusion(const Case& one, const effect::Values& values,
                              std::span<const oracle::View> views, const image::Image& picture,
                              BackendResult& result) {
  oracle::OcclusionSettings settings = occlusionOf(values);
  using Backs = oracle::OcclusionSettings::Backs;
  // As the effect does without a thickness.
  if (settings.backs == Backs::kBodies && one.scenery.isPicture()) settings.backs = Backs::kAssumed;
  std::shared_ptr<const oracle::Past> past;
  for (const oracle::View& view : views.first(views.size() - 1)) {
    past = oracle::makeOcclusion(view, settings, past)->past();
  }
  const oracle::View& view = views.back();
  const auto oracle = oracle::makeOcclusion(view, settings, past);
  const auto valueAt = [&](const glm::ivec2& pixel) {
    if (one.output == "bent_normal") return oracle->bentNormal(pixel);
    if (one.output == "tint") return oracle::tintOf(*oracle, view, settings, pixel);
    return glm::dvec3(oracle->visibility(pixel));
  };
  const uint32_t channels = std::min(picture.channels, 3u);
  image::Image expected = likeOf(picture);
  std::vector<float> differences;
  for (const glm::ivec2& pixel : pixelsToCompare(view.size())) {
    const glm::dvec4 value(valueAt(pixel), 0);
    differences.push_back(compareAt(picture, pixel, value, channels, expected));
  }
  result.oracle = apartOf(std::move(differences));
  if (one.open) result.leastOpen = *std::ranges::min_element(picture.pixels);
  if (one.corner) result.cornerError = cornerErrorOf(one, view, picture, settings.radius);
  return expected;
}

image::Image comparePaint(const Case& one, const effect::Values& values, const oracle::View& view,
                          const scene::Scene& scene, const image::Image& paint,
                          const image::Image& coverage, BackendResult& result) {
  const oracle::PaintSettings settings = paintSettingsOf(values);
  const bool surface = values.text("mode") == "surface";
  std::optional<Sights> sights;
  if (surface && hides(one.scenery.kind)) sights.emplace(scene);
  const glm::dmat3 worldFromView = scene::worldFromView(one.camera);
  const std::span<const Shot> shots = one.shots;
  image::Image expected = likeOf(paint);
  const std::vector<oracle::PaintLayer> layers = layersOf(shots, settings, !surface);
  std::vector<float> differences;
  for (const glm::ivec2& pixel : pixelsToCompare(view.size())) {
    const glm::dvec3 place = placeOf(one, view, pixel);
    std::optional<oracle::Sight> sight;
    if (surface) {
      sight = oracle::Sight{.facet = worldFromView * view.normal(pixel)};
      if (sights) sight->sees = [&](const auto& shot) { return sights->sees(shot, place); };
    }
    const oracle::PaintPixel value =
        paintOf(place, view.depth(pixel), scene::pixelSize(view.camera(), view.depth(pixel)),
                layers, settings, sight);
    const glm::uvec2 at(pixel);
    differences.push_back(std::max(difference(coverage.at(at.x, at.y), value.coverage),
                                   compareAt(paint, pixel, value.paint, 4, expected)));
  }
  result.oracle = apartOf(std::move(differences));
  return expected;
}

}  // namespace grisaille::lab::stability
