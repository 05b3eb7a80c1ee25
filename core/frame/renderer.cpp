// SPDX-License-Identifier: MIT
#include "core/frame/renderer.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/nearest.h"
#include "core/frame/scene_attachments.h"
#include "core/frame/texture_image.h"
#include "core/frame/view_block.h"

namespace grisaille::frame {
namespace {

constexpr const char* kColor = "color";
constexpr const char* kDepth = "depth";
constexpr const char* kNormal = "normal";
constexpr const char* kBaseColour = "base_colour";
constexpr const char* kFacetNormal = "facet_normal";
constexpr const char* kBackDepth = "back_depth";
constexpr const char* kThickness = "thickness";
constexpr const char* kNextDepth = "next_depth";
constexpr const char* kMotion = "motion";
constexpr const char* kFrameOutputs[] = {kColor,     kDepth,  kNormal,    kBaseColour, kFacetNormal,
                                         kBackDepth, kMotion, kThickness, kNextDepth};
// Target of clip depth, which is not an output.
constexpr const char* kClipDepth = "clip depth";
// Prefix of the targets with a guard band.
constexpr const char* kGuardedPrefix = "guarded ";

// The target that holds an effect's output.
std::string targetName(const effect::Effect& effect, const grisaille_output_desc& output) {
  return std::string(effect.desc->key) + "." + output.key;
}

// "ao" names the output of the first active effect that has this key, "ssao.ao" the output of ssao.
bool names(std::string_view name, const effect::Effect& effect,
           const grisaille_output_desc& output) {
  return name == output.key || name == targetName(effect, output);
}

// Whether an output of this role is a layer of the composed picture. If the picture shows base
// colours, tints replace visibilities.
bool composed(std::span<const grisaille_output_desc> outputs, uint32_t role, Surface surface) {
  const bool tinted = surface == Surface::kBaseColour &&
                      std::ranges::any_of(outputs, [](const grisaille_output_desc& output) {
                        return output.role == GRISAILLE_ROLE_TINT;
                      });
  return role == GRISAILLE_ROLE_OVERLAY ||
         role == (tinted ? GRISAILLE_ROLE_TINT : GRISAILLE_ROLE_VISIBILITY);
}

constexpr auto kDrawn = gpu::TextureUsage::kTarget | gpu::TextureUsage::kSampled;
constexpr auto kComputed = gpu::TextureUsage::kStorage | gpu::TextureUsage::kSampled;

// The effects that are on, in the order in which they run.
std::vector<const effect::Selection::Entry*> activeOf(const FrameDesc& desc) {
  std::vector<const effect::Selection::Entry*> active;
  if (desc.chain == nullptr) return active;
  for (const effect::Selection::Entry& entry : desc.chain->selection.entries()) {
    if (entry.on) active.push_back(&entry);
  }
  return active;
}

}  // namespace

std::vector<std::string> outputNames(std::span<const effect::Effect* const> effects) {
  std::vector<std::string> all(std::begin(kFrameOutputs), std::end(kFrameOutputs));
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
  if (output == kNormal || output == kFacetNormal) return image::Transfer::kSigned;
  return output == kColor || output == kBaseColour ? image::Transfer::kColour
                                                   : image::Transfer::kData;
}

// The needs of one frame, computed before recording.
struct Renderer::Plan {
  uint32_t attachments = 0;  // of GRISAILLE_READS
  // Attachments with a guard band, of GRISAILLE_READS, and the band's width in pixels.
  uint32_t guarded = 0, guard = 0;
  // The camera of the previous frame; nothing: motion since then is not known.
  std::optional<scene::Camera> then;
  std::vector<MotionReader> motionReaders;
  struct Active {
    const effect::Selection::Entry* entry;
    uint32_t wanted;  // wanted outputs, by bit; 0: the effect does not run
    uint32_t reads;   // attachments
    bool guarded;

    const effect::Effect& effect() const { return entry->effect(); }
  };
  std::vector<Active> active;
  bool color = false;
  bool composeGuarded = false;  // the composed picture reads the guarded depth

  bool readsMotion() const {
    return ((attachments | guarded) & GRISAILLE_READS(GRISAILLE_MOTION)) != 0;
  }

  Plan(const FrameDesc& desc, const AttachmentSource& source) {
    color = wants(desc, kColor);
    if (wants(desc, kDepth)) attachments |= GRISAILLE_READS(GRISAILLE_VIEW_DEPTH);
    if (wants(desc, kNormal)) attachments |= GRISAILLE_READS(GRISAILLE_NORMAL);
    if (wants(desc, kFacetNormal)) attachments |= GRISAILLE_READS(GRISAILLE_FACET_NORMAL);
    if (wants(desc, kBackDepth)) attachments |= GRISAILLE_READS(GRISAILLE_BACK_DEPTH);
    if (wants(desc, kMotion)) attachments |= GRISAILLE_READS(GRISAILLE_MOTION);
    if (wants(desc, kThickness)) attachments |= GRISAILLE_READS(GRISAILLE_THICKNESS);
    if (wants(desc, kNextDepth)) attachments |= GRISAILLE_READS(GRISAILLE_NEXT_DEPTH);
    if (wants(desc, kBaseColour) || (color && desc.surface == Surface::kBaseColour)) {
      attachments |= GRISAILLE_READS(GRISAILLE_BASE_COLOUR);
    }
    for (const effect::Selection::Entry* entry : activeOf(desc)) {
      Active one{
          .entry = entry, .wanted = wantedOf(desc, entry->effect()), .reads = 0, .guarded = false};
      if (one.wanted != 0) {
        one.reads = entry->effect().reads(entry->values.all().data(), one.wanted);
        const uint32_t band =
            source.goesBeyond() ? effect::guardBand(entry->values, desc.height) : 0;
        one.guarded = band > 0;
        (one.guarded ? guarded : attachments) |= one.reads;
        guard = std::max(guard, band);
        if ((one.reads & GRISAILLE_READS(GRISAILLE_MOTION)) != 0) {
          motionReaders.emplace_back(desc.chain, &entry->effect());
        }
      }
      active.push_back(one);
    }
    // Any depth shows where the background is.
    composeGuarded = color && attachments == 0 && guarded != 0;
    if (color && !composeGuarded) attachments |= GRISAILLE_READS(GRISAILLE_DEPTH);
  }

  static bool wants(const FrameDesc& desc, std::string_view name) {
    return std::find(desc.outputs.begin(), desc.outputs.end(), name) != desc.outputs.end();
  }

 private:
  uint32_t wantedOf(const FrameDesc& desc, const effect::Effect& effect) const {
    uint32_t bits = 0;
    const auto outputs = effect.outputs();
    for (size_t i = 0; i < outputs.size(); ++i) {
      const bool layer = color && composed(outputs, outputs[i].role, desc.surface);
      const bool asked = std::ranges::any_of(
          desc.outputs, [&](const std::string& name) { return names(name, effect, outputs[i]); });
      if (layer || asked) bits |= 1u << i;
    }
    return bits;
  }
};

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

Renderer::Renderer(gpu::Device& device, const scene::Scene& scene)
    : device_(device),
      scene_(std::make_unique<SceneAttachments>(device, scene)),
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

  Plan plan(desc, source_);
  if (Plan::wants(desc, kMotion) && !source_.hasMotion()) {
    throw Error(ErrorId::kPictureMissing, "motion is needed, but no picture has any");
  }
  if (Plan::wants(desc, kThickness) && !source_.hasThickness()) {
    throw Error(ErrorId::kPictureMissing, "thickness is needed, but no picture has any");
  }
  if (plan.readsMotion()) plan.then = before_.cameraFor(plan.motionReaders, source_);
  if (desc.chain != nullptr) desc.chain->create();
  for (auto& [name, slot] : targets_) slot.used = false;
  outputs_.clear();
  report_ = {};
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
  const bool guarded = plan.attachments == 0;
  depth_ = {find((guarded ? kGuardedPrefix : "") + std::string(kClipDepth)),
            guarded ? plan.guard : 0};
  before_.add(desc.camera, plan.motionReaders, source_);
  source_.finish(plan.readsMotion());
  std::erase_if(targets_, [&](const auto& entry) {
    if (!entry.second.used) device_.destroy(entry.second.texture);
    return !entry.second.used;
  });
}

void Renderer::record(gpu::Commands& commands, const FrameDesc& desc, const Plan& plan) {
  const scene::View seen = scene::viewOf(desc.camera, {desc.width, desc.height});
  const auto sceneView = [&](uint32_t guard, uint32_t attachments, const char* prefix) {
    const ViewBlock block = viewBlock(seen, guard);
    return SceneView{.view = scene::widened(seen, guard),
                     .guard = guard,
                     .attachments = attachments,
                     .block = commands.uniform(std::as_bytes(std::span(&block, 1))),
                     .prefix = prefix};
  };
  const SceneView picture = sceneView(0, plan.attachments, "");
  const SceneView guarded =
      plan.guard > 0 ? sceneView(plan.guard, plan.guarded, kGuardedPrefix) : picture;
  if (plan.attachments != 0) recordAttachments(commands, desc, plan, picture);
  if (plan.guarded != 0) recordAttachments(commands, desc, plan, guarded);
  recordEffects(commands, desc, plan, picture, guarded);
  if (plan.color) recordCompose(commands, desc, plan);
  for (const std::string& name : desc.outputs) outputs_.try_emplace(name, name);
}

void Renderer::recordAttachments(gpu::Commands& commands, const FrameDesc& desc, const Plan& plan,
                                 const SceneView& view) {
  const auto attachment = [&](const char* name, gpu::Format format, gpu::TextureUsage usage) {
    return target(view.prefix + name, format, usage, view.view.size.x, view.view.size.y);
  };
  AttachmentTargets targets;
  targets.depth = attachment(kClipDepth, gpu::Format::kD32Float, kDrawn);
  const bool thickness = view.reads(GRISAILLE_THICKNESS) && source_.hasThickness();
  if (view.reads(GRISAILLE_NORMAL) || thickness) {
    targets.normal = attachment(kNormal, gpu::Format::kRgba16Float, kDrawn);
  }
  if (view.reads(GRISAILLE_BASE_COLOUR)) {
    targets.baseColour = attachment(kBaseColour, gpu::Format::kRgba8Srgb, kDrawn);
  }
  if (view.reads(GRISAILLE_FACET_NORMAL)) {
    targets.facetNormal = attachment(kFacetNormal, gpu::Format::kRgba16Float, kDrawn);
  }
  if (view.reads(GRISAILLE_VIEW_DEPTH)) {
    targets.viewDepth = attachment(kDepth, gpu::Format::kR32Float, kComputed);
  }
  if (view.reads(GRISAILLE_BACK_DEPTH)) {
    targets.backDepth = attachment(kBackDepth, gpu::Format::kR32Float, kComputed);
  }
  if (view.reads(GRISAILLE_NEXT_DEPTH)) {
    targets.nextDepth = attachment(kNextDepth, gpu::Format::kR32Float, kComputed);
  }
  if (thickness) targets.thickness = attachment(kThickness, gpu::Format::kR32Float, kDrawn);
  if (view.reads(GRISAILLE_MOTION) && source_.hasMotion()) {
    targets.motion.texture = attachment(kMotion, gpu::Format::kRgba16Float, kDrawn);
    if (plan.then) {
      targets.motion.then =
          scene::widened(scene::viewOf(*plan.then, {desc.width, desc.height}), view.guard);
    }
    targets.motion.guard = glm::dvec2(view.guard);
  }
  source_.record(commands, view.view, view.block, targets,
                 view.prefix.empty() ? kScenePasses : kGuardedPasses);
}

void Renderer::recordEffects(gpu::Commands& commands, const FrameDesc& desc, const Plan& plan,
                             const SceneView& picture, const SceneView& guarded) {
  const grisaille_view view = effectView(scene::viewOf(desc.camera, {desc.width, desc.height}));
  for (const Plan::Active& active : plan.active) {
    if (active.wanted == 0) continue;
    effect::FrameInputs inputs;
    inputs.commands = &commands;
    inputs.width = desc.width;
    inputs.height = desc.height;
    inputs.view = &view;
    const SceneView& seen = active.guarded ? guarded : picture;
    inputs.guard = active.guarded ? plan.guard : 0;
    inputs.viewBlock = seen.block;
    constexpr const char* kAttachments[GRISAILLE_ATTACHMENT_COUNT] = {
        kClipDepth, kDepth,  kNormal,    kBaseColour, kFacetNormal,
        kBackDepth, kMotion, kThickness, kNextDepth};
    for (size_t a = 0; a < GRISAILLE_ATTACHMENT_COUNT; ++a) {
      if ((active.reads & GRISAILLE_READS(a)) != 0)
        inputs.attachments[a] = find(seen.prefix + kAttachments[a]);
    }
    const std::vector<gpu::Texture> outputs = outputTargets(active.effect(), active.wanted, desc);
    inputs.outputs = outputs;
    inputs.patience = desc.patience;
    inputs.services = desc.services;
    try {
      report_ += desc.chain->record(*active.entry, inputs);
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

void Renderer::recordCompose(gpu::Commands& commands, const FrameDesc& desc, const Plan& plan) {
  // Light falls on overlays too: they come first, whatever the order of the effects, then
  // visibilities. The last overlay and the first visibility share one layer.
  std::vector<gpu::Texture> overlays;
  std::vector<Layer> visibilities;
  for (const Plan::Active& active : plan.active) {
    for (const grisaille_output_desc& output : active.effect().outputs()) {
      if (!composed(active.effect().outputs(), output.role, desc.surface)) continue;
      const gpu::Texture texture = find(targetName(active.effect(), output));
      if (output.role == GRISAILLE_ROLE_OVERLAY) {
        overlays.push_back(texture);
      } else {
        visibilities.push_back(
            {.overlay = {}, .visibility = texture, .tinted = output.role == GRISAILLE_ROLE_TINT});
      }
    }
  }
  if (visibilities.empty()) visibilities.emplace_back();
  std::vector<Layer> layers;
  for (const gpu::Texture overlay : overlays)
    layers.push_back({.overlay = overlay, .visibility = {}});
  if (!layers.empty()) {
    visibilities.front().overlay = overlays.back();
    layers.pop_back();
  }
  layers.insert(layers.end(), visibilities.begin(), visibilities.end());
  const bool base = desc.surface == Surface::kBaseColour;
  commands.beginPass("compose/color");
  compositor_.record(
      commands,
      {.width = desc.width,
       .height = desc.height,
       .surface = base ? find(kBaseColour) : gpu::Texture{},
       .clipDepth = find((plan.composeGuarded ? kGuardedPrefix : "") + std::string(kClipDepth)),
       .guard = plan.composeGuarded ? plan.guard : 0,
       .background = desc.background,
       .layers = layers,
       .target = target(kColor, gpu::Format::kRgba16Float, kComputed, desc.width, desc.height)});
  commands.endPass();
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
  return opaque ? firstChannels(image, 3) : image;
}

}  // namespace grisaille::frame
