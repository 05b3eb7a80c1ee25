// SPDX-License-Identifier: MIT
// Screen-space ambient occlusion by sample points in a hemisphere: the classic method. Two passes,
// occlusion and blur; the shaders say how, README.md says why.
#include <optional>
#include <vector>

#include "grisaille/effect.hpp"
#include "kernel.h"
#include "shaders/ssao_blur.h"
#include "shaders/ssao_hemisphere.h"
#include "shaders/ssao_sphere.h"

namespace grisaille::ssao {
namespace {

enum Parameter {
  kKernelSize,
  kRadius,
  kBias,
  kBlurSize,
  kIntensity,
  kPower,
  kSeed,
  kSampling,
  kRotation,
  kRangeCheck,
  kBlur,
};

constexpr const char* kSamplingKeys[] = {"hemisphere", "sphere"};
constexpr const char* kSamplingLabels[] = {"Hemisphere", "Sphere"};
constexpr const char* kRotationKeys[] = {"noise", "none"};
constexpr const char* kRotationLabels[] = {"4x4 noise", "None"};
constexpr const char* kRangeKeys[] = {"linear", "raw_depth", "none"};
constexpr const char* kRangeLabels[] = {"Linear depth", "Raw depth", "None"};
constexpr const char* kBlurKeys[] = {"box", "edge_aware"};
constexpr const char* kBlurLabels[] = {"Box", "Edge-aware"};

constexpr grisaille_param_desc kParams[] = {
    plugin::intParam({.key = "kernel_size",
                      .label = "Kernel size",
                      .tooltip = "Sample points a pixel; cost grows in proportion, noise falls",
                      .hardMin = 1,
                      .hardMax = kMaxKernelSize,
                      .softMin = 4,
                      .softMax = 128,
                      .defaultValue = 64,
                      .log = true}),
    plugin::floatParam({.key = "radius",
                        .label = "Radius",
                        .unit = "m",
                        .tooltip = "How far an occluder may be from the surface it darkens",
                        .hardMin = 1e-6,
                        .hardMax = 1e6,
                        .softMin = 0.01,
                        .softMax = 10,
                        .defaultValue = 0.5,
                        .log = true}),
    plugin::floatParam({.key = "bias",
                        .label = "Bias",
                        .unit = "m",
                        .tooltip =
                            "How much nearer than a sample point the surface must be to occlude "
                            "it; hides self-occlusion, loses fine detail",
                        .hardMin = 0,
                        .hardMax = 1e6,
                        .softMin = 0,
                        .softMax = 0.1,
                        .defaultValue = 0.01,
                        .step = 0.001}),
    plugin::intParam({.key = "blur_size",
                      .label = "Blur size",
                      .unit = "px",
                      .tooltip =
                          "Side of the square that is averaged; 0 and 1: no blur; 4 removes the "
                          "noise's pattern exactly",
                      .hardMin = 0,
                      .hardMax = 16,
                      .softMin = 0,
                      .softMax = 8,
                      .defaultValue = 4}),
    plugin::floatParam({.key = "intensity",
                        .label = "Intensity",
                        .tooltip = "Multiplies the occlusion before it is clamped to 1; the plain "
                                   "average is 1",
                        .hardMin = 0,
                        .hardMax = 10,
                        .softMin = 0,
                        .softMax = 3,
                        .defaultValue = 2,
                        .step = 0.05}),
    plugin::floatParam({.key = "power",
                        .label = "Power",
                        .tooltip = "Exponent of the visibility; over 1 darkens creases",
                        .hardMin = 0.1,
                        .hardMax = 10,
                        .softMin = 0.5,
                        .softMax = 4,
                        .defaultValue = 1,
                        .step = 0.05}),
    plugin::intParam({.key = "seed",
                      .label = "Seed",
                      .tooltip = "Which random sample points and rotations are drawn",
                      .hardMin = 0,
                      .hardMax = 65535,
                      .softMin = 0,
                      .softMax = 100,
                      .defaultValue = 0,
                      .advanced = true}),
    plugin::enumParam({.key = "sampling",
                       .label = "Sampling",
                       .tooltip =
                           "Where the sample points lie: in the hemisphere over the surface, or "
                           "all around, which needs no normals and brightens convex edges",
                       .keys = kSamplingKeys,
                       .labels = kSamplingLabels,
                       .defaultValue = 0,
                       .advanced = true}),
    plugin::enumParam(
        {.key = "rotation",
         .label = "Rotation",
         .tooltip = "Turns the kernel from pixel to pixel, which makes noise out of bands",
         .keys = kRotationKeys,
         .labels = kRotationLabels,
         .defaultValue = 0,
         .advanced = true}),
    plugin::enumParam({.key = "range_check",
                       .label = "Range check",
                       .tooltip =
                           "Which depths must be within the radius for a surface to occlude: raw "
                           "depth is wrong near and far, none leaves halos",
                       .keys = kRangeKeys,
                       .labels = kRangeLabels,
                       .defaultValue = 0,
                       .advanced = true}),
    plugin::enumParam({.key = "blur",
                       .label = "Blur",
                       .tooltip =
                           "Box averages across edges; edge-aware leaves out what is more than "
                           "the radius nearer or farther",
                       .keys = kBlurKeys,
                       .labels = kBlurLabels,
                       .defaultValue = 0,
                       .advanced = true}),
};

constexpr grisaille_output_desc kOutputs[] = {
    plugin::output({.key = "ao",
                    .format = GRISAILLE_FORMAT_R16F,
                    .role = GRISAILLE_ROLE_VISIBILITY,
                    .tooltip = "Ambient visibility, 0 to 1; 1 = open"})};

constexpr uint32_t kGroup = 8;  // threads a side, in all shaders of this effect

// shaders/ssao/occlusion.glsl, std140.
struct SettingsBlock {
  glm::vec4 kernel[kMaxKernelSize];
  float radius;
  float bias;
  float intensity;
  float power;
};
GRISAILLE_CHECK_BLOCK_ssao_hemisphere_Settings(SettingsBlock);

// shaders/ssao/blur.comp, std140.
struct BlurBlock {
  float radius;
  float intensity;
  float power;
};
GRISAILLE_CHECK_BLOCK_ssao_blur_Settings(BlurBlock);

class Ssao {
 public:
  explicit Ssao(plugin::Host host)
      : host_(host),
        hemisphere_(host, "occlusion", grisaille_shader_ssao_hemisphere),
        sphere_(host, "occlusion", grisaille_shader_ssao_sphere),
        blur_(host, "blur", grisaille_shader_ssao_blur),
        clamped_(host.sampler({.label = "clamped"})),
        repeated_(host.sampler({.label = "repeated", .repeat = true})) {}

  static uint32_t reads(plugin::Values values) noexcept {
    const bool normals = values.get<Sampling>(Parameter::kSampling) == Sampling::kHemisphere;
    return GRISAILLE_READS(GRISAILLE_VIEW_DEPTH) |
           (normals ? GRISAILLE_READS(GRISAILLE_NORMAL) : 0u);
  }

  void record(const plugin::Frame& frame) {
    const uint32_t size = frame.value<uint32_t>(kBlurSize);
    const bool blurred = size > 1;
    const grisaille_texture raw = blurred ? frame.transient({.label = "raw occlusion",
                                                             .format = GRISAILLE_FORMAT_R16F,
                                                             .width = frame.width(),
                                                             .height = frame.height()})
                                          : frame.output(0);
    frame.pass("occlusion", [&] { occlude(frame, raw, blurred); });
    if (blurred) {
      frame.pass("blur", [&] { blur(frame, raw, size); });
    }
  }

 private:
  void occlude(const plugin::Frame& frame, grisaille_texture target, bool blurred) {
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
    const auto kernel = makeKernel(count, sampling, seed);
    for (uint32_t i = 0; i < count; ++i) settings.kernel[i] = kernel[i];
    settings.radius = frame.value<float>(kRadius);
    settings.bias = frame.value<float>(kBias);
    settings.intensity = frame.value<float>(kIntensity);
    settings.power = frame.value<float>(kPower);

    // Constants 0 ... 3 of shaders/ssao/occlusion.glsl.
    const grisaille_constant constants[] = {
        plugin::specialize(0, count), plugin::specialize(1, frame.value<uint32_t>(kRotation)),
        plugin::specialize(2, frame.value<uint32_t>(kRangeCheck)), plugin::specialize(3, !blurred)};
    const bool normals = sampling == Sampling::kHemisphere;
    std::vector<grisaille_binding> bindings = {
        plugin::uniform(0, frame.viewBlock()), plugin::uniform(1, frame.uniform(settings)),
        plugin::texture(0, frame.attachment(GRISAILLE_VIEW_DEPTH), clamped_),
        plugin::texture(1, noise_, repeated_), plugin::image(0, target)};
    if (normals) {
      bindings.push_back(plugin::texture(2, frame.attachment(GRISAILLE_NORMAL), clamped_));
    }
    dispatch(frame, (normals ? hemisphere_ : sphere_).get(constants), bindings);
  }

  void blur(const plugin::Frame& frame, grisaille_texture raw, uint32_t size) {
    const BlurBlock settings = {.radius = frame.value<float>(kRadius),
                                .intensity = frame.value<float>(kIntensity),
                                .power = frame.value<float>(kPower)};
    // Constants 0 and 1 of shaders/ssao/blur.comp.
    const grisaille_constant constants[] = {plugin::specialize(0, size),
                                            plugin::specialize(1, frame.value<uint32_t>(kBlur))};
    const grisaille_binding bindings[] = {
        plugin::uniform(0, frame.viewBlock()), plugin::uniform(1, frame.uniform(settings)),
        plugin::texture(0, frame.attachment(GRISAILLE_VIEW_DEPTH), clamped_),
        plugin::texture(1, raw, clamped_), plugin::image(0, frame.output(0))};
    dispatch(frame, blur_.get(constants), bindings);
  }

  static void dispatch(const plugin::Frame& frame, grisaille_pipeline pipeline,
                       std::span<const grisaille_binding> bindings) {
    frame.dispatch(pipeline, bindings, plugin::groupsFor(frame.width(), kGroup),
                   plugin::groupsFor(frame.height(), kGroup));
  }

  plugin::Host host_;
  plugin::PipelineCache hemisphere_, sphere_, blur_;
  plugin::Sampler clamped_, repeated_;
  plugin::Texture noise_;
  std::optional<uint32_t> noiseSeed_;  // which seed noise_ holds
};

constexpr auto kSsao =
    plugin::effect<Ssao>({.key = "ssao",
                          .label = "Ambient occlusion",
                          .version = "1.0.0",
                          .tooltip = "How much of the sky above each surface nearby geometry hides",
                          .params = kParams,
                          .outputs = kOutputs});

}  // namespace
}  // namespace grisaille::ssao

GRISAILLE_EXPORT_PLUGIN(&grisaille::ssao::kSsao);
