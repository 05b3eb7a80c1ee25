// SPDX-License-Identifier: MIT
#include "slices.h"

#include <algorithm>
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
#include "shaders/ssao_slices.h"
#include "shaders/ssao_slices_bent.h"
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

// shaders/ssao/denoise.glsl, edges.glsl and upsample.glsl, std140.
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
GRISAILLE_CHECK_BLOCK_ssao_upsample_Settings(FilterBlock);
GRISAILLE_CHECK_BLOCK_ssao_upsample_bent_Settings(FilterBlock);

// Plane tolerance of the denoiser and the upsampling, in radii.
constexpr float kTolerance = 0.05f;

float toleranceOf(const plugin::Frame& frame) {
  return 1 / (kTolerance * frame.value<float>(kRadius));
}

// Taps on each side of a slice.
uint32_t stepsOf(const plugin::Frame& frame) {
  return plugin::groupsFor(frame.value<uint32_t>(kKernelSize), 2 * frame.value<uint32_t>(kSlices));
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
      upsample(host, "upsample", grisaille_shader_ssao_upsample) {}

Slices::Kernels Slices::Kernels::withBent(plugin::Host host) {
  Kernels kernels(host);
  kernels.occlusion = {host, "slices, bent", grisaille_shader_ssao_slices_bent};
  kernels.denoise = {host, "denoise, bent", grisaille_shader_ssao_denoise_bent};
  kernels.denoiseLast = {host, "denoise, bent", grisaille_shader_ssao_denoise_last_bent};
  kernels.edges = {host, "edges, bent", grisaille_shader_ssao_edges_bent};
  kernels.edgesLast = {host, "edges, bent", grisaille_shader_ssao_edges_last_bent};
  kernels.upsample = {host, "upsample, bent", grisaille_shader_ssao_upsample_bent};
  return kernels;
}

Slices::Slices(plugin::Host host)
    : open_(host),
      openAndBent_(Kernels::withBent(host)),
      clamped_(host.sampler({.label = "clamped"})),
      history_(host) {}

uint32_t Slices::reads(plugin::Values values) noexcept {
  return GRISAILLE_READS(GRISAILLE_VIEW_DEPTH) | GRISAILLE_READS(GRISAILLE_NORMAL) |
         (values.get<Backs>(kBacks) == Backs::kDrawn ? GRISAILLE_READS(GRISAILLE_BACK_DEPTH) : 0u) |
         (values.get<Backs>(kBacks) == Backs::kBodies ? GRISAILLE_READS(GRISAILLE_THICKNESS) : 0u) |
         (values.get<uint32_t>(kHistory) > 1 ? GRISAILLE_READS(GRISAILLE_MOTION) : 0u);
}

void Slices::record(const plugin::Frame& frame, Pair outputs) {
  const uint32_t scale = 1u << frame.value<uint32_t>(kResolution);
  const Size size = {.scale = scale,
                     .width = plugin::groupsFor(frame.width(), scale),
                     .height = plugin::groupsFor(frame.height(), scale)};
  const bool bent = outputs.bent.id != 0;
  const auto pair = [&](const char* open, const char* direction) {
    const auto texture = [&](const char* label, grisaille_format format) {
      return frame.transient(
          {.label = label, .format = format, .width = size.width, .height = size.height});
    };
    return Pair{.open = texture(open, GRISAILLE_FORMAT_RG32F),
                .bent = bent ? texture(direction, GRISAILLE_FORMAT_RGBA16F) : grisaille_texture{0}};
  };
  const uint32_t width = frame.value<uint32_t>(kBlurSize);  // pixels
  const uint32_t blur = width > scale ? width : 0;          // one texel or less: none
  const bool edges = blur > 0 && frame.value<uint32_t>(kEdgeDenoise) > 1;
  history_.keepOnly({frame.value<double>(kRadius), frame.value<double>(kSlices),
                     frame.value<double>(kEdgeSlices), frame.value<double>(kKernelSize),
                     frame.value<double>(kBias), frame.value<double>(kThickness),
                     frame.value<double>(kBacks)});
  const uint32_t averaged = frame.value<uint32_t>(kHistory);
  if (averaged == 1) history_.forget();

  Kernels& kernels = bent ? openAndBent_ : open_;
  const Pair raw = pair("raw visibility", "raw open direction");
  frame.pass("occlusion", [&] { occlude(frame, kernels, size, raw); });
  Pair from = raw, spare = raw;
  if (blur > 0) {
    spare = pair("visibility denoised", "open direction denoised");
    frame.pass("denoise rows",
               [&] { denoise(frame, kernels.denoise, size, false, blur, from, spare); });
    from = spare;
  }
  const bool averages = averaged > 1, last = scale == 1 && !averages;
  if (last && !edges) {
    frame.pass("denoise columns",
               [&] { denoise(frame, kernels.denoiseLast, size, true, blur, from, outputs); });
    return;
  }
  if (blur > 0) {
    frame.pass("denoise columns",
               [&] { denoise(frame, kernels.denoise, size, true, blur, from, raw); });
    from = raw;
  }
  if (edges) {
    const Pair target = last ? outputs : spare;
    frame.pass("denoise edges", [&] {
      alongEdges(frame, last ? kernels.edgesLast : kernels.edges, size, from, target);
    });
    if (last) return;
    from = target;
  }
  if (averages) from.open = history_.accumulate(frame, scale, averaged - 1, from.open);
  if (scale == 1) {
    frame.pass("finish",
               [&] { denoise(frame, kernels.denoiseLast, size, true, 0, from, outputs); });
    return;
  }
  frame.pass("upsample", [&] { upsample(frame, kernels, size, from, outputs); });
}

void Slices::occlude(const plugin::Frame& frame, Kernels& kernels, Size size, Pair target) {
  const float radius = frame.value<float>(kRadius);
  // In 25 frames a texel draws each of the pattern's 25 points; successive points lie far apart.
  // Each seed, and each further 25 frames, rotates the pattern by the golden ratio. The start of
  // 3/8 keeps the first slice off the axes, where rounding errors would decide.
  const auto drawn = static_cast<uint32_t>(history_.frames() % 25);
  const double turns = frame.value<double>(kSeed) + static_cast<double>(history_.frames() / 25);
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
  if (backs == Backs::kDrawn) known = frame.attachment(GRISAILLE_BACK_DEPTH);
  if (backs == Backs::kBodies) {
    const grisaille_texture thickness = frame.attachment(GRISAILLE_THICKNESS);
    if (thickness.id != 0) {
      known = thickness;
    } else {
      backs = Backs::kAssumed;
    }
  }
  // Constants 0 ... 4 of shaders/ssao/slices.glsl.
  const grisaille_constant constants[] = {
      plugin::specialize(0, frame.value<uint32_t>(kSlices)), plugin::specialize(1, stepsOf(frame)),
      plugin::specialize(2, size.scale), plugin::specialize(3, static_cast<uint32_t>(backs)),
      plugin::specialize(4, frame.value<uint32_t>(kEdgeSlices))};
  Bindings bindings = {plugin::uniform(0, frame.viewBlock()),
                       plugin::uniform(1, frame.uniform(settings)),
                       plugin::texture(0, frame.attachment(GRISAILLE_VIEW_DEPTH), clamped_),
                       plugin::texture(1, frame.attachment(GRISAILLE_NORMAL), clamped_),
                       plugin::texture(2, known, clamped_),
                       plugin::image(0, target.open)};
  if (target.bent.id != 0) bindings.add(plugin::image(1, target.bent));
  dispatch(frame, kernels.occlusion.get(constants), bindings, size.width, size.height);
}

// Bindings of shaders/ssao/filter.glsl.
Bindings Slices::filterBindings(const plugin::Frame& frame, Pair from, Pair target) const {
  Bindings bindings = {plugin::uniform(0, frame.viewBlock()),
                       plugin::uniform(1, frame.uniform(filterBlock(frame))),
                       plugin::texture(0, from.open, clamped_),
                       plugin::texture(1, frame.attachment(GRISAILLE_NORMAL), clamped_),
                       plugin::image(0, target.open)};
  if (target.bent.id != 0) {
    bindings.add(plugin::texture(2, from.bent, clamped_));
    bindings.add(plugin::image(1, target.bent));
  }
  return bindings;
}

void Slices::denoise(const plugin::Frame& frame, plugin::PipelineCache& pipelines, Size size,
                     bool columns, uint32_t blur, Pair raw, Pair target) {
  // Constants 0 ... 2 of shaders/ssao/denoise.glsl.
  const grisaille_constant constants[] = {plugin::specialize(0, blur),
                                          plugin::specialize(1, size.scale),
                                          plugin::specialize(2, columns)};
  // Texels per invocation, along the row or the column.
  constexpr uint32_t kRun = 4;
  dispatch(frame, pipelines.get(constants), filterBindings(frame, raw, target),
           columns ? size.width : plugin::groupsFor(size.width, kRun),
           columns ? plugin::groupsFor(size.height, kRun) : size.height);
}

void Slices::alongEdges(const plugin::Frame& frame, plugin::PipelineCache& pipelines, Size size,
                        Pair denoised, Pair target) {
  // Constants 0 and 1 of shaders/ssao/edges.glsl.
  const grisaille_constant constants[] = {
      plugin::specialize(0, frame.value<uint32_t>(kEdgeDenoise)),
      plugin::specialize(1, size.scale)};
  dispatch(frame, pipelines.get(constants), filterBindings(frame, denoised, target), size.width,
           size.height);
}

void Slices::upsample(const plugin::Frame& frame, Kernels& kernels, Size size, Pair coarse,
                      Pair target) {
  // Constant 0 of shaders/ssao/upsample.glsl.
  const grisaille_constant constants[] = {plugin::specialize(0, size.scale)};
  Bindings bindings = {plugin::uniform(0, frame.viewBlock()),
                       plugin::uniform(1, frame.uniform(filterBlock(frame))),
                       plugin::texture(0, coarse.open, clamped_),
                       plugin::texture(1, frame.attachment(GRISAILLE_VIEW_DEPTH), clamped_),
                       plugin::texture(2, frame.attachment(GRISAILLE_NORMAL), clamped_),
                       plugin::image(0, target.open)};
  if (target.bent.id != 0) {
    bindings.add(plugin::texture(3, coarse.bent, clamped_));
    bindings.add(plugin::image(1, target.bent));
  }
  dispatch(frame, kernels.upsample.get(constants), bindings, plugin::groupsFor(frame.width(), 2),
           plugin::groupsFor(frame.height(), 2));
}

}  // namespace grisaille::ssao
