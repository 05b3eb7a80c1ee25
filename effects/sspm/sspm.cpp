// SPDX-License-Identifier: MIT
// Screen-space paint mapping: paint shot into a scene, without touching its geometry or its texture
// coordinates. The shaders say how, README.md says why.
#include <cmath>
#include <glm/glm.hpp>
#include <limits>

#include "grisaille/effect.hpp"
#include "paint_world.h"
#include "parameters.h"
#include "shaders/sspm_per_shot.h"
#include "shaders/sspm_per_shot_first.h"
#include "shaders/sspm_splat.h"
#include "shaders/sspm_surface.h"

namespace grisaille::sspm {
namespace {

constexpr uint32_t kGroup = 8;  // threads a side, in all shaders of this effect
constexpr int kOctaves = 3;

// shaders/sspm/splat.glsl, std140.
struct SplatBlock {
  glm::ivec4 noise_cell[kOctaves];
  glm::vec4 noise_fraction[kOctaves];
  float half_width;
  float pixel_slope;
};
GRISAILLE_CHECK_BLOCK_sspm_splat_Splat(SplatBlock);

// shaders/sspm/per_shot.comp, std140.
struct ShotBlock {
  glm::vec3 origin;
  float range;
  glm::vec3 direction;
  float full;
  glm::vec3 color;
  float edge_fade;
  float number;
};
GRISAILLE_CHECK_BLOCK_sspm_per_shot_Shot(ShotBlock);

// shaders/sspm/surface.comp, std140.
struct ListsBlock {
  glm::ivec4 level_cell[kMostLevels];
  glm::vec4 level_fraction[kMostLevels];
  glm::ivec4 camera_cell;
  glm::vec4 camera_fraction;
  uint32_t slot_mask;
  float edge_fade;
};
GRISAILLE_CHECK_BLOCK_sspm_surface_Lists(ListsBlock);

glm::dvec3 eyeOf(const plugin::Frame& frame) {
  const double* p = frame.view().position;
  return {p[0], p[1], p[2]};
}

// A cell's number modulo 2^32; shaders count on from there and wrap round alike.
int32_t wrapped(double cell) {
  return static_cast<int32_t>(
      static_cast<uint32_t>(std::fmod(cell, 4294967296.0) + (cell < 0 ? 4294967296.0 : 0.0)));
}

SplatBlock splatBlock(const plugin::Frame& frame) {
  SplatBlock block{};
  const glm::dvec3 eye = eyeOf(frame);
  const uint32_t seed = frame.value<uint32_t>(kNoiseSeed);
  for (int octave = 0; octave < kOctaves; ++octave) {
    const double cells = std::exp2(octave) / frame.value<double>(kSplatScale);
    const glm::dvec3 place = eye * cells;
    const glm::dvec3 whole = glm::floor(place);
    const uint32_t octaveSeed = (seed * 3u + static_cast<uint32_t>(octave)) * 0x27d4eb2fu;
    block.noise_cell[octave] = glm::ivec4(wrapped(whole.x), wrapped(whole.y), wrapped(whole.z),
                                          static_cast<int32_t>(octaveSeed));
    block.noise_fraction[octave] = glm::vec4(glm::dvec4(place - whole, cells));
  }
  block.half_width = 0.5f * (1 - frame.value<float>(kSplatSharpness));
  block.pixel_slope = static_cast<float>(frame.view().pixel_slope);
  return block;
}

class Sspm {
 public:
  explicit Sspm(plugin::Host host)
      : host_(host),
        firstShot_(host, "first shot", grisaille_shader_sspm_per_shot_first),
        perShot_(host, "shot", grisaille_shader_sspm_per_shot),
        splat_(host, "splat", grisaille_shader_sspm_splat),
        surface_(host, "surface", grisaille_shader_sspm_surface),
        nearest_(host.sampler({.label = "nearest"})) {}

  static uint32_t reads(plugin::Values values) noexcept {
    const bool surface = values.get<Mode>(Parameter::kMode) == Mode::kSurface;
    return GRISAILLE_READS(GRISAILLE_VIEW_DEPTH) |
           (surface ? GRISAILLE_READS(GRISAILLE_FACET_NORMAL) : 0u);
  }

  void record(const plugin::Frame& frame) {
    if (frame.value<Mode>(kMode) == Mode::kSurface) {
      recordSurface(frame);
    } else {
      recordPerShot(frame);
    }
  }

 private:
  void recordPerShot(const plugin::Frame& frame) {
    // Placed shots are kept for the mode's return, as far as the list stays.
    kept_ = std::min(kept_, frame.shotsKept());
    const std::span<const grisaille_shot> all = frame.shots();
    const size_t count = std::min(all.size(), frame.value<size_t>(kShotLimit));
    const auto scratch = [&](const char* label, grisaille_format format, bool full) {
      return frame.transient({.label = label,
                              .format = format,
                              .width = full ? frame.width() : 1,
                              .height = full ? frame.height() : 1});
    };
    const bool owned = frame.wanted(Output::kOwner);
    const grisaille_texture paint = scratch("paint", GRISAILLE_FORMAT_RGBA32F, true);
    const grisaille_texture owners = scratch("owners", GRISAILLE_FORMAT_RG32F, owned);
    const grisaille_texture depth = frame.attachment(GRISAILLE_VIEW_DEPTH);
    // Without shots one that reaches nothing leaves the targets empty.
    const grisaille_shot none{
        .origin = {}, .direction = {}, .color = {}, .range = -1, .reserved = 0};
    for (size_t i = 0; i < std::max<size_t>(count, 1); ++i) {
      const size_t number = all.size() - count + i;
      const ShotBlock block = shotBlock(frame, count > 0 ? all[number] : none, number);
      const grisaille_pipeline pipeline =
          (i == 0 ? firstShot_ : perShot_).get({plugin::specialize(0, owned)});
      const grisaille_binding bindings[] = {
          plugin::uniform(0, frame.viewBlock()), plugin::uniform(1, frame.uniform(block)),
          plugin::texture(0, depth, nearest_), plugin::image(0, paint), plugin::image(1, owners)};
      frame.pass("shot", [&] { cover(frame, pipeline, bindings); });
    }
    const grisaille_pipeline pipeline =
        splat_.get({plugin::specialize(0, wanted(frame)), plugin::specialize(1, owned)});
    std::vector<grisaille_binding> bindings = {
        plugin::uniform(0, frame.viewBlock()), plugin::uniform(1, frame.uniform(splatBlock(frame))),
        plugin::texture(0, depth, nearest_), plugin::texture(1, paint, nearest_),
        plugin::texture(2, owned ? owners : paint, nearest_)};
    frame.pass("splat", [&] {
      addOutputs(frame, bindings);
      cover(frame, pipeline, bindings);
    });
  }

  static ShotBlock shotBlock(const plugin::Frame& frame, const grisaille_shot& shot,
                             size_t number) {
    const glm::dvec3 origin(shot.origin[0], shot.origin[1], shot.origin[2]);
    return {.origin = glm::vec3(origin - eyeOf(frame)),
            .range = shot.range != 0 ? shot.range : frame.value<float>(kPaintRange),
            .direction = {shot.direction[0], shot.direction[1], shot.direction[2]},
            .full = frame.value<float>(kFull),
            .color = {shot.color[0], shot.color[1], shot.color[2]},
            .edge_fade = frame.value<float>(kEdgeFade),
            .number = static_cast<float>(number + 1)};
  }

  void recordSurface(const plugin::Frame& frame) {
    const PaintRules rules = {.range = frame.value<float>(kPaintRange),
                              .full = frame.value<float>(kFull),
                              .fade = frame.value<float>(kEdgeFade)};
    const CastRays cast = [this](std::span<const grisaille_ray> rays,
                                 std::span<grisaille_hit> hits) {
      return host_.castRays(rays, hits);
    };
    kept_ = std::min(kept_, frame.shotsKept());
    const std::span<const grisaille_shot> shots = frame.shots();
    const size_t waiting = world_.update(shots, kept_, rules, frame.patience(), cast);
    kept_ = shots.size();
    frame.waiting(waiting);
    for (Mirror* mirror :
         {&world_.cells().slots(), &world_.cells().words(), &world_.records(), &world_.blocks()}) {
      mirror->upload(host_, frame);
    }
    const grisaille_pipeline pipeline = surface_.get(
        {plugin::specialize(0, wanted(frame)), plugin::specialize(1, world_.levels().size() == 1)});
    std::vector<grisaille_binding> bindings = {
        plugin::uniform(0, frame.viewBlock()),
        plugin::uniform(1, frame.uniform(splatBlock(frame))),
        plugin::uniform(2, frame.uniform(listsBlock(frame))),
        plugin::storage(0, plugin::whole(world_.cells().slots().buffer())),
        plugin::storage(1, plugin::whole(world_.cells().words().buffer())),
        plugin::storage(2, plugin::whole(world_.records().buffer())),
        plugin::storage(3, plugin::whole(world_.blocks().buffer())),
        plugin::texture(0, frame.attachment(GRISAILLE_VIEW_DEPTH), nearest_),
        plugin::texture(1, frame.attachment(GRISAILLE_FACET_NORMAL), nearest_)};
    addOutputs(frame, bindings);
    frame.pass("surface", [&] { cover(frame, pipeline, bindings); });
  }

  ListsBlock listsBlock(const plugin::Frame& frame) {
    ListsBlock block{};
    const glm::dvec3 eye = eyeOf(frame);
    const std::span<const int32_t> levels = world_.levels();
    for (size_t i = 0; i < levels.size(); ++i) {
      const double edge = std::ldexp(1.0, exponentOf(levels[i]));
      const glm::dvec3 place = eye / edge;
      const glm::dvec3 whole = glm::floor(place);
      block.level_cell[i] =
          glm::ivec4(wrapped(whole.x), wrapped(whole.y), wrapped(whole.z), levels[i]);
      block.level_fraction[i] = glm::vec4(glm::dvec4(place - whole, 1.0 / edge));
    }
    const glm::dvec3 metres = glm::floor(eye);
    block.camera_cell = glm::ivec4(glm::ivec3(metres), static_cast<int32_t>(levels.size()));
    block.camera_fraction = glm::vec4(glm::dvec4(eye - metres, frame.value<double>(kFull)));
    block.slot_mask = world_.cells().slotMask();
    block.edge_fade = frame.value<float>(kEdgeFade);
    return block;
  }

  static uint32_t wanted(const plugin::Frame& frame) {
    return (frame.wanted(Output::kPaint) ? 1u : 0u) | (frame.wanted(Output::kCoverage) ? 2u : 0u) |
           (frame.wanted(Output::kOwner) ? 4u : 0u);
  }

  // Images 0 ... 2; where nobody wants one, a texel that is left alone.
  static void addOutputs(const plugin::Frame& frame, std::vector<grisaille_binding>& bindings) {
    for (const Output output : {Output::kPaint, Output::kCoverage, Output::kOwner}) {
      const auto format = static_cast<grisaille_format>(kOutputs[output].format);
      bindings.push_back(plugin::image(
          output,
          frame.wanted(output)
              ? frame.output(output)
              : frame.transient({.label = "unwanted", .format = format, .width = 1, .height = 1})));
    }
  }

  static void cover(const plugin::Frame& frame, grisaille_pipeline pipeline,
                    std::span<const grisaille_binding> bindings) {
    frame.dispatch(pipeline, bindings, plugin::groupsFor(frame.width(), kGroup),
                   plugin::groupsFor(frame.height(), kGroup));
  }

  plugin::Host host_;
  plugin::PipelineCache firstShot_, perShot_, splat_, surface_;
  plugin::Sampler nearest_;
  PaintWorld world_;
  size_t kept_ = 0;  // shots of the list that world_ knows and that stayed the same since
};

constexpr auto kSspm =
    plugin::effect<Sspm>({.key = "sspm",
                          .label = "Paint",
                          .version = "1.0.0",
                          .tooltip = "Paint shot onto whatever the picture shows",
                          .params = kParams,
                          .outputs = kOutputs,
                          .takesShots = true});

}  // namespace
}  // namespace grisaille::sspm

GRISAILLE_EXPORT_PLUGIN(&grisaille::sspm::kSspm);
