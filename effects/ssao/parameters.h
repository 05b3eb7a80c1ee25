// SPDX-License-Identifier: MIT
// Table of the effect's parameters. The enum Parameter lists them in the same order.
#pragma once

#include "grisaille/effect.hpp"

namespace grisaille::ssao {

enum Parameter {
  kEstimator,
  kRadius,
  kKernelSize,
  kBlurSize,
  kBias,
  kThickness,
  kBacks,
  kResolution,
  kRefine,
  kGuardBand,
  kHistory,
  kIntensity,
  kPower,
  kBounce,
  kAlbedo,
  kSeed,
  kSlices,
  kEdgeSlices,
  kEdgeDenoise,
  kContrast,
  kSampling,
  kRotation,
  kRangeCheck,
  kBlur,
};

enum class Estimator : uint32_t { kSlices = 0, kClassic = 1 };
enum class Backs : uint32_t { kAssumed = 0, kBodies = 1, kDrawn = 2, kPeeled = 3 };
enum class Refine : uint32_t { kNothing = 0, kEdges = 1, kContrasts = 2 };
enum class Bounce : uint32_t { kNone = 0, kAlbedo = 1, kBaseColour = 2 };

enum Output { kAo, kBentNormal, kTint };

constexpr const char* kSamplingKeys[] = {"hemisphere", "sphere"};
constexpr const char* kSamplingLabels[] = {"Hemisphere", "Sphere"};
constexpr const char* kRotationKeys[] = {"noise", "none"};
constexpr const char* kRotationLabels[] = {"4x4 noise", "None"};
constexpr const char* kRangeKeys[] = {"linear", "raw_depth", "none"};
constexpr const char* kRangeLabels[] = {"Linear depth", "Raw depth", "None"};
constexpr const char* kBlurKeys[] = {"box", "edge_aware"};
constexpr const char* kBlurLabels[] = {"Box", "Edge-aware"};

constexpr const char* kEstimatorKeys[] = {"slices", "classic"};
constexpr const char* kEstimatorLabels[] = {"Slices", "Classic"};
constexpr const char* kBacksKeys[] = {"assumed", "bodies", "drawn", "peeled"};
constexpr const char* kBacksLabels[] = {"Assumed", "Mean of the body", "Drawn", "Peeled"};
constexpr const char* kBounceKeys[] = {"none", "albedo", "base_colour"};
constexpr const char* kBounceLabels[] = {"None", "Off the albedo", "Off base colours"};
constexpr const char* kResolutionKeys[] = {"full", "half", "quarter"};
constexpr const char* kResolutionLabels[] = {"Full", "Half", "Quarter"};
constexpr const char* kRefineKeys[] = {"nothing", "edges", "contrasts"};
constexpr const char* kRefineLabels[] = {"Nothing", "Edges", "Edges and contrasts"};

// Parameters that only one estimator uses. `slices` also computes the open directions.
constexpr plugin::UsedWhen kSlicesOnly = {"estimator", static_cast<uint32_t>(Estimator::kSlices)};
constexpr plugin::UsedWhen kContrastsOnly = {"refine", static_cast<uint32_t>(Refine::kContrasts)};
constexpr plugin::UsedWhen kClassicOnly = {"estimator", static_cast<uint32_t>(Estimator::kClassic)};

constexpr grisaille_param_desc kParams[] = {
    plugin::enumParam(
        {.key = "estimator",
         .label = "Estimator",
         .tooltip =
             "Slices: occluded sectors of slices through the view vector, the most accurate; "
             "classic: sample points in a volume",
         .keys = kEstimatorKeys,
         .labels = kEstimatorLabels,
         .defaultValue = 0}),
    plugin::floatParam({.key = "radius",
                        .label = "Radius",
                        .unit = "m",
                        .tooltip = "How far an occluder may be from the surface it darkens",
                        .hardMin = 1e-6,
                        .hardMax = 1e6,
                        .softMin = 0.01,
                        .softMax = 10,
                        .defaultValue = 0.5,
                        .log = true,
                        .sceneLength = true}),
    plugin::intParam({.key = "kernel_size",
                      .label = "Kernel size",
                      .tooltip =
                          "Taps per pixel; cost grows with their number, error falls. Slices: "
                          "on both sides of all slices together, rounded up to the same "
                          "number on each side",
                      .hardMin = 1,
                      .hardMax = 4096,
                      .softMin = 4,
                      .softMax = 128,
                      .defaultValue = 16,
                      .log = true}),
    plugin::intParam(
        {.key = "blur_size",
         .label = "Blur size",
         .unit = "px",
         .tooltip = "Width of the filter that removes noise, in pixels of the picture. "
                    "Slices: width at half height, off up to the width of one computed pixel; "
                    "5, 10 and 15 of those remove the noise pattern exactly. Classic: 4, 8, "
                    "12 and 16 average every rotation, 0 and 1 are off",
         .hardMin = 0,
         .hardMax = 20,
         .softMin = 0,
         .softMax = 20,
         .defaultValue = 10}),
    plugin::floatParam({.key = "bias",
                        .label = "Bias",
                        .unit = "m",
                        .tooltip =
                            "Height over the surface under which nothing occludes; hides the "
                            "facets of coarse meshes, and loses detail",
                        .hardMin = 0,
                        .hardMax = 1e6,
                        .softMin = 0,
                        .softMax = 0.1,
                        .defaultValue = 0,
                        .step = 0.001}),
    plugin::floatParam({.key = "thickness",
                        .label = "Thickness",
                        .tooltip = "Thickness of solid matter behind a visible surface where its "
                                   "back is unknown, in radii",
                        .hardMin = 0,
                        .hardMax = 1e6,
                        .softMin = 0,
                        .softMax = 2,
                        .defaultValue = 1.25,
                        .step = 0.01,
                        .usedWhen = kSlicesOnly}),
    plugin::enumParam({.key = "backs",
                       .label = "Backs",
                       .tooltip =
                           "Where the matter behind a visible surface ends: after the thickness, "
                           "after the mean thickness of its body, or at its back faces, which are "
                           "drawn for it. Peeled draws these, and the next surface behind them, "
                           "which occludes too",
                       .keys = kBacksKeys,
                       .labels = kBacksLabels,
                       .defaultValue = 1,
                       .usedWhen = kSlicesOnly}),
    plugin::enumParam({.key = "resolution",
                       .label = "Resolution",
                       .tooltip = "Computed at every pixel, at one of 2x2 or at one of 4x4",
                       .keys = kResolutionKeys,
                       .labels = kResolutionLabels,
                       .defaultValue = 1,
                       .usedWhen = kSlicesOnly}),
    plugin::enumParam(
        {.key = "refine",
         .label = "Refine",
         .tooltip = "Which pixels are computed at full resolution although the rest is "
                    "not: none, those between surfaces, or also those where occlusion "
                    "changes within a few pixels. They take twice as many slices, with fewer taps "
                    "each. Full resolution ignores it",
         .keys = kRefineKeys,
         .labels = kRefineLabels,
         .defaultValue = 2,
         .usedWhen = kSlicesOnly}),
    plugin::floatParam({.key = "guard_band",
                        .label = "Guard band",
                        .tooltip = "Width of the border drawn beyond the picture, in picture "
                                   "heights; surfaces in it occlude",
                        .hardMin = 0,
                        .hardMax = 1,
                        .softMin = 0,
                        .softMax = 0.25,
                        .defaultValue = 0.07,
                        .step = 0.005,
                        .usedWhen = kSlicesOnly}),
    plugin::intParam({.key = "history",
                      .label = "History",
                      .tooltip = "Number of frames averaged where they saw the same surface; "
                                 "1: no averaging",
                      .hardMin = 1,
                      .hardMax = 256,
                      .softMin = 1,
                      .softMax = 32,
                      .defaultValue = 1,
                      .log = true,
                      .usedWhen = kSlicesOnly}),
    plugin::floatParam({.key = "intensity",
                        .label = "Intensity",
                        .tooltip = "Multiplies the occlusion before it is clamped to 1; 1: as "
                                   "estimated. Classic is too bright below 2",
                        .hardMin = 0,
                        .hardMax = 10,
                        .softMin = 0,
                        .softMax = 3,
                        .defaultValue = 1,
                        .step = 0.05,
                        .look = true}),
    plugin::floatParam({.key = "power",
                        .label = "Power",
                        .tooltip = "Exponent of the visibility; over 1 darkens creases",
                        .hardMin = 0.1,
                        .hardMax = 10,
                        .softMin = 0.5,
                        .softMax = 4,
                        .defaultValue = 1,
                        .step = 0.05,
                        .look = true}),
    plugin::enumParam({.key = "bounce",
                       .label = "Bounced light",
                       .tooltip =
                           "Light that nearby surfaces reflect: none, with one albedo, or with "
                           "the pixel's base colour, which changes only the output tint",
                       .keys = kBounceKeys,
                       .labels = kBounceLabels,
                       .defaultValue = 0,
                       .look = true}),
    plugin::floatParam({.key = "albedo",
                        .label = "Albedo",
                        .tooltip = "Share of light that surfaces reflect",
                        .hardMin = 0,
                        .hardMax = 1,
                        .softMin = 0,
                        .softMax = 1,
                        .defaultValue = 0.8,
                        .step = 0.01,
                        .look = true,
                        .usedWhen = {"bounce", static_cast<uint32_t>(Bounce::kAlbedo)}}),
    plugin::intParam({.key = "seed",
                      .label = "Seed",
                      .tooltip = "Seed of the random slices, or of the sample points and rotations",
                      .hardMin = 0,
                      .hardMax = 65535,
                      .softMin = 0,
                      .softMax = 100,
                      .defaultValue = 0,
                      .advanced = true}),
    plugin::intParam({.key = "slices",
                      .label = "Slices",
                      .tooltip = "Slices that share the taps of a pixel: more of them lower the "
                                 "noise, but find less each",
                      .hardMin = 1,
                      .hardMax = 64,
                      .softMin = 1,
                      .softMax = 16,
                      .defaultValue = 1,
                      .log = true,
                      .advanced = true,
                      .usedWhen = kSlicesOnly}),
    plugin::intParam({.key = "edge_slices",
                      .label = "Edge slices",
                      .tooltip =
                          "Factor on slices and taps at edges and on details a few pixels wide, "
                          "where the denoiser finds few texels to average",
                      .hardMin = 1,
                      .hardMax = 16,
                      .softMin = 1,
                      .softMax = 4,
                      .defaultValue = 1,
                      .advanced = true,
                      .usedWhen = kSlicesOnly}),
    plugin::intParam(
        {.key = "edge_denoise",
         .label = "Edge denoise",
         .unit = "px",
         .tooltip = "Reach of the denoiser along edges, where rows and columns hold "
                    "few pixels of one surface, in pixels of the chosen resolution; 0 and 1: off",
         .hardMin = 0,
         .hardMax = 32,
         .softMin = 0,
         .softMax = 16,
         .defaultValue = 6,
         .advanced = true,
         .usedWhen = kSlicesOnly}),
    plugin::floatParam({.key = "contrast",
                        .label = "Contrast",
                        .tooltip = "Difference of visibility between neighbouring computed pixels "
                                   "from which the pixels between them are refined",
                        .hardMin = 0.01,
                        .hardMax = 1,
                        .softMin = 0.05,
                        .softMax = 0.5,
                        .defaultValue = 0.15,
                        .step = 0.01,
                        .advanced = true,
                        .usedWhen = kContrastsOnly}),
    plugin::enumParam({.key = "sampling",
                       .label = "Sampling",
                       .tooltip =
                           "Where the sample points lie: in the hemisphere over the surface, or "
                           "all around it, which needs no normals and brightens convex edges",
                       .keys = kSamplingKeys,
                       .labels = kSamplingLabels,
                       .defaultValue = 0,
                       .advanced = true,
                       .usedWhen = kClassicOnly}),
    plugin::enumParam({.key = "rotation",
                       .label = "Rotation",
                       .tooltip = "Rotates the kernel from pixel to pixel, so that few points show "
                                  "as noise and not as bands",
                       .keys = kRotationKeys,
                       .labels = kRotationLabels,
                       .defaultValue = 0,
                       .advanced = true,
                       .usedWhen = kClassicOnly}),
    plugin::enumParam(
        {.key = "range_check",
         .label = "Range check",
         .tooltip = "Which depth difference must be below the radius for a surface to occlude; "
                    "raw depth is wrong near and far, none leaves halos",
         .keys = kRangeKeys,
         .labels = kRangeLabels,
         .defaultValue = 0,
         .advanced = true,
         .usedWhen = kClassicOnly}),
    plugin::enumParam({.key = "blur",
                       .label = "Blur",
                       .tooltip =
                           "Box averages across edges; edge-aware leaves out depths more than one "
                           "radius nearer or farther",
                       .keys = kBlurKeys,
                       .labels = kBlurLabels,
                       .defaultValue = 0,
                       .advanced = true,
                       .usedWhen = kClassicOnly}),
};

}  // namespace grisaille::ssao
