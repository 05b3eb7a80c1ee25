// SPDX-License-Identifier: MIT
#include "slices.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dispatch.h"
#include "finish.h"
#include "shaders/ssao_denoise.h"
#include "shaders/ssao_denoise_bent.h"
#include "shaders/ssao_denoise_last.h"
#include "shaders/ssao_denoise_last_bent.h"
#include "shaders/ssao_edges.h"
#include "shaders/ssao_edges_bent.h"
#include "shaders/ssao_edges_last.h"
#include "shaders/ssao_edges_last_bent.h"
#include "shaders/ssao_refined.h"
#include "shaders/ssao_refined_bent.h"
#include "shaders/ssao_slices.h"
#include "shaders/ssao_slices_bent.h"
#include "shaders/ssao_slices_listed.h"
#include "shaders/ssao_slices_listed_bent.h"
#include "shaders/ssao_upsample.h"
#include "shaders/ssao_upsample_bent.h"

namespace grisaille::ssao {
namespace {

// shaders/ssao/slices.glsl, std140.
struct SlicesBlock {
  float radius;
  float thickness;
  float turn;
  float tolerance;
  glm::uvec2 exchange;
  float bias;
};
GRISAILLE_CHECK_BLOCK_ssao_slices_Settings(SlicesBlock);
GRISAILLE_CHECK_BLOCK_ssao_slices_bent_Settings(SlicesBlock);
GRISAILLE_CHECK_BLOCK_ssao_slices_listed_Settings(SlicesBlock);
GRISAILLE_CHECK_BLOCK_ssao_slices_listed_bent_Settings(SlicesBlock);

// shaders/ssao/filter.glsl and refined.glsl, std140.
struct FilterBlock {
  glm::vec4 finish;
  float tolerance;
};
GRISAILLE_CHECK_BLOCK_ssao_denoise_Settings(FilterBlock);
GRISAILLE_CHECK_BLOCK_ssao_denoise_bent_Settings(FilterBlock);
GRISAILLE_CHECK_BLOCK_ssao_denoise_last_Settings(FilterBlock);
GRISAILLE_CHECK_BLOCK_ssao_denoise_last_bent_Settings(FilterBlock);
GRISAILLE_CHECK_BLOCK_ssao_edges_Settings(FilterBlock);
GRISAILLE_CHECK_BLOCK_ssao_edges_bent_Settings(FilterBlock);
GRISAILLE_CHECK_BLOCK_ssao_edges_last_Settings(FilterBlock);
GRISAILLE_CHECK_BLOCK_ssao_edges_last_bent_Settings(FilterBlock);
GRISAILLE_CHECK_BLOCK_ssao_refined_Settings(FilterBlock);
GRISAILLE_CHECK_BLOCK_ssao_refined_bent_Settings(FilterBlock);

// shaders/ssao/upsample.glsl, std140.
struct UpsampleBlock {
  glm::vec4 finish;
  float tolerance;
  float contrast;
};
GRISAILLE_CHECK_BLOCK_ssao_upsample_Settings(UpsampleBlock);
GRISAILLE_CHECK_BLOCK_ssao_upsample_bent_Settings(UpsampleBlock);

// Plane tolerance of the denoiser and the upsampling, in radii.
constexpr float kTolerance = 0.05f;

// The list of shaders/ssao/listed.glsl: pixels of the picture per invocation of a pass that
// processes it, since on a software driver an idle invocation costs as much as a busy one; and the
// most blocks that it holds (48 MiB of the 128 that every device binds).
constexpr uint64_t kListShare = 64, kListMost = 1u << 22;
constexpr uint32_t kGroup = 64;  // invocations

float toleranceOf(const plugin::Frame& frame) {
  return 1 / (kTolerance * frame.value<float>(kRadius));
}

// Fewer taps on a side of a slice find too little between leaves.
constexpr uint32_t kListedSteps = 5;

// How a pixel is sampled: slices, and taps on each side of one.
struct Taken {
  uint32_t slices, steps;
};

// A pixel of the list has few others of its surface around it, so that the noise of its slices
// stays. It takes twice as many as a texel, which share the taps of a texel if that leaves
// kListedSteps to each side.
Taken takenBy(const plugin::Frame& frame, bool listed) {
  const uint32_t taps = frame.value<uint32_t>(kKernelSize), slices = frame.value<uint32_t>(kSlices);
  const uint32_t steps = plugin::groupsFor(taps, 2 * slices);
  if (!listed) return {slices, steps};
  return {2 * slices, std::max(plugin::groupsFor(taps, 4 * slices), std::min(steps, kListedSteps))};
}

uint64_t pixelsOf(const plugin::Frame& frame) {
  return uint64_t{frame.width()} * frame.height();
}

FilterBlock filterBlock(const plugin::Frame& frame) {
  return {.finish = finishOf(frame), .tolerance = toleranceOf(frame)};
}

}  // namespace

Slices::Kernels::Kernels(plugin::Host host)
    : occlusion(host, "slices", grisaille_shader_ssao_slices),
      denoise(host, "denoise", grisaille_shader_ssao_denoise),
      denoiseLast(host, "denoise", grisaille_shader_ssao_denoise_last),
      edges(host, "edges", grisaille_shader_ssao_edges),
      edgesLast(host, "edges", grisaille_shader_ssao_edges_last),
      upsample(host, "upsample", grisaille_shader_ssao_upsample),
      listed(host, "slices, listed", grisaille_shader_ssao_slices_listed),
      refined(host, "denoise, listed", grisaille_shader_ssao_refined) {}

Slices::Kernels Slices::Kernels::withBent(plugin::Host host) {
  Kernels kernels(host);
  kernels.occlusion = {host, "slices, bent", grisaille_shader_ssao_slices_bent};
  kernels.denoise = {host, "denoise, bent", grisaille_shader_ssao_denoise_bent};
  kernels.denoiseLast = {host, "denoise, bent", grisaille_shader_ssao_denoise_last_bent};
  kernels.edges = {host, "edges, bent", grisaille_shader_ssao_edges_bent};
  kernels.edgesLast = {host, "edges, bent", grisaille_shader_ssao_edges_last_bent};
  kernels.upsample = {host, "upsample, bent", grisaille_shader_ssao_upsample_bent};
  kernels.listed = {host, "slices, listed, bent", grisaille_shader_ssao_slices_listed_bent};
  kernels.refined = {host, "denoise, listed, bent", grisaille_shader_ssao_refined_bent};
  return kernels;
}

Slices::Slices(plugin::Host host)
    : host_(host),
      open_(host),
      openAndBent_(Kernels::withBent(host)),
      clamped_(host.sampler({.label = "clamped"})),
      history_(host) {}

uint32_t Slices::reads(plugin::Values values) noexcept {
  const auto backs = values.get<Backs>(kBacks);
  return GRISAILLE_READS(GRISAILLE_VIEW_DEPTH) | GRISAILLE_READS(GRISAILLE_NORMAL) |
         (backs >= Backs::kDrawn ? GRISAILLE_READS(GRISAILLE_BACK_DEPTH) : 0u) |
         (backs == Backs::kPeeled ? GRISAILLE_READS(GRISAILLE_NEXT_DEPTH) : 0u) |
         (backs == Backs::kBodies ? GRISAILLE_READS(GRISAILLE_THICKNESS) : 0u) |
         (values.get<uint32_t>(kHistory) > 1 ? GRISAILLE_READS(GRISAILLE_MOTION) : 0u);
}

void Slices::record(const plugin::Frame& frame, Pair outputs) {
  const uint32_t scale = 1u << frame.value<uint32_t>(kResolution);
  Size size = {.scale = scale,
               .width = plugin::groupsFor(frame.width(), scale),
               .height = plugin::groupsFor(frame.height(), scale),
               .tangents = {}};
  const bool bent = outputs.bent.id != 0;
  const auto pair = [&](const char* open, const char* direction) {
    const auto texture = [&](const char* label, grisaille_format format) {
      return frame.transient(
          {.label = label, .format = format, .width = size.width, .height = size.height});
    };
    return Pair{.open = texture(open, GRISAILLE_FORMAT_RG32F),
                .bent = bent ? texture(direction, GRISAILLE_FORMAT_RGBA16F) : grisaille_texture{0}};
  };
  size.tangents = frame.transient({.label = "tangents",
                                   .format = GRISAILLE_FORMAT_R32UI,
                                   .width = size.width,
                                   .height = size.height});
  const uint32_t width = frame.value<uint32_t>(kBlurSize);  // pixels
  const uint32_t blur = width > scale ? width : 0;          // one texel or less: none
  const bool edges = blur > 0 && frame.value<uint32_t>(kEdgeDenoise) > 1;
  history_.keepOnly({frame.value<double>(kRadius), frame.value<double>(kSlices),
                     frame.value<double>(kEdgeSlices), frame.value<double>(kKernelSize),
                     frame.value<double>(kBias), frame.value<double>(kThickness),
                     frame.value<double>(kBacks), double{1} * frame.view().orthographic});
  const uint32_t averaged = frame.value<uint32_t>(kHistory);
  if (averaged == 1) history_.forget();

  Kernels& kernels = bent ? openAndBent_ : open_;
  const Pair raw = pair("raw visibility", "raw open direction");
  frame.pass("occlusion", [&] { occlude(frame, kernels.occlusion, size, raw, nullptr); });
  Pair from = raw, spare = raw;
  if (blur > 0) {
    spare = pair("visibility denoised", "open direction denoised");
    frame.pass("denoise rows", [&] {
      denoise(frame, kernels, size, {.columns = false, .width = blur, .last = false}, from, spare);
    });
    from = spare;
  }
  const bool averages = averaged > 1, last = scale == 1 && !averages;
  if (last && !edges) {
    frame.pass("denoise columns", [&] {
      denoise(frame, kernels, size, {.columns = true, .width = blur, .last = true}, from, outputs);
    });
    return;
  }
  if (blur > 0) {
    frame.pass("denoise columns", [&] {
      denoise(frame, kernels, size, {.columns = true, .width = blur, .last = false}, from, raw);
    });
    from = raw;
  }
  if (edges) {
    const Pair target = last ? outputs : spare;
    frame.pass("denoise edges", [&] { alongEdges(frame, kernels, size, last, from, target); });
    if (last) return;
    from = target;
  }
  if (averages) from.open = history_.accumulate(frame, scale, averaged - 1, from.open);
  if (scale == 1) {
    frame.pass("finish", [&] {
      denoise(frame, kernels, size, {.columns = true, .width = 0, .last = true}, from, outputs);
    });
    return;
  }
  enlarge(frame, kernels, size, from, outputs);
}

// From the effect's resolution to the picture's.
void Slices::enlarge(const plugin::Frame& frame, Kernels& kernels, Size size, Pair coarse,
                     Pair outputs) {
  const bool refines = frame.value<Refine>(kRefine) != Refine::kNothing;
  const Size full = {.scale = 1, .width = frame.width(), .height = frame.height(), .tangents = {}};
  const bool bent = outputs.bent.id != 0;
  // Without refinement, as small as can be bound.
  const auto texture = [&](const char* label, grisaille_format format, uint32_t pixels) {
    return frame.transient({.label = label,
                            .format = format,
                            .width = refines ? plugin::groupsFor(full.width, pixels) : 1,
                            .height = refines ? plugin::groupsFor(full.height, pixels) : 1});
  };
  const Listed listed = {
      .list = listFor(frame, refines),
      .blocks = texture("visibility upsampled", GRISAILLE_FORMAT_R32UI, 2),
      .bent = bent ? texture("open direction upsampled", GRISAILLE_FORMAT_RGBA16F, 1)
                   : grisaille_texture{0}};
  frame.pass("upsample", [&] { upsample(frame, kernels, size, coarse, listed, outputs); });
  if (!refines) return;
  const Pair raw = {.open = listed.blocks,
                    .bent = bent ? texture("refined open direction", GRISAILLE_FORMAT_RGBA16F, 1)
                                 : grisaille_texture{0}};
  frame.pass("refine", [&] { occlude(frame, kernels.listed, full, raw, &listed); });
  frame.pass("denoise refined", [&] { denoiseListed(frame, kernels, listed, raw.bent, outputs); });
}

// An empty list for the blocks of the picture; without refinement, as short as can be bound.
grisaille_binding Slices::listFor(const plugin::Frame& frame, bool refines) {
  const uint64_t blocks =
      uint64_t{plugin::groupsFor(frame.width(), 2)} * plugin::groupsFor(frame.height(), 2);
  // The count, and three words a block.
  const uint64_t words = 1 + 3 * std::min(refines ? blocks : 1, kListMost);
  const bool grows = words > listWords_;
  if (grows) {
    list_ = host_.buffer("listed", words * sizeof(uint32_t));
    listWords_ = words;
  }
  if (grows || refines) frame.uploadBuffer(list_, 0, std::array<uint32_t, 1>{0});
  return plugin::storage(0, plugin::whole(list_));
}

uint32_t Slices::listGroups(const plugin::Frame& frame) {
  return static_cast<uint32_t>(pixelsOf(frame) / kListShare / kGroup) + 1;
}

void Slices::occlude(const plugin::Frame& frame, plugin::PipelineCache& pipelines, Size size,
                     Pair target, const Listed* listed) {
  const float radius = frame.value<float>(kRadius);
  // In 25 frames a texel draws each of the pattern's 25 points; successive points lie far apart.
  // Each seed, and each further 25 frames, rotates the pattern by the golden ratio. The start of
  // 3/8 keeps the first slice off the axes, where rounding errors would decide. The pixels of the
  // list are not averaged over frames, and always draw the same points.
  const uint64_t frames = listed != nullptr ? 0 : history_.frames();
  const auto drawn = static_cast<uint32_t>(frames % 25);
  const double turns = frame.value<double>(kSeed) + static_cast<double>(frames / 25);
  const float turn = static_cast<float>(std::fmod(0.375 + turns * 0.6180339887498949, 1.0));
  const SlicesBlock settings = {.radius = radius,
                                .thickness = radius * frame.value<float>(kThickness),
                                .turn = turn,
                                .tolerance = toleranceOf(frame),
                                .exchange = {2 * drawn % 5, (drawn + 2 * (drawn / 5)) % 5},
                                .bias = frame.value<float>(kBias)};
  // A host may not know how thick bodies are.
  auto backs = frame.value<Backs>(kBacks);
  grisaille_texture known = frame.attachment(GRISAILLE_VIEW_DEPTH);
  if (backs >= Backs::kDrawn) known = frame.attachment(GRISAILLE_BACK_DEPTH);
  if (backs == Backs::kBodies) {
    const grisaille_texture thickness = frame.attachment(GRISAILLE_THICKNESS);
    if (thickness.id != 0) {
      known = thickness;
    } else {
      backs = Backs::kAssumed;
    }
  }
  // Nor what lies behind their backs.
  grisaille_texture next = {0};
  if (backs == Backs::kPeeled) next = frame.attachment(GRISAILLE_NEXT_DEPTH);
  if (next.id == 0) {
    next = known;
    backs = std::min(backs, Backs::kDrawn);
  }
  // Constants of shaders/ssao/slices.glsl; the list's has all but the last.
  const Taken taken = takenBy(frame, listed != nullptr);
  const grisaille_constant constants[] = {
      cameraKind(frame),
      plugin::specialize(0, taken.slices),
      plugin::specialize(1, taken.steps),
      plugin::specialize(2, size.scale),
      plugin::specialize(3, static_cast<uint32_t>(backs)),
      plugin::specialize(4, frame.value<uint32_t>(kEdgeSlices))};
  Bindings bindings = {plugin::uniform(0, frame.viewBlock()),
                       plugin::uniform(1, frame.uniform(settings)),
                       plugin::texture(0, frame.attachment(GRISAILLE_VIEW_DEPTH), clamped_),
                       plugin::texture(1, frame.attachment(GRISAILLE_NORMAL), clamped_),
                       plugin::texture(2, known, clamped_),
                       plugin::texture(3, next, clamped_),
                       plugin::image(0, target.open)};
  if (target.bent.id != 0) bindings.add(plugin::image(1, target.bent));
  if (listed == nullptr) {
    bindings.add(plugin::image(2, size.tangents));
    dispatch(frame, pipelines.get(constants), bindings, size.width, size.height);
    return;
  }
  bindings.add(listed->list);
  frame.dispatch(pipelines.get(std::span(constants).first(5)), bindings, listGroups(frame), 1);
}

// Bindings of shaders/ssao/filter.glsl.
Bindings Slices::filterBindings(const plugin::Frame& frame, Size size, bool last, Pair from,
                                Pair target) const {
  Bindings bindings = {plugin::uniform(0, frame.viewBlock()),
                       plugin::uniform(1, frame.uniform(filterBlock(frame))),
                       plugin::texture(0, from.open, clamped_),
                       plugin::texture(1, size.tangents, clamped_), plugin::image(0, target.open)};
  if (target.bent.id != 0) {
    bindings.add(plugin::texture(2, from.bent, clamped_));
    if (last) bindings.add(plugin::texture(3, frame.attachment(GRISAILLE_NORMAL), clamped_));
    bindings.add(plugin::image(1, target.bent));
  }
  return bindings;
}

void Slices::denoise(const plugin::Frame& frame, Kernels& kernels, Size size, Tent tent, Pair raw,
                     Pair target) {
  // Constants of shaders/ssao/denoise.glsl.
  const grisaille_constant constants[] = {cameraKind(frame), plugin::specialize(0, tent.width),
                                          plugin::specialize(1, size.scale),
                                          plugin::specialize(2, tent.columns)};
  plugin::PipelineCache& pipelines = tent.last ? kernels.denoiseLast : kernels.denoise;
  // Texels per invocation, along the row or the column.
  constexpr uint32_t kRun = 4;
  dispatch(frame, pipelines.get(constants), filterBindings(frame, size, tent.last, raw, target),
           tent.columns ? size.width : plugin::groupsFor(size.width, kRun),
           tent.columns ? plugin::groupsFor(size.height, kRun) : size.height);
}

void Slices::alongEdges(const plugin::Frame& frame, Kernels& kernels, Size size, bool last,
                        Pair denoised, Pair target) {
  // Constants of shaders/ssao/edges.glsl.
  const grisaille_constant constants[] = {
      cameraKind(frame), plugin::specialize(0, frame.value<uint32_t>(kEdgeDenoise)),
      plugin::specialize(1, size.scale)};
  plugin::PipelineCache& pipelines = last ? kernels.edgesLast : kernels.edges;
  dispatch(frame, pipelines.get(constants), filterBindings(frame, size, last, denoised, target),
           size.width, size.height);
}

void Slices::upsample(const plugin::Frame& frame, Kernels& kernels, Size size, Pair coarse,
                      const Listed& listed, Pair target) {
  // Constants of shaders/ssao/upsample.glsl.
  const grisaille_constant constants[] = {cameraKind(frame), plugin::specialize(0, size.scale),
                                          plugin::specialize(1, frame.value<uint32_t>(kRefine))};
  const UpsampleBlock settings = {.finish = finishOf(frame),
                                  .tolerance = toleranceOf(frame),
                                  .contrast = frame.value<float>(kContrast)};
  Bindings bindings = {plugin::uniform(0, frame.viewBlock()),
                       plugin::uniform(1, frame.uniform(settings)),
                       plugin::texture(0, coarse.open, clamped_),
                       plugin::texture(1, frame.attachment(GRISAILLE_VIEW_DEPTH), clamped_),
                       plugin::texture(2, size.tangents, clamped_),
                       plugin::image(0, target.open),
                       plugin::image(2, listed.blocks),
                       listed.list};
  if (target.bent.id != 0) {
    bindings.add(plugin::texture(3, coarse.bent, clamped_));
    bindings.add(plugin::texture(4, frame.attachment(GRISAILLE_NORMAL), clamped_));
    bindings.add(plugin::image(1, target.bent));
    bindings.add(plugin::image(3, listed.bent));
  }
  dispatch(frame, kernels.upsample.get(constants), bindings, plugin::groupsFor(frame.width(), 2),
           plugin::groupsFor(frame.height(), 2));
}

// Bindings of shaders/ssao/refined.glsl.
void Slices::denoiseListed(const plugin::Frame& frame, Kernels& kernels, const Listed& listed,
                           grisaille_texture rawBent, Pair target) {
  Bindings bindings = {plugin::uniform(0, frame.viewBlock()),
                       plugin::uniform(1, frame.uniform(filterBlock(frame))),
                       plugin::texture(0, listed.blocks, clamped_),
                       plugin::texture(1, frame.attachment(GRISAILLE_VIEW_DEPTH), clamped_),
                       plugin::texture(2, frame.attachment(GRISAILLE_NORMAL), clamped_),
                       plugin::image(0, target.open),
                       listed.list};
  if (target.bent.id != 0) {
    bindings.add(plugin::texture(3, listed.bent, clamped_));
    bindings.add(plugin::texture(4, rawBent, clamped_));
    bindings.add(plugin::image(1, target.bent));
  }
  frame.dispatch(kernels.refined.get({cameraKind(frame)}), bindings, listGroups(frame), 1);
}

}  // namespace grisaille::ssao
