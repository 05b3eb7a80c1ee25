// SPDX-License-Identifier: MIT
#include "slices.h"

#include <algorithm>
#include <cmath>

#include "dispatch.h"
#include "parameters.h"
#include "shaders/ssao_denoise.h"
#include "shaders/ssao_denoise_last.h"
#include "shaders/ssao_slices.h"
#include "shaders/ssao_upsample.h"

namespace grisaille::ssao {
namespace {

// shaders/ssao/slices.comp, std140.
struct SlicesBlock {
  float radius;
  float thickness;
  float turn;
};
GRISAILLE_CHECK_BLOCK_ssao_slices_Settings(SlicesBlock);

// shaders/ssao/denoise.glsl and upsample.comp, std140.
struct FilterBlock {
  float tolerance;
  float intensity;
  float power;
};
GRISAILLE_CHECK_BLOCK_ssao_denoise_Settings(FilterBlock);
GRISAILLE_CHECK_BLOCK_ssao_denoise_last_Settings(FilterBlock);
GRISAILLE_CHECK_BLOCK_ssao_upsample_Settings(FilterBlock);

// How far from the plane of a pixel's surface another may lie to be averaged with it, in radii.
constexpr float kTolerance = 0.05f;

FilterBlock filterBlock(const plugin::Frame& frame) {
  return {.tolerance = 1 / (kTolerance * frame.value<float>(kRadius)),
          .intensity = frame.value<float>(kIntensity),
          .power = frame.value<float>(kPower)};
}

}  // namespace

Slices::Slices(plugin::Host host)
    : occlusion_(host, "slices", grisaille_shader_ssao_slices),
      denoise_(host, "denoise", grisaille_shader_ssao_denoise),
      denoiseLast_(host, "denoise", grisaille_shader_ssao_denoise_last),
      upsample_(host, "upsample", grisaille_shader_ssao_upsample),
      clamped_(host.sampler({.label = "clamped"})) {}

uint32_t Slices::reads() noexcept {
  return GRISAILLE_READS(GRISAILLE_VIEW_DEPTH) | GRISAILLE_READS(GRISAILLE_NORMAL);
}

void Slices::record(const plugin::Frame& frame) {
  const uint32_t scale = 1u << frame.value<uint32_t>(kResolution);
  const Size size = {.scale = scale,
                     .width = plugin::groupsFor(frame.width(), scale),
                     .height = plugin::groupsFor(frame.height(), scale)};
  const auto texture = [&](const char* label) {
    return frame.transient({.label = label,
                            .format = GRISAILLE_FORMAT_RG32F,
                            .width = size.width,
                            .height = size.height});
  };
  const uint32_t blur = std::max(frame.value<uint32_t>(kBlurSize), 1u);
  const grisaille_texture raw = texture("raw visibility");
  frame.pass("occlusion", [&] { occlude(frame, size, raw); });
  grisaille_texture rows = raw;
  if (blur > 1) {
    rows = texture("visibility denoised along rows");
    frame.pass("denoise rows", [&] { denoise(frame, size, denoise_, false, blur, raw, rows); });
  }
  if (scale == 1) {
    frame.pass("denoise columns",
               [&] { denoise(frame, size, denoiseLast_, true, blur, rows, frame.output(0)); });
    return;
  }
  if (blur > 1) {
    frame.pass("denoise columns", [&] { denoise(frame, size, denoise_, true, blur, rows, raw); });
  }
  frame.pass("upsample", [&] { upsample(frame, size, raw); });
}

void Slices::occlude(const plugin::Frame& frame, Size size, grisaille_texture target) {
  const float radius = frame.value<float>(kRadius);
  // Seeds turn the pattern; the golden ratio spreads them.
  const float turn =
      static_cast<float>(std::fmod(0.5 + frame.value<uint32_t>(kSeed) * 0.6180339887498949, 1.0));
  const SlicesBlock settings = {
      .radius = radius, .thickness = radius * frame.value<float>(kThickness), .turn = turn};
  // Constants 0 ... 2 of shaders/ssao/slices.comp.
  const grisaille_constant constants[] = {plugin::specialize(0, frame.value<uint32_t>(kSlices)),
                                          plugin::specialize(1, frame.value<uint32_t>(kSteps)),
                                          plugin::specialize(2, size.scale)};
  const grisaille_binding bindings[] = {
      plugin::uniform(0, frame.viewBlock()), plugin::uniform(1, frame.uniform(settings)),
      plugin::texture(0, frame.attachment(GRISAILLE_VIEW_DEPTH), clamped_),
      plugin::texture(1, frame.attachment(GRISAILLE_NORMAL), clamped_), plugin::image(0, target)};
  dispatch(frame, occlusion_.get(constants), bindings, size.width, size.height);
}

void Slices::denoise(const plugin::Frame& frame, Size size, plugin::PipelineCache& pipelines,
                     bool columns, uint32_t blur, grisaille_texture raw, grisaille_texture target) {
  // Constants 0 ... 2 of shaders/ssao/denoise.glsl.
  const grisaille_constant constants[] = {plugin::specialize(0, blur),
                                          plugin::specialize(1, size.scale),
                                          plugin::specialize(2, columns)};
  const grisaille_binding bindings[] = {
      plugin::uniform(0, frame.viewBlock()), plugin::uniform(1, frame.uniform(filterBlock(frame))),
      plugin::texture(0, raw, clamped_),
      plugin::texture(1, frame.attachment(GRISAILLE_NORMAL), clamped_), plugin::image(0, target)};
  // A run of texels an invocation, along the row or the column.
  constexpr uint32_t kRun = 4;
  dispatch(frame, pipelines.get(constants), bindings,
           columns ? size.width : plugin::groupsFor(size.width, kRun),
           columns ? plugin::groupsFor(size.height, kRun) : size.height);
}

void Slices::upsample(const plugin::Frame& frame, Size size, grisaille_texture coarse) {
  // Constant 0 of shaders/ssao/upsample.comp.
  const grisaille_constant constants[] = {plugin::specialize(0, size.scale)};
  const grisaille_binding bindings[] = {
      plugin::uniform(0, frame.viewBlock()),
      plugin::uniform(1, frame.uniform(filterBlock(frame))),
      plugin::texture(0, coarse, clamped_),
      plugin::texture(1, frame.attachment(GRISAILLE_VIEW_DEPTH), clamped_),
      plugin::texture(2, frame.attachment(GRISAILLE_NORMAL), clamped_),
      plugin::image(0, frame.output(0))};
  dispatch(frame, upsample_.get(constants), bindings, plugin::groupsFor(frame.width(), 2),
           plugin::groupsFor(frame.height(), 2));
}

}  // namespace grisaille::ssao
