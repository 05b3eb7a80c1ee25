// SPDX-License-Identifier: MIT
#include "core/frame/renderer.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/nearest.h"
#include "core/frame/frame_plan.h"
#include "core/frame/scene_attachments.h"
#include "core/frame/texture_image.h"
#include "core/frame/view_block.h"

namespace grisaille::frame {
namespace {

// Target of clip depth, which is not an output.
constexpr const char* kClipDepth = "clip depth";
// Prefix of the targets with a guard band.
constexpr const char* kGuardedPrefix = "guarded ";

constexpr auto kDrawn = gpu::TextureUsage::kTarget | gpu::TextureUsage::kSampled;
constexpr auto kComputed = gpu::TextureUsage::kStorage | gpu::TextureUsage::kSampled;

// The target of an attachment.
const char* targetOf(grisaille_attachment attachment) {
  const auto found =
      std::ranges::find(kAttachmentOutputs, attachment, &AttachmentOutput::attachment);
  return found == std::end(kAttachmentOutputs) ? kClipDepth : found->name;
}

}  // namespace

std::vector<std::string> outputNames(std::span<const effect::Effect* const> effects) {
  std::vector<std::string> all = {kColor};
  for (const AttachmentOutput& output : kAttachmentOutputs) all.emplace_back(output.name);
  for (const effect::Effect* effect : effects) {
    for (const grisaille_output_desc& output : effect->outputs()) {
      if (std::find(all.begin(), all.end(), output.key) == all.end()) all.emplace_back(output.key);
      all.push_back(targetName(*effect, output));
    }
  }
  return all;
}

void checkOutput(std::string_view name, std::span<const effect::Effect* const> effects) {
  const std::vector<std::string> all = outputNames(effects);
  if (std::find(all.begin(), all.end(), name) != all.end()) return;
  const std::string near = nearest(name, all);
  throw Error(ErrorId::kOutputUnknown, "there is no output '{}'{}; there are {}", name,
              near.empty() ? "" : fmt::format(", did you mean '{}'?", near), fmt::join(all, ", "));
}

image::Transfer transferOf(std::string_view output) {
  const std::string_view key = output.substr(output.find('.') + 1);  // without the effect
  if (key == "normal" || key.ends_with("_normal")) return image::Transfer::kSigned;
  return output == kColor || output == targetOf(GRISAILLE_BASE_COLOUR) ? image::Transfer::kColour
                                                                       : image::Transfer::kData;
}

// One set of attachments: of the picture's size, or with the guard band around it.
struct Renderer::SceneView {
  scene::View view;
  uint32_t guard;        // pixels on each side
  uint32_t attachments;  // of GRISAILLE_READS
  gpu::BufferRange block;
  std::string prefix;  // of the names of targets

  bool reads(grisaille_attachment attachment) const {
    return (attachments & GRISAILLE_READS(attachment)) != 0;
  }
};

Renderer::Renderer(gpu::Device& device, const scene::Scene& scene, trace::SceneMatter* matter)
    : device_(device),
      scene_(std::make_unique<SceneAttachments>(device, scene, matter)),
      source_(*scene_),
      compositor_(device) {}

Renderer::Renderer(gpu::Device& device, AttachmentSource& source)
    : device_(device), source_(source), compositor_(device) {}

Renderer::~Renderer() {
  for (const auto& [name, slot] : targets_) device_.destroy(slot.texture);
}

void Renderer::render(const FrameDesc& desc) {
  scene::validate(desc.camera);
  std::vector<const effect::Effect*> effects;
  for (const effect::Selection::Entry* entry : activeOf(desc)) effects.push_back(&entry->effect());
  for (const std::string& name : desc.outputs) checkOutput(name, effects);

  FramePlan plan(desc, source_, jitters_);
  if (wants(desc, targetOf(GRISAILLE_MOTION)) && !source_.hasMotion()) {
    throw Error(ErrorId::kPictureMissing, "motion is needed, but no picture has any");
  }
  if (wants(desc, targetOf(GRISAILLE_THICKNESS)) && !source_.hasThickness()) {
    throw Error(ErrorId::kPictureMissing, "thickness is needed, but no picture has any");
  }
  if (plan.readsMotion()) plan.then = before_.cameraFor(plan.motionReaders, source_);
  if (desc.chain != nullptr) desc.chain->create();
  for (auto& [name, slot] : targets_) slot.used = false;
  outputs_.clear();
  report_ = {};
  leftOut_ = plan.leftOut;
  depth_ = {};
  opaque_ = desc.background.a == 1;
  gpu::Commands& commands = device_.begin();
  try {
    record(commands, desc, plan);
  } catch (...) {
    device_.abandon();
    throw;
  }
  device_.submit();
  if (plan.jitter != glm::dvec2(0)) ++jitters_;
  const bool guarded = plan.attachments == 0;
  depth_ = {find((guarded ? kGuardedPrefix : "") + std::string(kClipDepth)),
            guarded ? plan.guard : 0};
  before_.add(plan.camera, plan.motionReaders, source_);
  source_.finish(plan.readsMotion());
  std::erase_if(targets_, [&](const auto& entry) {
    if (!entry.second.used) device_.destroy(entry.second.texture);
    return !entry.second.used;
  });
}

void Renderer::record(gpu::Commands& commands, const FrameDesc& desc, const FramePlan& plan) {
  scene::View seen = scene::viewOf(plan.camera, {desc.width, desc.height});
  seen.jitter = plan.jitter;
  const auto sceneView = [&](uint32_t guard, uint32_t attachments, const char* prefix) {
    const ViewBlock block = viewBlock(seen, guard);
    return SceneView{.view = scene::widened(seen, guard),
                     .guard = guard,
                     .attachments = attachments,
                     .block = commands.uniform(std::as_bytes(std::span(&block, 1))),
                     .prefix = prefix};
  };
  const SceneView picture = sceneView(0, plan.attachments, "");  // its view is `seen`
  const SceneView guarded =
      plan.guard > 0 ? sceneView(plan.guard, plan.guarded, kGuardedPrefix) : picture;
  if (plan.attachments != 0) recordAttachments(commands, desc, plan, picture);
  if (plan.guarded != 0) recordAttachments(commands, desc, plan, guarded);
  recordEffects(commands, desc, plan, picture, guarded);
  for (const std::string& name : desc.outputs) outputs_.try_emplace(name, name);
}

void Renderer::recordAttachments(gpu::Commands& commands, const FrameDesc& desc,
                                 const FramePlan& plan, const SceneView& view) {
  const auto attachment = [&](grisaille_attachment one, gpu::Format format,
                              gpu::TextureUsage usage) {
    return target(view.prefix + targetOf(one), format, usage, view.view.size.x, view.view.size.y);
  };
  AttachmentTargets targets;
  targets.depth = attachment(GRISAILLE_DEPTH, gpu::Format::kD32Float, kDrawn);
  const bool thickness = view.reads(GRISAILLE_THICKNESS) && source_.hasThickness();
  if (view.reads(GRISAILLE_NORMAL) || thickness) {
    targets.normal = attachment(GRISAILLE_NORMAL, gpu::Format::kRgba16Float, kDrawn);
  }
  if (view.reads(GRISAILLE_BASE_COLOUR)) {
    targets.baseColour = attachment(GRISAILLE_BASE_COLOUR, gpu::Format::kRgba8Srgb, kDrawn);
  }
  if (view.reads(GRISAILLE_FACET_NORMAL)) {
    targets.facetNormal = attachment(GRISAILLE_FACET_NORMAL, gpu::Format::kRgba16Float, kDrawn);
  }
  if (view.reads(GRISAILLE_VIEW_DEPTH)) {
    targets.viewDepth = attachment(GRISAILLE_VIEW_DEPTH, gpu::Format::kR32Float, kComputed);
  }
  if (view.reads(GRISAILLE_BACK_DEPTH)) {
    targets.backDepth = attachment(GRISAILLE_BACK_DEPTH, gpu::Format::kR32Float, kComputed);
  }
  if (view.reads(GRISAILLE_NEXT_DEPTH)) {
    targets.nextDepth = attachment(GRISAILLE_NEXT_DEPTH, gpu::Format::kR32Float, kComputed);
  }
  if (thickness)
    targets.thickness = attachment(GRISAILLE_THICKNESS, gpu::Format::kR32Float, kDrawn);
  if (view.reads(GRISAILLE_MOTION) && source_.hasMotion()) {
    targets.motion.texture = attachment(GRISAILLE_MOTION, gpu::Format::kRgba16Float, kDrawn);
    if (plan.then) {
      targets.motion.then =
          scene::widened(scene::viewOf(*plan.then, {desc.width, desc.height}), view.guard);
    }
    targets.motion.guard = glm::dvec2(view.guard);
  }
  source_.record(commands, view.view, view.block, targets,
                 view.prefix.empty() ? kScenePasses : kGuardedPasses);
}

void Renderer::recordEffects(gpu::Commands& commands, const FrameDesc& desc, const FramePlan& plan,
                             const SceneView& picture, const SceneView& guarded) {
  const grisaille_view view = effectView(picture.view);
  Composing composing;
  for (const PlannedEffect& active : plan.active) {
    if (active.wanted == 0) continue;
    if (active.readsColour()) {
      compose(commands, desc, plan, "colour for " + std::string(active.entry->key()), composing);
    }
    effect::FrameInputs inputs;
    inputs.commands = &commands;
    inputs.width = desc.width;
    inputs.height = desc.height;
    inputs.view = &view;
    const SceneView& seen = active.guarded ? guarded : picture;
    inputs.guard = active.guarded ? plan.guard : 0;
    inputs.viewBlock = seen.block;
    for (size_t a = 0; a < GRISAILLE_ATTACHMENT_COUNT; ++a) {
      if ((active.reads & GRISAILLE_READS(a)) == 0) continue;
      inputs.attachments[a] =
          a == GRISAILLE_COLOUR
              ? find(composing.picture)
              : find(seen.prefix + targetOf(static_cast<grisaille_attachment>(a)));
    }
    const std::vector<gpu::Texture> outputs = outputTargets(active.effect(), active.wanted, desc);
    inputs.outputs = outputs;
    std::vector<gpu::Texture> named;
    for (const std::string& name : active.named) named.push_back(find(name));
    inputs.named = named;
    inputs.patience = desc.patience;
    inputs.services = desc.services;
    recordEffect(*desc.chain, *active.entry, inputs);
    if (active.composed) addLayers(active, desc.surface, composing);
  }
  if (!wants(desc, kColor)) return;
  compose(commands, desc, plan, kColor, composing);
  outputs_.try_emplace(kColor, composing.picture);
}

void Renderer::recordEffect(effect::Chain& chain, const effect::Selection::Entry& entry,
                            const effect::FrameInputs& inputs) {
  try {
    report_ += chain.record(entry, inputs);
  } catch (...) {
    // No pass is open here. The scene and the other effects do not repeat the uploads of this
    // frame, so the device runs them.
    try {
      device_.submit();
    } catch (const Error&) {  // the effect's error tells more
    }
    throw;
  }
}

// One texture per output of the effect; null if the output is not wanted.
std::vector<gpu::Texture> Renderer::outputTargets(const effect::Effect& effect, uint32_t wanted,
                                                  const FrameDesc& desc) {
  std::vector<gpu::Texture> outputs;
  const auto descs = effect.outputs();
  for (size_t o = 0; o < descs.size(); ++o) {
    if ((wanted & (1u << o)) == 0) {
      outputs.emplace_back();
      continue;
    }
    const std::string name = targetName(effect, descs[o]);
    const auto format = effect::formatOf(descs[o].format);
    outputs.push_back(target(name, format, kComputed, desc.width, desc.height));
    outputs_.try_emplace(name, name);
    outputs_.try_emplace(descs[o].key, name);
  }
  return outputs;
}

void Renderer::addLayers(const PlannedEffect& active, Surface surface, Composing& composing) const {
  const auto outputs = active.effect().outputs();
  for (const grisaille_output_desc& output : outputs) {
    const std::string name = targetName(active.effect(), output);
    if (output.role == GRISAILLE_ROLE_COLOUR) {
      composing = {.picture = name};
      return;
    }
    if (!isLayer(outputs, output.role, surface)) continue;
    if (output.role == GRISAILLE_ROLE_OVERLAY) {
      composing.overlays.push_back(find(name));
    } else {
      composing.visibilities.push_back(
          {.overlay = {}, .visibility = find(name), .tinted = output.role == GRISAILLE_ROLE_TINT});
    }
  }
}

void Renderer::compose(gpu::Commands& commands, const FrameDesc& desc, const FramePlan& plan,
                       const std::string& name, Composing& composing) {
  // Light falls on overlays too: they come first, whatever the order of the effects, then
  // visibilities. The last overlay and the first visibility share one layer.
  std::vector<Layer>& visibilities = composing.visibilities;
  const std::vector<gpu::Texture>& overlays = composing.overlays;
  const bool first = composing.picture.empty();
  if (!first && visibilities.empty() && overlays.empty()) return;
  if (visibilities.empty()) visibilities.emplace_back();
  std::vector<Layer> layers;
  for (const gpu::Texture overlay : overlays)
    layers.push_back({.overlay = overlay, .visibility = {}});
  if (!layers.empty()) {
    visibilities.front().overlay = overlays.back();
    layers.pop_back();
  }
  layers.insert(layers.end(), visibilities.begin(), visibilities.end());
  Composition composition = {
      .width = desc.width,
      .height = desc.height,
      .background = desc.background,
      .layers = layers,
      .target = target(name, gpu::Format::kRgba16Float, kComputed, desc.width, desc.height)};
  if (!first) {
    composition.surface = find(composing.picture);
  } else {
    if (desc.surface == Surface::kBaseColour) {
      composition.surface = find(targetOf(GRISAILLE_BASE_COLOUR));
    }
    composition.clipDepth =
        find((plan.composeGuarded ? kGuardedPrefix : "") + std::string(kClipDepth));
    composition.guard = plan.composeGuarded ? plan.guard : 0;
  }
  commands.beginPass("compose/" + name);
  compositor_.record(commands, composition);
  commands.endPass();
  composing = {.picture = name};
}

gpu::Texture Renderer::target(const std::string& name, gpu::Format format, gpu::TextureUsage usage,
                              uint32_t width, uint32_t height) {
  Slot& slot = targets_[name];
  const bool fits = slot.texture && slot.desc.width == width && slot.desc.height == height &&
                    slot.desc.format == format;
  if (!fits) {
    device_.destroy(slot.texture);
    slot = {};
    slot.desc = {.format = format, .width = width, .height = height, .usage = usage};
    gpu::TextureDesc labelled = slot.desc;
    labelled.label = name;
    slot.texture = device_.createTexture(labelled);
  }
  slot.used = true;
  return slot.texture;
}

gpu::Texture Renderer::find(std::string_view name) const {
  const auto found = targets_.find(name);
  return found == targets_.end() ? gpu::Texture{} : found->second.texture;
}

gpu::Texture Renderer::texture(std::string_view output) const {
  const auto found = outputs_.find(output);
  if (found == outputs_.end()) {
    throw Error(ErrorId::kOutputUnknown, "the last frame did not render the output '{}'", output);
  }
  return find(found->second);
}

image::Image Renderer::read(std::string_view output) {
  const gpu::Texture from = texture(output);
  const gpu::TextureDesc& desc = targets_.find(outputs_.find(output)->second)->second.desc;
  image::Image image = toImage(device_.read(from), desc.format, desc.width, desc.height);
  const bool opaque = transferOf(output) != image::Transfer::kData && (opaque_ || output != kColor);
  return opaque && image.channels > 3 ? firstChannels(image, 3) : image;
}

}  // namespace grisaille::frame
