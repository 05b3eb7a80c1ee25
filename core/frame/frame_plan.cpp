// SPDX-License-Identifier: MIT
#include "core/frame/frame_plan.h"

#include <algorithm>
#include <iterator>

namespace grisaille::frame {
namespace {

// "ao" names the output of the first active effect that has this key, "ssao.ao" the output of ssao.
bool names(std::string_view name, const effect::Effect& effect,
           const grisaille_output_desc& output) {
  return name == output.key || name == targetName(effect, output);
}

bool isColour(const grisaille_output_desc& output) {
  return output.role == GRISAILLE_ROLE_COLOUR;
}

// The outputs that the frame or a later effect asks for by name, and, if the composed picture needs
// the effect, those that it shows. `read`: names of outputs that later effects read.
uint32_t wantedOf(const FrameDesc& desc, const effect::Effect& effect, bool composed,
                  std::span<const std::string> read) {
  uint32_t bits = 0;
  const auto outputs = effect.outputs();
  for (size_t i = 0; i < outputs.size(); ++i) {
    const bool shown =
        composed && (isColour(outputs[i]) || isLayer(outputs, outputs[i].role, desc.surface));
    const bool asked = std::ranges::any_of(
        desc.outputs, [&](const std::string& name) { return names(name, effect, outputs[i]); });
    const bool needed = std::ranges::find(read, targetName(effect, outputs[i])) != read.end();
    if (shown || asked || needed) bits |= 1u << i;
  }
  return bits;
}

// Whether one of the effects writes the output of this full name.
bool writes(std::span<const PlannedEffect> effects, std::string_view name) {
  return std::ranges::any_of(effects, [&](const PlannedEffect& one) {
    return std::ranges::any_of(one.effect().outputs(), [&](const grisaille_output_desc& output) {
      return name == targetName(one.effect(), output);
    });
  });
}

// The names of what an effect needs and does not get.
std::vector<std::string> lackedBy(const PlannedEffect& one, const AttachmentSource& source) {
  const effect::Effect& effect = one.effect();
  const uint32_t reads = effect.reads(one.entry->values.all().data(), ~0u) & effect.desc->needs;
  uint32_t lacked = 0;
  if (!source.hasMotion()) lacked |= reads & GRISAILLE_READS(GRISAILLE_MOTION);
  if (!source.hasThickness()) lacked |= reads & GRISAILLE_READS(GRISAILLE_THICKNESS);
  std::vector<std::string> names = effect::attachmentNames(lacked);
  for (size_t i = 0; i < one.named.size(); ++i) {
    const grisaille_input_desc& input = effect.inputs()[i];
    const bool required = (input.flags & GRISAILLE_INPUT_REQUIRED) != 0;
    if (required && one.named[i].empty()) names.emplace_back(input.key);
  }
  return names;
}

// Element n of the van der Corput sequence, 0 to 1.
double radicalInverse(uint64_t n, uint64_t base) {
  double sum = 0, digit = 1;
  for (; n > 0; n /= base) {
    digit /= static_cast<double>(base);
    sum += digit * static_cast<double>(n % base);
  }
  return sum;
}

}  // namespace

std::string targetName(const effect::Effect& effect, const grisaille_output_desc& output) {
  return std::string(effect.desc->key) + "." + output.key;
}

bool isLayer(std::span<const grisaille_output_desc> outputs, uint32_t role, Surface surface) {
  const bool tinted = surface == Surface::kBaseColour &&
                      std::ranges::any_of(outputs, [](const grisaille_output_desc& output) {
                        return output.role == GRISAILLE_ROLE_TINT;
                      });
  return role == GRISAILLE_ROLE_OVERLAY ||
         role == (tinted ? GRISAILLE_ROLE_TINT : GRISAILLE_ROLE_VISIBILITY);
}

std::vector<const effect::Selection::Entry*> activeOf(const FrameDesc& desc) {
  std::vector<const effect::Selection::Entry*> active;
  if (desc.chain == nullptr) return active;
  for (const effect::Selection::Entry& entry : desc.chain->selection.entries()) {
    if (entry.on) active.push_back(&entry);
  }
  return active;
}

bool wants(const FrameDesc& desc, std::string_view name) {
  return std::find(desc.outputs.begin(), desc.outputs.end(), name) != desc.outputs.end();
}

FramePlan::FramePlan(const FrameDesc& desc, const AttachmentSource& source, uint64_t jitters)
    : camera(desc.camera) {
  addOutputs(desc);
  findAble(desc, source);
  addEffects(desc);
  jitterCamera(desc, jitters);
  for (PlannedEffect& one : active) {
    if (one.wanted == 0) continue;
    const uint32_t band =
        source.goesBeyond() ? effect::guardBand(one.entry->values, desc.height) : 0;
    one.guarded = band > 0;
    (one.guarded ? guarded : attachments) |= one.reads & ~GRISAILLE_READS(GRISAILLE_COLOUR);
    guard = std::max(guard, band);
    if ((one.reads & GRISAILLE_READS(GRISAILLE_MOTION)) != 0) {
      motionReaders.emplace_back(desc.chain, &one.effect());
    }
  }
  if (surface && desc.surface == Surface::kBaseColour) {
    attachments |= GRISAILLE_READS(GRISAILLE_BASE_COLOUR);
  }
  // Any depth shows where the background is.
  composeGuarded = surface && attachments == 0 && guarded != 0;
  if (surface && !composeGuarded) attachments |= GRISAILLE_READS(GRISAILLE_DEPTH);
}

// The attachments that are outputs themselves.
void FramePlan::addOutputs(const FrameDesc& desc) {
  for (const auto& [name, attachment] : kAttachmentOutputs) {
    if (wants(desc, name)) attachments |= GRISAILLE_READS(attachment);
  }
}

// The effects that have all that they need: a scene with motion, say, or an earlier effect that
// writes an input.
void FramePlan::findAble(const FrameDesc& desc, const AttachmentSource& source) {
  for (const effect::Selection::Entry* entry : activeOf(desc)) {
    PlannedEffect one{.entry = entry};
    for (const grisaille_input_desc& input : entry->effect().inputs()) {
      one.named.emplace_back(writes(active, input.key) ? input.key : "");
    }
    const std::vector<std::string> lacked = lackedBy(one, source);
    if (lacked.empty()) {
      active.push_back(std::move(one));
      continue;
    }
    leftOut.push_back({std::string(entry->key()),
                       Error(ErrorId::kEffectLacks, "{} needs {}, which nothing gives it",
                             entry->key(), fmt::join(lacked, " and "))});
    if (wantedOf(desc, entry->effect(), false, {}) != 0) throw Error(leftOut.back().lacks);
  }
}

// From the last effect to the first: an effect runs if the frame or a later effect asks for its
// output, or if the picture behind it is needed. That picture is needed for the output "color", and
// for a later effect that reads it.
void FramePlan::addEffects(const FrameDesc& desc) {
  bool needed = wants(desc, kColor);
  std::vector<std::string> read;
  for (size_t i = active.size(); i-- > 0;) {
    PlannedEffect& one = active[i];
    const effect::Effect& effect = one.effect();
    one.wanted = wantedOf(desc, effect, needed, read);
    if (one.wanted == 0) continue;
    one.composed = needed;
    one.reads = effect.reads(one.entry->values.all().data(), one.wanted);
    const bool replaces = needed && std::ranges::any_of(effect.outputs(), isColour);
    needed = (needed && !replaces) || one.readsColour();
    std::ranges::copy(one.named, std::back_inserter(read));
  }
  surface = needed;
}

// The Halton sequence (1960) in bases 2 and 3 fills the pixel evenly; 16 points, again and again.
void FramePlan::jitterCamera(const FrameDesc& desc, uint64_t jitters) {
  constexpr uint64_t kPoints = 16;
  const bool wanted = std::ranges::any_of(active, [](const PlannedEffect& one) {
    return one.wanted != 0 && (one.effect().desc->flags & GRISAILLE_EFFECT_JITTER) != 0;
  });
  if (!wanted) return;
  const uint64_t point = jitters % kPoints + 1;
  jitter = glm::dvec2(radicalInverse(point, 2), radicalInverse(point, 3)) - 0.5;
  camera.shift += jitter * glm::dvec2(-1, 1) / glm::dvec2(desc.width, desc.height);
}

}  // namespace grisaille::frame
