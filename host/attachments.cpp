// SPDX-License-Identifier: MIT
#include "host/attachments.h"

#include <algorithm>
#include <utility>

#include "shaders/host_clip_depth.h"
#include "shaders/host_depth.h"
#include "shaders/host_facet_normal.h"
#include "shaders/host_normal.h"

namespace grisaille::host {
namespace {

#include "shaders/host_turns.h"

GRISAILLE_CHECK_BLOCK_host_depth_Source(SourceBlock);

struct KernelRow {
  const char* label;
  const grisaille_shader* shader;
};
constexpr KernelRow kRows[Kernels::kKernels] = {
    {"host depth", &grisaille_shader_host_depth},
    {"host clip depth", &grisaille_shader_host_clip_depth},
    {"host normal", &grisaille_shader_host_normal},
    {"host facet normal", &grisaille_shader_host_facet_normal}};

// Formats of the attachments, by grisaille_attachment. Clip depth has a colour format, because
// storage images need one; shaders that sample it see no difference.
constexpr gpu::Format kFormats[GRISAILLE_ATTACHMENT_COUNT] = {
    gpu::Format::kR32Float,    gpu::Format::kR32Float,    gpu::Format::kRgba16Float,
    gpu::Format::kRgba16Float, gpu::Format::kRgba16Float, gpu::Format::kR32Float,
    gpu::Format::kRgba16Float, gpu::Format::kR32Float,    gpu::Format::kR32Float};
constexpr const char* kLabels[GRISAILLE_ATTACHMENT_COUNT] = {
    "clip depth", "depth",  "normal",    "base_colour", "facet_normal",
    "back_depth", "motion", "thickness", "next_depth"};

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
  for (const gpu::ComputePipeline pipeline : turns_) device_.destroy(pipeline);
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

gpu::ComputePipeline Kernels::turn(gpu::Format format) {
  gpu::ComputePipeline& pipeline = turns_[static_cast<size_t>(format)];
  if (!pipeline) {
    const auto row = std::ranges::find(kTurns, format, &Turn::format);
    pipeline = device_.createComputePipeline(
        {.label = "host turn", .shader = row->shader, .constants = {}});
  }
  return pipeline;
}

gpu::Sampler Kernels::nearest() {
  if (!nearest_) nearest_ = device_.createSampler({.label = "host nearest"});
  return nearest_;
}

void Attachments::drop() {
  for (gpu::Texture& target : targets_) {
    device_.destroy(target);
    target = {};
  }
}

void Attachments::resize(uint32_t width, uint32_t height) {
  drop();
  width_ = width;
  height_ = height;
}

gpu::Format Attachments::formatOf(grisaille_attachment attachment) {
  return kFormats[attachment];
}

void Attachments::prepare(Kernels& kernels, uint32_t reads, bool normalsGiven, bool thickness) {
  kernels.nearest();
  kernels.get(Kernels::kDepth);
  if ((reads & GRISAILLE_READS(GRISAILLE_DEPTH)) != 0) kernels.get(Kernels::kClipDepth);
  const bool facets = (reads & GRISAILLE_READS(GRISAILLE_FACET_NORMAL)) != 0;
  const bool normals = (reads & GRISAILLE_READS(GRISAILLE_NORMAL)) != 0;
  if (normals && normalsGiven) kernels.get(Kernels::kNormal);
  if (facets || (normals && !normalsGiven)) kernels.get(Kernels::kFacetNormal);
  if ((reads & GRISAILLE_READS(GRISAILLE_BASE_COLOUR)) != 0) {
    kernels.turn(kFormats[GRISAILLE_BASE_COLOUR]);
  }
  if (thickness) kernels.turn(kFormats[GRISAILLE_THICKNESS]);
}

void Attachments::prepare(uint32_t reads, const Textures& textures) {
  prepare(kernels_, reads, bool{textures.normal}, bool{textures.thickness});
  reads |= GRISAILLE_READS(GRISAILLE_VIEW_DEPTH);  // all other attachments are computed with it
  reads &= ~GRISAILLE_READS(GRISAILLE_MOTION);     // hosts give none
  if (!textures.thickness) reads &= ~GRISAILLE_READS(GRISAILLE_THICKNESS);
  if (!textures.nextDepth) reads &= ~GRISAILLE_READS(GRISAILLE_NEXT_DEPTH);
  for (size_t i = 0; i < targets_.size(); ++i) {
    const bool read = (reads & GRISAILLE_READS(i)) != 0;
    if (read && !targets_[i]) {
      targets_[i] = device_.createTexture({.label = kLabels[i],
                                           .format = kFormats[i],
                                           .width = width_,
                                           .height = height_,
                                           .usage = kComputed});
    } else if (!read && targets_[i]) {
      device_.destroy(std::exchange(targets_[i], {}));
    }
  }
}

void Attachments::dispatch(gpu::Commands& commands, std::string_view label,
                           gpu::ComputePipeline pipeline, gpu::BufferRange source,
                           std::array<gpu::Texture, 2> from, gpu::Texture to) {
  const std::array bindings = {gpu::uniformBinding(0, source), gpu::imageBinding(0, to),
                               gpu::textureBinding(0, {.texture = from[0]}, kernels_.nearest()),
                               gpu::textureBinding(1, {.texture = from[1]}, kernels_.nearest())};
  commands.beginPass(label);
  commands.dispatch({.pipeline = pipeline,
                     .bindings = std::span(bindings).first(from[1] ? 4 : 3),
                     .groups = {groups(width_), groups(height_), 1}});
  commands.endPass();
}

void Attachments::record(gpu::Commands& commands, const SourceBlock& source,
                         const Textures& textures) {
  const gpu::BufferRange block = commands.uniform(std::as_bytes(std::span(&source, 1)));
  const gpu::Texture depth = targets_[GRISAILLE_VIEW_DEPTH];
  dispatch(commands, "host/depth", kernels_.get(Kernels::kDepth), block, {textures.depth, {}},
           depth);
  if (const gpu::Texture back = targets_[GRISAILLE_BACK_DEPTH]) {
    SourceBlock behind = source;
    if (!textures.backDepth) behind.mode.x = kNothing;
    dispatch(commands, "host/back depth", kernels_.get(Kernels::kDepth),
             commands.uniform(std::as_bytes(std::span(&behind, 1))),
             {textures.backDepth ? textures.backDepth : textures.depth, {}}, back);
  }
  if (const gpu::Texture next = targets_[GRISAILLE_NEXT_DEPTH]) {
    dispatch(commands, "host/next depth", kernels_.get(Kernels::kDepth), block,
             {textures.nextDepth, {}}, next);
  }
  if (const gpu::Texture clip = targets_[GRISAILLE_DEPTH]) {
    dispatch(commands, "host/clip depth", kernels_.get(Kernels::kClipDepth), block, {depth, {}},
             clip);
  }
  const gpu::Texture normal = targets_[GRISAILLE_NORMAL], facet = targets_[GRISAILLE_FACET_NORMAL];
  if (normal && textures.normal) {
    dispatch(commands, "host/normal", kernels_.get(Kernels::kNormal), block,
             {textures.normal, depth}, normal);
  }
  if (facet || (normal && !textures.normal)) {
    const auto fill = [&](gpu::Texture target) {
      dispatch(commands, "host/facet normal", kernels_.get(Kernels::kFacetNormal), block,
               {depth, {}}, target);
    };
    if (facet) fill(facet);
    if (normal && !textures.normal) fill(normal);
  }
  if (const gpu::Texture colour = targets_[GRISAILLE_BASE_COLOUR]) {
    copy(commands, block, textures.baseColour, colour, kFormats[GRISAILLE_BASE_COLOUR],
         "host/base colour");
  }
  if (const gpu::Texture thickness = targets_[GRISAILLE_THICKNESS]) {
    copy(commands, block, textures.thickness, thickness, kFormats[GRISAILLE_THICKNESS],
         "host/thickness");
  }
}

void Attachments::copy(gpu::Commands& commands, gpu::BufferRange source, gpu::Texture from,
                       gpu::Texture to, gpu::Format format, std::string_view label) {
  dispatch(commands, label, kernels_.turn(format), source, {from, {}}, to);
}

}  // namespace grisaille::host
