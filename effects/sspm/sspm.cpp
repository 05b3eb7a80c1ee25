// SPDX-License-Identifier: MIT
// The effect sspm, screen-space paint mapping: paint on a scene, without changes to its geometry or
// its texture coordinates. README.md explains it.
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>

#include "grisaille/effect.hpp"
#include "paint_world.h"
#include "parameters.h"
#include "points.h"
#include "shaders/sspm_per_shot.h"
#include "shaders/sspm_per_shot_first.h"
#include "shaders/sspm_per_shot_last.h"
#include "shaders/sspm_rest.h"
#include "shaders/sspm_samples.h"
#include "shaders/sspm_surface.h"
#include "shaders/sspm_upsample.h"

namespace grisaille::sspm {
namespace {

constexpr uint32_t kGroup = 8;  // width and height of a group, threads; all shaders but rest.comp
// shaders/sspm/rest.comp: pixels of the picture per thread, threads per group.
constexpr uint32_t kRestShare = 32, kRestGroup = 64;
// Largest picture, in pixels, for the list of rest.comp: 64 MiB of the 128 that every device binds.
// Larger pictures use full resolution.
constexpr uint64_t kRestMost = 1u << 24;

using Bindings = std::vector<grisaille_binding>;

// shaders/sspm/splat.glsl, std140.
struct SplatBlock {
  float cells;
  float half_width;
  uint32_t octaves;
  uint32_t seed;
};
GRISAILLE_CHECK_BLOCK_sspm_surface_Splat(SplatBlock);

// shaders/sspm/per_shot.glsl, std140.
struct ShotBlock {
  glm::vec3 origin;
  float range;
  glm::vec3 direction;
  float full;
  glm::vec3 color;
  float per_fade;
  uint32_t number;
  float muzzle;
  uint32_t seed;
  float times;
};
GRISAILLE_CHECK_BLOCK_sspm_per_shot_Shot(ShotBlock);

// shaders/sspm/walk.glsl, std140.
struct ListsBlock {
  glm::ivec4 level_cell[kMostLevels];
  glm::vec4 level_fraction[kMostLevels];
  glm::ivec4 camera_cell;
  glm::vec4 camera_fraction;
  uint32_t slot_count;
  float per_fade;
};
GRISAILLE_CHECK_BLOCK_sspm_surface_Lists(ListsBlock);

// 1 / edge_fade, which shaders multiply instead of testing edge_fade: a driver may compile a shader
// again for each value of a uniform in a condition, and lavapipe does.
float perFade(const plugin::Frame& frame) {
  return 1.0f / std::max(frame.value<float>(kEdgeFade), 1e-30f);
}

glm::dvec3 eyeOf(const plugin::Frame& frame) {
  const double* p = frame.view().position;
  return {p[0], p[1], p[2]};
}

// Number of a cell modulo 2^32. Shaders add to it with the same wrap-around.
int32_t wrapped(double cell) {
  return static_cast<int32_t>(
      static_cast<uint32_t>(std::fmod(cell, 4294967296.0) + (cell < 0 ? 4294967296.0 : 0.0)));
}

// Half the width of the splat step, in strength.
float halfWidth(plugin::Values values) {
  return 0.5f * (1 - values.get<float>(kSplatSharpness));
}

SplatBlock splatBlock(const plugin::Frame& frame) {
  return {.cells = static_cast<float>(1 / frame.value<double>(kSplatScale)),
          .half_width = halfWidth(frame.values()),
          .octaves = kOctaves,
          .seed = frame.value<uint32_t>(kNoiseSeed)};
}

class Sspm {
 public:
  explicit Sspm(plugin::Host host)
      : host_(host),
        firstShot_(host, "first shot", grisaille_shader_sspm_per_shot_first),
        perShot_(host, "shot", grisaille_shader_sspm_per_shot),
        lastShot_(host, "last", grisaille_shader_sspm_per_shot_last),
        surface_(host, "surface", grisaille_shader_sspm_surface),
        samples_(host, "samples", grisaille_shader_sspm_samples),
        upsample_(host, "upsample", grisaille_shader_sspm_upsample),
        rest_(host, "rest", grisaille_shader_sspm_rest),
        nearest_(host.sampler({.label = "nearest"})),
        uploader_(host) {}

  static uint32_t reads(plugin::Values values, uint32_t) noexcept {
    const bool surface = values.get<Mode>(Parameter::kMode) == Mode::kSurface;
    return GRISAILLE_READS(GRISAILLE_VIEW_DEPTH) |
           (surface ? GRISAILLE_READS(GRISAILLE_FACET_NORMAL) : 0u);
  }

  void drawAt(const plugin::Points& points) {
    kept_ = std::min(kept_, points.objectsKept());
    const std::span<const Shot> shots = points.objects<Shot>();
    const PaintRules rules = rulesOf(points.values());
    const Splat splat = {.scale = points.value<double>(kSplatScale),
                         .halfWidth = halfWidth(points.values()),
                         .seed = points.value<uint32_t>(kNoiseSeed)};
    if (points.value<Mode>(kMode) == Mode::kPerShot) {
      const size_t count = std::min(shots.size(), points.value<size_t>(kShotLimit));
      drawPointsPerShot(shots, count, rules, splat, points.all(), points.drawn());
      return;
    }
    world_.follow(shots, kept_, rules, limitOf(points.values()));
    kept_ = shots.size();
    drawPoints(world_, shots, rules, splat, caster(), points.all(), points.drawn());
  }

  void record(const plugin::Frame& frame) {
    if (frame.value<Mode>(kMode) == Mode::kSurface) {
      recordSurface(frame);
    } else {
      recordPerShot(frame);
    }
  }

 private:
  static PaintRules rulesOf(plugin::Values values) {
    return {.range = values.get<float>(kPaintRange),
            .full = values.get<float>(kFull),
            .fade = values.get<float>(kEdgeFade)};
  }

  // Most memory for paint, bytes.
  static uint64_t limitOf(plugin::Values values) {
    return values.get<uint64_t>(kMemory) * 1'000'000;
  }

  CastRays caster() {
    return [this](std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits) {
      return host_.castRays(rays, hits);
    };
  }

  DrawDepth drawer() {
    return [this](const grisaille_depth_view& view, std::span<float> depth) {
      return host_.drawDepth(view, depth);
    };
  }

  void recordPerShot(const plugin::Frame& frame) {
    // Keeps placed shots for a return to mode `surface`, up to the first change of the list.
    kept_ = std::min(kept_, frame.objectsKept());
    const auto scratch = [&](const char* label) {
      return frame.transient({.label = label,
                              .format = GRISAILLE_FORMAT_RGBA32F,
                              .width = frame.width(),
                              .height = frame.height()});
    };
    const grisaille_texture paint = scratch("paint"), rest = scratch("strengths");
    const grisaille_texture depth = frame.attachment(GRISAILLE_VIEW_DEPTH);
    const grisaille_binding splat = plugin::uniform(1, frame.uniform(splatBlock(frame)));
    std::vector<ShotBlock> blocks = shotBlocks(frame);
    // Without shots, one with a negative range clears the targets.
    if (blocks.empty()) blocks.emplace_back().range = -1;
    for (size_t i = 0; i < blocks.size(); ++i) {
      const grisaille_pipeline pipeline =
          (i == 0 ? firstShot_ : perShot_).get({plugin::specialize(0, isCovered(frame))});
      const grisaille_binding bindings[] = {plugin::uniform(0, frame.viewBlock()),
                                            splat,
                                            plugin::uniform(2, frame.uniform(blocks[i])),
                                            plugin::texture(0, depth, nearest_),
                                            plugin::image(0, paint),
                                            plugin::image(1, rest)};
      frame.pass("shot", [&] { cover(frame, pipeline, bindings); });
    }
    const grisaille_pipeline pipeline = lastShot_.get({plugin::specialize(0, wanted(frame))});
    Bindings bindings = {plugin::uniform(0, frame.viewBlock()), plugin::texture(0, paint, nearest_),
                         plugin::texture(1, rest, nearest_)};
    frame.pass("last", [&] {
      addOutputs(frame, bindings);
      cover(frame, pipeline, bindings);
    });
  }

  // The shots to draw, newest first.
  static std::vector<ShotBlock> shotBlocks(const plugin::Frame& frame) {
    const std::span<const Shot> all = frame.objects<Shot>();
    const size_t count = std::min(all.size(), frame.value<size_t>(kShotLimit));
    std::vector<ShotBlock> blocks;
    for (const Layer& layer : layersOf(all, count)) {
      blocks.push_back(shotBlock(frame, all[layer.shot], layer.shot + 1));
      blocks.back().times = layer.times;
    }
    return blocks;
  }

  static ShotBlock shotBlock(const plugin::Frame& frame, const Shot& shot, size_t number) {
    // Double precision: single precision cannot tell where the ray of a distant muzzle passes.
    const glm::dvec3 muzzle =
        glm::dvec3(shot.origin[0], shot.origin[1], shot.origin[2]) - eyeOf(frame);
    const glm::dvec3 direction(shot.direction[0], shot.direction[1], shot.direction[2]);
    const double onwards = -glm::dot(muzzle, direction);
    return {.origin = glm::vec3(muzzle + onwards * direction),
            .range = shot.rangeOr(frame.value<float>(kPaintRange)),
            .direction = glm::vec3(direction),
            .full = frame.value<float>(kFull),
            .color = {shot.color[0], shot.color[1], shot.color[2]},
            .per_fade = perFade(frame),
            .number = static_cast<uint32_t>(number),
            .muzzle = static_cast<float>(-onwards),
            .seed = splatSeed(shot, frame.value<uint32_t>(kNoiseSeed)),
            .times = 1};
  }

  void recordSurface(const plugin::Frame& frame) {
    kept_ = std::min(kept_, frame.objectsKept());
    const std::span<const Shot> shots = frame.objects<Shot>();
    const size_t waiting = world_.update(shots, kept_, rulesOf(frame.values()), frame.patience(),
                                         limitOf(frame.values()), {caster(), drawer()});
    kept_ = shots.size();
    frame.waiting(waiting);
    frame.givenUp(world_.givenUp());
    frame.coarser(world_.coarse());
    world_.upload(frame, uploader_);
    const Bindings shared = {
        plugin::uniform(0, frame.viewBlock()),
        plugin::uniform(1, frame.uniform(splatBlock(frame))),
        plugin::uniform(2, frame.uniform(listsBlock(frame))),
        plugin::storage(2, plugin::whole(world_.records().buffer())),
        plugin::texture(0, frame.attachment(GRISAILLE_VIEW_DEPTH), nearest_),
        plugin::texture(1, frame.attachment(GRISAILLE_FACET_NORMAL), nearest_)};
    const Bindings lists = {plugin::storage(0, plugin::whole(world_.cells().slots().buffer())),
                            plugin::storage(1, plugin::whole(world_.cells().words().buffer())),
                            plugin::storage(3, plugin::whole(world_.blocks().buffer()))};
    Bindings outputs;
    addOutputs(frame, outputs);
    const auto resolution = frame.value<Resolution>(kResolution);
    if (resolution != Resolution::kFull && pixelsOf(frame) <= kRestMost) {
      recordReduced(frame, resolution == Resolution::kHalf ? 2 : 4, shared, lists, outputs);
      return;
    }
    const grisaille_pipeline pipeline = surface_.get(walkConstants(frame));
    frame.pass("surface", [&] { cover(frame, pipeline, joined({shared, lists, outputs})); });
  }

  // Mode `surface` below full resolution: the passes samples, upsample and rest.
  // step: distance of samples, pixels.
  // shared, lists, outputs: bindings of all three passes, of those that walk, and of those that
  // write the outputs.
  void recordReduced(const plugin::Frame& frame, uint32_t step, const Bindings& shared,
                     const Bindings& lists, const Bindings& outputs) {
    const uint32_t width = plugin::groupsFor(frame.width() - 1, step) + 1;
    const uint32_t height = plugin::groupsFor(frame.height() - 1, step) + 1;
    const auto scratch = [&](const char* label) {
      return frame.transient(
          {.label = label, .format = GRISAILLE_FORMAT_RGBA32F, .width = width, .height = height});
    };
    const grisaille_texture samples = scratch("samples"), planes = scratch("planes");
    const auto refine = frame.value<uint32_t>(kRefine);
    const grisaille_binding rest = plugin::storage(4, plugin::whole(restFor(frame)));

    const grisaille_constant one = walkConstants(frame)[1], spacing = plugin::specialize(2, step);
    frame.pass("samples", [&] {
      frame.dispatch(
          samples_.get({plugin::specialize(0, isCovered(frame)), one, spacing}),
          joined({shared, lists, {rest, plugin::image(0, samples), plugin::image(1, planes)}}),
          plugin::groupsFor(width, kGroup), plugin::groupsFor(height, kGroup));
    });
    const grisaille_pipeline upsample = upsample_.get(
        {plugin::specialize(0, wanted(frame)), spacing, plugin::specialize(3, refine)});
    frame.pass("upsample", [&] {
      frame.dispatch(upsample,
                     joined({shared,
                             outputs,
                             {rest, plugin::texture(2, samples, nearest_),
                              plugin::texture(3, planes, nearest_)}}),
                     plugin::groupsFor(frame.width(), kGroup * step),
                     plugin::groupsFor(frame.height(), kGroup * step));
    });
    if (refine == static_cast<uint32_t>(Refine::kNothing)) return;
    frame.pass("rest", [&] {
      frame.dispatch(rest_.get(walkConstants(frame)), joined({shared, lists, outputs, {rest}}),
                     static_cast<uint32_t>(pixelsOf(frame) / kRestShare / kRestGroup) + 1, 1);
    });
  }

  static uint64_t pixelsOf(const plugin::Frame& frame) {
    return uint64_t{frame.width()} * frame.height();
  }

  // Buffer of rest.comp: a count, and a word for every pixel.
  grisaille_buffer restFor(const plugin::Frame& frame) {
    const uint64_t words = 1 + pixelsOf(frame);
    if (words > restWords_) {
      restList_ = host_.buffer("rest", words * sizeof(uint32_t));
      restWords_ = words;
    }
    return restList_;
  }

  // Specialization constants 0 and 1 of the shaders that walk.
  std::vector<grisaille_constant> walkConstants(const plugin::Frame& frame) {
    return {plugin::specialize(0, wanted(frame)),
            plugin::specialize(1, world_.levels().size() == 1)};
  }

  static Bindings joined(std::initializer_list<Bindings> parts) {
    Bindings all;
    for (const Bindings& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
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
    const glm::dvec3 metres = glm::round(eye);
    block.camera_cell = glm::ivec4(glm::ivec3(metres), static_cast<int32_t>(levels.size()));
    block.camera_fraction = glm::vec4(glm::dvec4(eye - metres, frame.value<double>(kFull)));
    block.slot_count = world_.cells().slotCount();
    block.per_fade = perFade(frame);
    return block;
  }

  // Whether pixels at full alpha must still sum up strengths.
  static bool isCovered(const plugin::Frame& frame) { return frame.wanted(Output::kCoverage); }

  static uint32_t wanted(const plugin::Frame& frame) {
    return (frame.wanted(Output::kPaint) ? 1u : 0u) | (frame.wanted(Output::kCoverage) ? 2u : 0u) |
           (frame.wanted(Output::kOwner) ? 4u : 0u);
  }

  // Adds images 0 ... 2. An output that nothing reads gets an image of one texel.
  static void addOutputs(const plugin::Frame& frame, Bindings& bindings) {
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
  plugin::PipelineCache firstShot_, perShot_, lastShot_, surface_, samples_, upsample_, rest_;
  plugin::Sampler nearest_;
  plugin::Buffer restList_;
  uint64_t restWords_ = 0;
  PaintWorld world_;
  Uploader uploader_;
  size_t kept_ = 0;  // leading shots of the list unchanged since world_ followed it
};

constexpr auto kSspm =
    plugin::effect<Sspm>({.key = "sspm",
                          .label = "Paint",
                          .version = "1.0.0",
                          .tooltip = "Paint shot onto whatever the picture shows",
                          .params = kParams,
                          .outputs = kOutputs,
                          .objects = &kShots});

}  // namespace
}  // namespace grisaille::sspm

GRISAILLE_EXPORT_PLUGIN(&grisaille::sspm::kSspm);
