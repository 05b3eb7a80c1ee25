// SPDX-License-Identifier: MIT
#include "host/pipelines.h"

#include <algorithm>

#include "core/effect/instance.h"
#include "core/frame/view_block.h"
#include "core/gpu/null_device.h"
#include "host/attachments.h"

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

}  // namespace

gpu::ComputePipeline Pipelines::createComputePipeline(const gpu::ComputePipelineDesc& desc) {
  const auto found = std::ranges::find_if(shared_, [&](const Shared& one) {
    return one.shader == desc.shader && alike(one.constants, desc.constants);
  });
  if (found != shared_.end()) {
    ++found->users;
    return found->pipeline;
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

std::vector<NeededPipeline> pipelinesOf(const effect::Values& values, const objects::View& objects,
                                        const Need& need) {
  const std::unique_ptr<gpu::NullDevice> device = gpu::makeNullDevice();
  Lister lister(*device);
  const auto texture = [&](gpu::Format format) {
    return device->createTexture(
        {.label = "any",
         .format = format,
         .width = need.width,
         .height = need.height,
         .usage = gpu::TextureUsage::kStorage | gpu::TextureUsage::kSampled});
  };
  scene::Camera camera;
  camera.orthographicHeight = need.orthographic ? 1 : 0;
  const scene::View seen = scene::viewOf(camera, {need.width, need.height});
  const frame::ViewBlock block = frame::viewBlock(seen);
  const grisaille_view view = frame::effectView(seen);
  effect::FrameInputs inputs;
  inputs.width = need.width;
  inputs.height = need.height;
  inputs.view = &view;
  inputs.values = values.all();
  inputs.objects = objects;
  SurfaceEverywhere rays;
  inputs.services.rays = &rays;
  inputs.patience = kPatience;
  const uint32_t reads = values.effect().reads(values.all().data(), need.wanted);
  for (size_t i = 0; i < inputs.attachments.size(); ++i) {
    if ((reads & need.attachments & GRISAILLE_READS(i)) == 0) continue;
    inputs.attachments[i] = texture(Attachments::formatOf(static_cast<grisaille_attachment>(i)));
  }
  std::vector<gpu::Texture> outputs;
  for (const grisaille_output_desc& output : values.effect().outputs()) {
    const bool wanted = (need.wanted & (1u << outputs.size())) != 0;
    outputs.push_back(wanted ? texture(effect::formatOf(output.format)) : gpu::Texture{});
  }
  inputs.outputs = outputs;
  std::vector<gpu::Texture> named;
  for (const grisaille_input_desc& input : values.effect().inputs()) {
    const bool required = (input.flags & GRISAILLE_INPUT_REQUIRED) != 0;
    named.push_back(required ? texture(gpu::Format::kRgba16Float) : gpu::Texture{});
  }
  inputs.named = named;
  effect::Instance instance(lister, values.effect());
  gpu::Commands& commands = device->begin();
  inputs.commands = &commands;
  inputs.viewBlock = commands.uniform(std::as_bytes(std::span(&block, 1)));
  instance.record(inputs);
  device->submit();
  instance.end();
  return std::move(lister.needed);
}

}  // namespace grisaille::host
