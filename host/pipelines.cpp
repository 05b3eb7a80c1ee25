// SPDX-License-Identifier: MIT
#include "host/pipelines.h"

#include <algorithm>

#include "core/effect/instance.h"
#include "core/frame/view_block.h"
#include "core/gpu/null_device.h"
#include "host/attachments.h"
#include "host/pool.h"

namespace grisaille::host {
namespace {

bool alike(std::span<const gpu::Specialization> a, std::span<const gpu::Specialization> b) {
  return std::ranges::equal(
      a, b, [](const auto& x, const auto& y) { return x.id == y.id && x.bits == y.bits; });
}

// Notes the compute pipelines.
class Lister final : public gpu::ForwardingMaker {
 public:
  using ForwardingMaker::ForwardingMaker;

  gpu::ComputePipeline createComputePipeline(const gpu::ComputePipelineDesc& desc) override {
    needed.push_back(
        {std::string(desc.label), desc.shader, {desc.constants.begin(), desc.constants.end()}});
    return ForwardingMaker::createComputePipeline(desc);
  }

  std::vector<NeededPipeline> needed;
};

// Every ray meets a surface: work that waits for rays goes on, and needs its pipelines.
class SurfaceEverywhere final : public effect::RayService {
 public:
  void cast(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits) override {
    for (size_t i = 0; i < rays.size(); ++i) {
      const float* way = rays[i].direction;
      hits[i] = {.kind = GRISAILLE_HIT_SURFACE,
                 .distance = std::min(1.0f, 0.5f * rays[i].reach),
                 .normal = {-way[0], -way[1], -way[2]}};
    }
  }
};

// Time for work that can wait, such as the casting of rays.
constexpr double kPatience = 0.1;  // seconds
// Frames after which an effect creates nothing more.
constexpr uint32_t kSimulated = 3;

// A frame of the simulation.
struct Frame {
  gpu::Commands& commands;
  Attachments& attachments;
  const Textures& textures;
  std::span<const gpu::Texture> made;  // outputs; null: not wanted
  uint32_t layer;
};

void simulate(const effect::Values& values, const objects::View& objects, const Need& need,
              uint32_t reads, const Frame& frame, effect::Instance& instance) {
  scene::Camera camera;
  camera.orthographicHeight = need.orthographic ? 1 : 0;
  const scene::View seen = scene::viewOf(camera, {need.width, need.height});
  const frame::ViewBlock block = frame::viewBlock(seen);
  const grisaille_view view = frame::effectView(seen);
  frame.attachments.record(frame.commands, {}, {}, frame.textures, frame.layer);
  effect::FrameInputs inputs;
  inputs.commands = &frame.commands;
  inputs.width = need.width;
  inputs.height = need.height;
  inputs.view = &view;
  inputs.viewBlock = frame.commands.uniform(std::as_bytes(std::span(&block, 1)));
  inputs.values = values.all();
  inputs.objects = objects;
  SurfaceEverywhere rays;
  inputs.services.rays = &rays;
  inputs.patience = kPatience;
  for (size_t i = 0; i < inputs.attachments.size(); ++i) {
    if ((reads & GRISAILLE_READS(i)) == 0) continue;
    inputs.attachments[i] = frame.attachments.get(static_cast<grisaille_attachment>(i));
  }
  inputs.outputs = frame.made;
  inputs.named = frame.attachments.named();
  instance.record(inputs);
  if (!need.copies) return;
  // The blocks that place the copies.
  const SourceBlock place = {};
  frame.commands.uniform(std::as_bytes(std::span(&place, 1)));
}

}  // namespace

gpu::TextureDesc outputDesc(const grisaille_output_desc& output, uint32_t width, uint32_t height,
                            uint32_t layers) {
  return {.label = output.key,
          .format = effect::formatOf(output.format),
          .width = width,
          .height = height,
          .layers = layers,
          .usage = gpu::TextureUsage::kStorage | gpu::TextureUsage::kSampled};
}

gpu::ComputePipeline Pipelines::createComputePipeline(const gpu::ComputePipelineDesc& desc) {
  const auto found = std::ranges::find_if(shared_, [&](const Shared& one) {
    return one.shader == desc.shader && alike(one.constants, desc.constants);
  });
  if (found != shared_.end()) {
    ++found->users;
    return found->pipeline;
  }
  if (recording_ != nullptr) {
    log_.write(GRISAILLE_HOST_INFO,
               fmt::format("{} compiles '{}' in a recording: call grisaille_host_effect_prepare() "
                           "before",
                           recording_, desc.label));
  }
  shared_.reserve(shared_.size() + 1);
  Shared one = {.shader = desc.shader,
                .constants = {desc.constants.begin(), desc.constants.end()},
                .pipeline = {},
                .users = 1};
  one.pipeline = ForwardingMaker::createComputePipeline(desc);
  shared_.push_back(std::move(one));
  return shared_.back().pipeline;
}

void Pipelines::destroy(gpu::ComputePipeline pipeline) {
  if (!pipeline) return;
  const auto found = std::ranges::find(shared_, pipeline, &Shared::pipeline);
  if (--found->users > 0) return;
  ForwardingMaker::destroy(pipeline);
  shared_.erase(found);
}

Needed neededOf(const gpu::HostDevice& device, const effect::Values& values,
                const objects::View& objects, const Need& need) {
  const std::unique_ptr<gpu::NullDevice> null = gpu::makeNullDevice();
  Lister lister(*null);
  Needed needed;
  Pool pool(lister, device, 0);
  Kernels kernels(*null);
  const auto given = [&](gpu::Format format) {
    return null->createTexture({.label = "given",
                                .format = format,
                                .width = need.width,
                                .height = need.height,
                                .layers = need.layers,
                                .usage = gpu::TextureUsage::kSampled});
  };
  // The library computes the others from depth.
  constexpr uint32_t kOptional =
      GRISAILLE_READS(GRISAILLE_NEXT_DEPTH) | GRISAILLE_READS(GRISAILLE_THICKNESS) |
      GRISAILLE_READS(GRISAILLE_MOTION) | GRISAILLE_READS(GRISAILLE_NORMAL) |
      GRISAILLE_READS(GRISAILLE_BACK_DEPTH);
  const uint32_t reads = values.effect().reads(values.all().data(), need.wanted);
  Textures textures;
  const uint32_t present = need.inputs | values.effect().desc->needs | ~kOptional;
  for (size_t i = 0; i < textures.attachments.size(); ++i) {
    if ((reads & present & GRISAILLE_READS(i)) == 0 && i != GRISAILLE_DEPTH) continue;
    textures.attachments[i] = given(Attachments::formatOf(static_cast<grisaille_attachment>(i)));
  }
  for (const grisaille_input_desc& input : values.effect().inputs()) {
    const bool required = (input.flags & GRISAILLE_INPUT_REQUIRED) != 0;
    textures.named[textures.namedCount++] =
        required ? given(gpu::Format::kRgba16Float) : gpu::Texture{};
  }
  const auto outputs = values.effect().outputs();
  std::vector<gpu::Texture> shown, made(outputs.size());
  for (size_t i = 0; i < outputs.size(); ++i) {
    if ((need.wanted & (1u << i)) == 0) continue;
    shown.push_back(
        pool.createTexture(outputDesc(outputs[i], need.width, need.height, need.layers)));
    made[i] = shown.back();
  }
  {
    Attachments attachments(pool, kernels);
    attachments.resize(need.width, need.height);
    std::vector<std::unique_ptr<effect::Instance>> instances;
    for (uint32_t i = 0; i < need.layers; ++i) {
      instances.push_back(std::make_unique<effect::Instance>(pool, values.effect()));
    }
    PooledCommands commands(pool);
    for (uint32_t frame = 0; frame < kSimulated; ++frame) {
      pool.begin(need.width, need.height);
      attachments.prepare(reads, textures);
      commands.wrap(null->begin());
      for (uint32_t layer = 0; layer < need.layers; ++layer) {
        if (need.copies) {
          for (size_t i = 0; i < outputs.size(); ++i) {
            if ((need.wanted & (1u << i)) == 0) continue;
            made[i] = pool.transient(outputDesc(outputs[i], need.width, need.height, 1));
          }
        }
        simulate(values, objects, need, reads, {commands, attachments, textures, made, layer},
                 *instances[layer]);
        pool.takeBack();
      }
      null->submit();
      pool.end();
      needed.memory.hostBytes = std::max(needed.memory.hostBytes, commands.uploaded());
    }
    needed.memory.deviceBytes = pool.use().deviceBytes;
    needed.memory.allocations = pool.use().allocations;
    for (const auto& instance : instances) instance->end();
  }
  for (const gpu::Texture texture : shown) pool.destroy(texture);
  needed.pipelines = std::move(lister.needed);
  return needed;
}

}  // namespace grisaille::host
