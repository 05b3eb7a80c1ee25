// SPDX-License-Identifier: MIT
// The needs of one frame, computed before it is recorded: which effects run for which outputs, the
// attachments that they read, and where the picture is composed.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/frame/renderer.h"

namespace grisaille::frame {

// Name of the output that is the composed picture.
constexpr const char* kColor = "color";

// The attachments that are outputs of the frame.
struct AttachmentOutput {
  const char* name;
  grisaille_attachment attachment;
};
constexpr AttachmentOutput kAttachmentOutputs[] = {
    {"depth", GRISAILLE_VIEW_DEPTH},        {"normal", GRISAILLE_NORMAL},
    {"base_colour", GRISAILLE_BASE_COLOUR}, {"facet_normal", GRISAILLE_FACET_NORMAL},
    {"back_depth", GRISAILLE_BACK_DEPTH},   {"motion", GRISAILLE_MOTION},
    {"thickness", GRISAILLE_THICKNESS},     {"next_depth", GRISAILLE_NEXT_DEPTH}};

// The target that holds an effect's output.
std::string targetName(const effect::Effect& effect, const grisaille_output_desc& output);

// Whether an output of this role is a layer of the composed picture. If the picture shows base
// colours, tints replace visibilities.
bool isLayer(std::span<const grisaille_output_desc> outputs, uint32_t role, Surface surface);

// The effects that are on, in the order in which they run.
std::vector<const effect::Selection::Entry*> activeOf(const FrameDesc& desc);

// Whether the frame must write the output of this name.
bool wants(const FrameDesc& desc, std::string_view name);

// An effect that is on.
struct PlannedEffect {
  const effect::Selection::Entry* entry;
  uint32_t wanted = 0;    // wanted outputs, by bit; 0: the effect does not run
  uint32_t reads = 0;     // of GRISAILLE_READS
  bool composed = false;  // the composed picture shows its layers, or its colour
  bool guarded = false;   // its attachments have a guard band
  // The targets of its inputs, one per input of its table; "": missing.
  std::vector<std::string> named = {};

  const effect::Effect& effect() const { return entry->effect(); }
  bool readsColour() const { return (reads & GRISAILLE_READS(GRISAILLE_COLOUR)) != 0; }
};

struct FramePlan {
  // `jitters`: number of earlier frames with jitter. Throws kEffectLacks if the frame asks for an
  // output of an effect that is left out.
  FramePlan(const FrameDesc& desc, const AttachmentSource& source, uint64_t jitters);

  bool readsMotion() const {
    return ((attachments | guarded) & GRISAILLE_READS(GRISAILLE_MOTION)) != 0;
  }

  // Attachments of the picture's size, of GRISAILLE_READS without GRISAILLE_COLOUR.
  uint32_t attachments = 0;
  // Attachments with a guard band, and the band's width in pixels.
  uint32_t guarded = 0, guard = 0;
  std::vector<PlannedEffect> active;
  bool surface = false;         // the composed picture begins with the scene's surfaces
  bool composeGuarded = false;  // the composed picture reads the guarded depth
  std::vector<LeftOut> leftOut;
  scene::Camera camera;               // draws the frame: the frame's, with the jitter
  glm::dvec2 jitter = glm::dvec2(0);  // pixels, see grisaille_view
  std::vector<MotionReader> motionReaders;
  // The camera of the previous frame; nothing: motion since then is not known.
  std::optional<scene::Camera> then;

 private:
  void addOutputs(const FrameDesc& desc);
  void findAble(const FrameDesc& desc, const AttachmentSource& source);
  void addEffects(const FrameDesc& desc);
  void jitterCamera(const FrameDesc& desc, uint64_t jitters);
};

}  // namespace grisaille::frame
