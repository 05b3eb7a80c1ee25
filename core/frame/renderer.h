// SPDX-License-Identifier: MIT
// Renders one frame: draws only the attachments that the active effects and the wanted outputs
// read, runs the effects in order, and composes the picture.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/effect/chain.h"
#include "core/frame/attachments.h"
#include "core/frame/compositor.h"
#include "core/frame/effect_share.h"
#include "core/frame/frames_before.h"
#include "core/gpu/device.h"
#include "core/image/image.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "core/trace/scene_matter.h"

namespace grisaille::frame {

// The surface colour in the composed picture.
enum class Surface : uint8_t { kWhite, kBaseColour };

// The colour of pixels without a surface in the composed picture: linear light, straight alpha.
using Background = glm::vec4;
constexpr Background kGrey = glm::vec4(0.2158605f, 0.2158605f, 0.2158605f, 1);  // #808080
constexpr Background kTransparent = glm::vec4(0);

struct FrameDesc {
  scene::Camera camera;
  uint32_t width = 0;  // pixels
  uint32_t height = 0;
  Surface surface = Surface::kWhite;
  Background background = kGrey;
  // Started on the renderer's device. Its selection must not change during render(). Null: no
  // effects.
  effect::Chain* chain = nullptr;
  std::span<const std::string> outputs;  // names as outputNames() lists them

  // Passed to the effects: see effect::FrameInputs.
  double patience = std::numeric_limits<double>::infinity();
  effect::Services services = {};
};

// Every frame has color (composed, linear light), depth (linear view depth in metres, 0 = sky),
// normal and facet_normal (world), base_colour, back_depth and next_depth (same units as depth) and
// motion (as GRISAILLE_MOTION); an active effect adds its own outputs.
std::vector<std::string> outputNames(std::span<const effect::Effect* const> effects);

// Throws kOutputUnknown with the nearest name unless outputNames() lists `name`.
void checkOutput(std::string_view name, std::span<const effect::Effect* const> effects);

// How a file of integers, and the viewer, encode an output: the composed picture and base colour
// are light; outputs whose key is `normal` or ends in `_normal` are signed, also those of effects.
image::Transfer transferOf(std::string_view output);

// An effect that is on but cannot run.
struct LeftOut {
  std::string effect;  // its key
  Error lacks;         // kEffectLacks with the names of what it needs and does not get
};

struct FramePlan;
struct PlannedEffect;

class Renderer {
 public:
  // Draws the scene. Device and scene must outlive this. The scene may change only between frames,
  // by scene::pose(). matter: that of the scene, must outlive this; null: found by the first frame
  // that needs it
  Renderer(gpu::Device& device, const scene::Scene& scene, trace::SceneMatter* matter = nullptr);
  // Takes the attachments from `source`. Device and source must outlive this.
  Renderer(gpu::Device& device, AttachmentSource& source);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Creates the chain's missing instances, then records and submits one frame. If it throws, no
  // frame stays open. Throws kEffectLacks if the frame asks for an output of an effect that cannot
  // run.
  void render(const FrameDesc& desc);

  // The effects that are on but could not run in the last frame, which was drawn without them.
  const std::vector<LeftOut>& leftOut() const { return leftOut_; }

  // What the effects of the last frame reported, summed.
  const effect::Report& report() const { return report_; }

  // Reads back an output of the last frame, with 1, 3 or 4 channels; `color` has a fourth, alpha,
  // only if the background was not opaque. Waits for the device. Throws kOutputUnknown unless that
  // frame rendered the output.
  image::Image read(std::string_view output);

  // The depth buffer of the last frame; valid until the next render().
  struct Depth {
    gpu::Texture texture;  // near plane / view depth; 0: sky. Null: nothing read any depth
    uint32_t guard = 0;    // width of the band around the picture, pixels
  };
  Depth depth() const { return depth_; }

  // The texture of an output of the last frame, to present it; valid until the next render().
  // Throws the same error.
  gpu::Texture texture(std::string_view output) const;

 private:
  struct SceneView;
  // The composed picture while the effects run.
  struct Composing {
    std::string picture = {};  // the target that holds it so far; "": nothing is composed yet
    // The layers that are not in it yet.
    std::vector<gpu::Texture> overlays = {};
    std::vector<Layer> visibilities = {};
  };
  struct Slot {
    gpu::Texture texture;
    gpu::TextureDesc desc;
    bool used = false;
  };

  void record(gpu::Commands& commands, const FrameDesc& desc, const FramePlan& plan);
  void recordAttachments(gpu::Commands& commands, const FrameDesc& desc, const FramePlan& plan,
                         const SceneView& view);
  void recordEffects(gpu::Commands& commands, const FrameDesc& desc, const FramePlan& plan,
                     const SceneView& picture, const SceneView& guarded);
  std::vector<gpu::Texture> outputTargets(const effect::Effect& effect, uint32_t wanted,
                                          const FrameDesc& desc);
  void recordEffect(effect::Chain& chain, const effect::Selection::Entry& entry,
                    const effect::FrameInputs& inputs);
  void addLayers(const PlannedEffect& active, Surface surface, Composing& composing) const;
  // Composes the layers that are not in the picture yet into the target `name`. Does nothing if the
  // picture holds all of them.
  void compose(gpu::Commands& commands, const FrameDesc& desc, const FramePlan& plan,
               const std::string& name, Composing& composing);
  gpu::Texture target(const std::string& name, gpu::Format format, gpu::TextureUsage usage,
                      uint32_t width, uint32_t height);
  gpu::Texture find(std::string_view name) const;

  gpu::Device& device_;
  std::unique_ptr<AttachmentSource> scene_;  // null: the caller owns the source
  AttachmentSource& source_;
  std::map<std::string, Slot, std::less<>> targets_;         // by name of output or attachment
  std::map<std::string, std::string, std::less<>> outputs_;  // of the last frame: output to target
  Compositor compositor_;
  effect::Report report_;
  std::vector<LeftOut> leftOut_;
  uint64_t jitters_ = 0;  // frames with jitter
  FramesBefore before_;
  bool opaque_ = true;  // the background of the last frame
  Depth depth_;
};

}  // namespace grisaille::frame
