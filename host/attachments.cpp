// SPDX-License-Identifier: MIT
#include "host/attachments.h"

#include <algorithm>
#include <utility>

#include "shaders/host_clip_depth.h"
#include "shaders/host_depth.h"
#include "shaders/host_facet_normal.h"
#include "shaders/host_motion.h"
#include "shaders/host_normal.h"

namespace grisaille::host {
namespace {

#include "shaders/host_turns.h"

GRISAILLE_CHECK_BLOCK_host_depth_Source(SourceBlock);
GRISAILLE_CHECK_BLOCK_host_motion_Then(MotionBlock);

struct KernelRow {
  const char* label;
  const grisaille_shader* shader;
};
constexpr KernelRow kRows[Kernels::kKernels] = {
    {"host depth", &grisaille_shader_host_depth},
    {"host clip depth", &grisaille_shader_host_clip_depth},
    {"host normal", &grisaille_shader_host_normal},
    {"host facet normal", &grisaille_shader_host_facet_normal},
    {"host motion", &grisaille_shader_host_motion}};

// Formats of the attachments, by grisaille_attachment. Clip depth has a colour format, because
// storage images need one; shaders that sample it see no difference.
constexpr gpu::Format kFormats[GRISAILLE_ATTACHMENT_COUNT] = {
    gpu::Format::kR32Float,    gpu::Format::kR32Float,    gpu::Format::kRgba16Float,
    gpu::Format::kRgba16Float, gpu::Format::kRgba16Float, gpu::Format::kR32Float,
    gpu::Format::kRgba16Float, gpu::Format::kR32Float,    gpu::Format::kR32Float,
    gpu::Format::kRgba16Float};
constexpr const char* kLabels[GRISAILLE_ATTACHMENT_COUNT] = {
    "clip depth", "depth",  "normal",    "base_colour", "facet_normal",
    "back_depth", "motion", "thickness", "next_depth",  "colour"};

// Attachments that are copies of the host's textures, with their passes.
struct Copied {
  grisaille_attachment attachment;
  const char* pass;
};
constexpr Copied kCopied[] = {{GRISAILLE_BASE_COLOUR, "host/base colour"},
                              {GRISAILLE_THICKNESS, "host/thickness"},
                              {GRISAILLE_COLOUR, "host/colour"}};

bool has(uint32_t attachments, grisaille_attachment one) {
  return (attachments & GRISAILLE_READS(one)) != 0;
}

// Format of the inputs that an effect reads by name.
constexpr gpu::Format kNamedFormat = gpu::Format::kRgba16Float;

// Not a grisaille_host_depth: the shader writes sky everywhere.
constexpr int kNothing = -1;

constexpr auto kComputed = gpu::TextureUsage::kStorage | gpu::TextureUsage::kSampled;

uint32_t groups(uint32_t pixels) {
  constexpr uint32_t kGroup = 8;  // threads per side of a workgroup, in all shaders of shaders/host
  return (pixels + kGroup - 1) / kGroup;
}

}  // namespace

Kernels::~Kernels() {
  for (const gpu::ComputePipeline pipeline : kernels_) device_.destroy(pipeline);
  for (const auto& ways : turns_) {
    for (const gpu::ComputePipeline pipeline : ways) device_.destroy(pipeline);
  }
  device_.destroy(nearest_);
}

gpu::ComputePipeline Kernels::get(Kernel kernel) {
  gpu::ComputePipeline& pipeline = kernels_[kernel];
  if (!pipeline) {
    pipeline = device_.createComputePipeline(
        {.label = kRows[kernel].label, .shader = kRows[kernel].shader, .constants = {}});
  }
  return pipeline;
}

gpu::ComputePipeline Kernels::turn(gpu::Format format, Way way) {
  gpu::ComputePipeline& pipeline = turns_[static_cast<size_t>(format)][way];
  if (!pipeline) {
    const auto row = std::ranges::find(kTurns, format, &Turn::format);
    const gpu::Specialization out = {.id = 0, .bits = way == kOut ? 1u : 0u};
    pipeline = device_.createComputePipeline(
        {.label = "host turn", .shader = row->shader, .constants = {&out, 1}});
  }
  return pipeline;
}

gpu::Sampler Kernels::nearest() {
  if (!nearest_) nearest_ = device_.createSampler({.label = "host nearest"});
  return nearest_;
}

void Attachments::drop() {
  for (gpu::Texture& target : targets_) device_.destroy(std::exchange(target, {}));
  for (gpu::Texture& target : named_) device_.destroy(std::exchange(target, {}));
}

void Attachments::resize(uint32_t width, uint32_t height) {
  if (width == width_ && height == height_) return;
  drop();
  width_ = width;
  height_ = height;
}

gpu::Format Attachments::formatOf(grisaille_attachment attachment) {
  return kFormats[attachment];
}

void Attachments::prepare(Kernels& kernels, uint32_t reads, uint32_t given, bool named) {
  kernels.nearest();
  kernels.get(Kernels::kDepth);
  if (has(reads, GRISAILLE_DEPTH)) kernels.get(Kernels::kClipDepth);
  const bool normals = has(reads, GRISAILLE_NORMAL), normalsGiven = has(given, GRISAILLE_NORMAL);
  if (normals && normalsGiven) kernels.get(Kernels::kNormal);
  if (has(reads, GRISAILLE_FACET_NORMAL) || (normals && !normalsGiven)) {
    kernels.get(Kernels::kFacetNormal);
  }
  for (const Copied& one : kCopied) {
    if (has(reads & given, one.attachment)) kernels.turn(kFormats[one.attachment], Kernels::kIn);
  }
  if (has(reads & given, GRISAILLE_MOTION)) kernels.get(Kernels::kMotion);
  if (named) kernels.turn(kNamedFormat, Kernels::kIn);
}

void Attachments::fit(gpu::Texture& target, bool wanted, const char* label, gpu::Format format) {
  if (wanted && !target) {
    target = device_.createTexture(
        {.label = label, .format = format, .width = width_, .height = height_, .usage = kComputed});
  } else if (!wanted && target) {
    device_.destroy(std::exchange(target, {}));
  }
}

void Attachments::prepare(uint32_t reads, const Textures& textures) {
  // Attachments that an effect does without if the host has no texture for them.
  constexpr uint32_t kOptional = GRISAILLE_READS(GRISAILLE_THICKNESS) |
                                 GRISAILLE_READS(GRISAILLE_NEXT_DEPTH) |
                                 GRISAILLE_READS(GRISAILLE_MOTION);
  uint32_t given = 0;
  for (size_t i = 0; i < textures.attachments.size(); ++i) {
    if (textures.attachments[i]) given |= GRISAILLE_READS(i);
  }
  const auto named = std::span(textures.named).first(textures.namedCount);
  prepare(kernels_, reads, given,
          std::ranges::any_of(named, [](gpu::Texture texture) { return bool{texture}; }));
  reads |= GRISAILLE_READS(GRISAILLE_VIEW_DEPTH);  // all other attachments are computed with it
  reads &= given | ~kOptional;
  for (size_t i = 0; i < targets_.size(); ++i) {
    fit(targets_[i], (reads & GRISAILLE_READS(i)) != 0, kLabels[i], kFormats[i]);
  }
  namedCount_ = named.size();
  for (size_t i = 0; i < named.size(); ++i) fit(named_[i], bool{named[i]}, "input", kNamedFormat);
}

void Attachments::dispatch(gpu::Commands& commands, std::string_view label,
                           gpu::ComputePipeline pipeline, gpu::BufferRange source,
                           std::array<Layer, 2> from, Layer to, gpu::BufferRange second) {
  const auto viewOf = [](const Layer& one) {
    return gpu::TextureView{
        .texture = one.texture, .mip = 0, .mipCount = 1, .layer = one.layer, .layerCount = 1};
  };
  gpu::Binding image = gpu::imageBinding(0, to.texture);
  image.view = viewOf(to);
  std::array<gpu::Binding, 5> bindings = {
      gpu::uniformBinding(0, source), image,
      gpu::textureBinding(0, viewOf(from[0]), kernels_.nearest())};
  size_t count = 3;
  if (from[1].texture) {
    bindings[count++] = gpu::textureBinding(1, viewOf(from[1]), kernels_.nearest());
  }
  if (second.buffer) bindings[count++] = gpu::uniformBinding(1, second);
  commands.beginPass(label);
  commands.dispatch({.pipeline = pipeline,
                     .bindings = std::span(bindings).first(count),
                     .groups = {groups(width_), groups(height_), 1}});
  commands.endPass();
}

void Attachments::record(gpu::Commands& commands, const SourceBlock& source,
                         const MotionBlock& motion, const Textures& textures, uint32_t layer) {
  const auto given = [&](grisaille_attachment one) {
    return Layer{.texture = textures.attachments[one], .layer = layer};
  };
  const gpu::BufferRange block = commands.uniform(std::as_bytes(std::span(&source, 1)));
  const Layer depth = {.texture = targets_[GRISAILLE_VIEW_DEPTH]};
  dispatch(commands, "host/depth", kernels_.get(Kernels::kDepth), block,
           {given(GRISAILLE_DEPTH), {}}, depth);
  if (const gpu::Texture back = targets_[GRISAILLE_BACK_DEPTH]) {
    SourceBlock behind = source;
    Layer from = given(GRISAILLE_BACK_DEPTH);
    if (!from.texture) {
      behind.mode.x = kNothing;
      from = given(GRISAILLE_DEPTH);
    }
    dispatch(commands, "host/back depth", kernels_.get(Kernels::kDepth),
             commands.uniform(std::as_bytes(std::span(&behind, 1))), {from, {}}, {back});
  }
  if (const gpu::Texture next = targets_[GRISAILLE_NEXT_DEPTH]) {
    dispatch(commands, "host/next depth", kernels_.get(Kernels::kDepth), block,
             {given(GRISAILLE_NEXT_DEPTH), {}}, {next});
  }
  if (const gpu::Texture clip = targets_[GRISAILLE_DEPTH]) {
    dispatch(commands, "host/clip depth", kernels_.get(Kernels::kClipDepth), block, {depth, {}},
             {clip});
  }
  recordNormals(commands, block, given(GRISAILLE_NORMAL));
  if (const gpu::Texture to = targets_[GRISAILLE_MOTION]) {
    dispatch(commands, "host/motion", kernels_.get(Kernels::kMotion), block,
             {given(GRISAILLE_MOTION), depth}, {to},
             commands.uniform(std::as_bytes(std::span(&motion, 1))));
  }
  for (const Copied& one : kCopied) {
    const gpu::Texture to = targets_[one.attachment];
    if (!to) continue;
    dispatch(commands, one.pass, kernels_.turn(kFormats[one.attachment], Kernels::kIn), block,
             {given(one.attachment), {}}, {to});
  }
  for (size_t i = 0; i < namedCount_; ++i) {
    if (!named_[i]) continue;
    dispatch(commands, "host/input", kernels_.turn(kNamedFormat, Kernels::kIn), block,
             {Layer{.texture = textures.named[i], .layer = layer}, {}}, {named_[i]});
  }
}

// `normals`: the host's; no texture: facet normals stand for them.
void Attachments::recordNormals(gpu::Commands& commands, gpu::BufferRange source, Layer normals) {
  const Layer depth = {.texture = targets_[GRISAILLE_VIEW_DEPTH]};
  const gpu::Texture normal = targets_[GRISAILLE_NORMAL], facet = targets_[GRISAILLE_FACET_NORMAL];
  const bool given = bool{normals.texture};
  if (normal && given) {
    dispatch(commands, "host/normal", kernels_.get(Kernels::kNormal), source, {normals, depth},
             {normal});
  }
  for (const gpu::Texture target : {facet, given ? gpu::Texture{} : normal}) {
    if (!target) continue;
    dispatch(commands, "host/facet normal", kernels_.get(Kernels::kFacetNormal), source,
             {depth, {}}, {target});
  }
}

void Attachments::copyOut(gpu::Commands& commands, gpu::BufferRange source, gpu::Texture from,
                          gpu::Texture to, uint32_t layer, gpu::Format format) {
  dispatch(commands, "host/turn", kernels_.turn(format, Kernels::kOut), source,
           {Layer{.texture = from}, {}}, {.texture = to, .layer = layer});
}

}  // namespace grisaille::host
