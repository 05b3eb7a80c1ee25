// SPDX-License-Identifier: MIT
#include "classic.h"

#include <algorithm>

#include "dispatch.h"
#include "finish.h"
#include "kernel.h"
#include "parameters.h"
#include "shaders/ssao_blur.h"
#include "shaders/ssao_hemisphere.h"
#include "shaders/ssao_sphere.h"

namespace grisaille::ssao {
namespace {

// shaders/ssao/occlusion.glsl, std140.
struct SettingsBlock {
  glm::vec4 kernel[kMostPoints];
  glm::vec4 finish;
  float radius;
  float bias;
};
GRISAILLE_CHECK_BLOCK_ssao_hemisphere_Settings(SettingsBlock);

// shaders/ssao/blur.comp, std140.
struct BlurBlock {
  glm::vec4 finish;
  float radius;
};
GRISAILLE_CHECK_BLOCK_ssao_blur_Settings(BlurBlock);

}  // namespace

Classic::Classic(plugin::Host host)
    : host_(host),
      hemisphere_(host, "occlusion", grisaille_shader_ssao_hemisphere),
      sphere_(host, "occlusion", grisaille_shader_ssao_sphere),
      blur_(host, "blur", grisaille_shader_ssao_blur),
      clamped_(host.sampler({.label = "clamped"})),
      repeated_(host.sampler({.label = "repeated", .repeat = true})) {}

uint32_t Classic::reads(plugin::Values values) noexcept {
  const bool normals = values.get<Sampling>(Parameter::kSampling) == Sampling::kHemisphere;
  return GRISAILLE_READS(GRISAILLE_VIEW_DEPTH) | (normals ? GRISAILLE_READS(GRISAILLE_NORMAL) : 0u);
}

void Classic::record(const plugin::Frame& frame, grisaille_texture ao) {
  const uint32_t size = frame.value<uint32_t>(kBlurSize);
  const bool blurred = size > 1;
  const grisaille_texture raw = blurred ? frame.transient({.label = "raw occlusion",
                                                           .format = GRISAILLE_FORMAT_R16F,
                                                           .width = frame.width(),
                                                           .height = frame.height()})
                                        : ao;
  frame.pass("occlusion", [&] { occlude(frame, raw, blurred); });
  if (blurred) {
    frame.pass("blur", [&] { blur(frame, raw, ao, size); });
  }
}

void Classic::occlude(const plugin::Frame& frame, grisaille_texture target, bool blurred) {
  const uint32_t seed = frame.value<uint32_t>(kSeed);
  if (noiseSeed_ != seed) {
    if (!noise_) {
      noise_ = host_.texture({.label = "rotations",
                              .format = GRISAILLE_FORMAT_RG32F,
                              .width = kNoiseSize,
                              .height = kNoiseSize,
                              .usage = GRISAILLE_TEXTURE_SAMPLED});
    }
    frame.uploadTexture(noise_, makeNoise(seed));
    noiseSeed_ = seed;
  }
  const auto sampling = frame.value<Sampling>(kSampling);
  const uint32_t count = frame.value<uint32_t>(kKernelSize);
  SettingsBlock settings{};
  std::ranges::copy(makeKernel(sampling, seed), settings.kernel);
  settings.radius = frame.value<float>(kRadius);
  settings.bias = frame.value<float>(kBias);
  settings.finish = finishOf(frame);

  // Constants of shaders/ssao/occlusion.glsl.
  const grisaille_constant constants[] = {cameraKind(frame), plugin::specialize(0, count),
                                          plugin::specialize(1, frame.value<uint32_t>(kRotation)),
                                          plugin::specialize(2, frame.value<uint32_t>(kRangeCheck)),
                                          plugin::specialize(3, !blurred)};
  const bool normals = sampling == Sampling::kHemisphere;
  Bindings bindings = {plugin::uniform(0, frame.viewBlock()),
                       plugin::uniform(1, frame.uniform(settings)),
                       plugin::texture(0, frame.attachment(GRISAILLE_VIEW_DEPTH), clamped_),
                       plugin::texture(1, noise_, repeated_), plugin::image(0, target)};
  if (normals) {
    bindings.add(plugin::texture(2, frame.attachment(GRISAILLE_NORMAL), clamped_));
  }
  dispatch(frame, (normals ? hemisphere_ : sphere_).get(constants), bindings, frame.width(),
           frame.height());
}

void Classic::blur(const plugin::Frame& frame, grisaille_texture raw, grisaille_texture ao,
                   uint32_t size) {
  const BlurBlock settings = {.finish = finishOf(frame), .radius = frame.value<float>(kRadius)};
  // Constants 0 and 1 of shaders/ssao/blur.comp.
  const grisaille_constant constants[] = {plugin::specialize(0, size),
                                          plugin::specialize(1, frame.value<uint32_t>(kBlur))};
  const grisaille_binding bindings[] = {
      plugin::uniform(0, frame.viewBlock()), plugin::uniform(1, frame.uniform(settings)),
      plugin::texture(0, frame.attachment(GRISAILLE_VIEW_DEPTH), clamped_),
      plugin::texture(1, raw, clamped_), plugin::image(0, ao)};
  dispatch(frame, blur_.get(constants), bindings, frame.width(), frame.height());
}

}  // namespace grisaille::ssao
