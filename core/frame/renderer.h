// SPDX-License-Identifier: MIT
// One frame: draws exactly the attachments that the active effects and the wanted outputs read,
// runs the effects in order, composes the picture.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/effect/chain.h"
#include "core/frame/attachments.h"
#include "core/gpu/device.h"
#include "core/image/image.h"
#include "core/scene/camera.h"

namespace grisaille::frame {

// What the light falls on in the composed picture.
enum class Surface : uint8_t { kWhite, kBaseColour };

struct FrameDesc {
  scene::Camera camera;
  uint32_t width = 0;  // pixels
  uint32_t height = 0;
  Surface surface = Surface::kWhite;
  // Started on the renderer's device; its selection stays unchanged during render(). Null: no
  // effects.
  effect::Chain* chain = nullptr;
  std::span<const std::string> outputs;  // names as outputNames() lists them

  // For the effects, as effect::FrameInputs has them.
  double patience = std::numeric_limits<double>::infinity();
  effect::Services services = {};
};

// Which share of the time of a pass that draws the scene with a guard band goes beyond the picture.
// 0: no effect has one.
double guardShare(const effect::Selection& selection, uint32_t width, uint32_t height);
// Which share of a pass of this label, of those that draw the scene, is what effects cost that want
// more than most renderers have anyway: all of drawing back faces, and what guard bands add.
double shareForEffects(std::string_view pass, double guardShare);

// Every frame has color (composed, linear light), depth (linear view depth in metres, 0 = sky),
// normal and facet_normal (world), base_colour and back_depth (as depth); an active effect adds its
// own outputs.
std::vector<std::string> outputNames(std::span<const effect::Effect* const> effects);

// Throws kOutputUnknown, naming the nearest, unless outputNames() lists `name`.
void checkOutput(std::string_view name, std::span<const effect::Effect* const> effects);

// How a file of integers holds an output: the composed picture and base colour are light, normals
// have signs.
image::Transfer transferOf(std::string_view output);

class Renderer {
 public:
  // Draws the scene. Device and scene outlive this; the scene stays unchanged.
  Renderer(gpu::Device& device, const scene::Scene& scene);
  // Takes the attachments from there; it outlives this as the device does.
  Renderer(gpu::Device& device, AttachmentSource& source);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Records and submits one frame, after creating what the chain lacks. What throws leaves no frame
  // open.
  void render(const FrameDesc& desc);

  // What waits to be drawn in a later frame, summed over the effects of the last one. 0: its
  // picture is whole.
  uint64_t waiting() const { return waiting_; }

  // An output of the last frame, as numbers; 1, 3 or 4 channels. Waits for the device. Throws
  // kOutputUnknown unless that frame was asked for it.
  image::Image read(std::string_view output);

  // The same as a texture, for presenting; valid until the next render().
  gpu::Texture texture(std::string_view output) const;

 private:
  struct Plan;
  struct SceneView;
  struct Slot {
    gpu::Texture texture;
    gpu::TextureDesc desc;
    bool used = false;
  };

  void record(gpu::Commands& commands, const FrameDesc& desc, const Plan& plan);
  void recordAttachments(gpu::Commands& commands, const SceneView& view);
  void recordEffects(gpu::Commands& commands, const FrameDesc& desc, const Plan& plan,
                     const SceneView& picture, const SceneView& guarded);
  std::vector<gpu::Texture> outputTargets(const effect::Effect& effect, uint32_t wanted,
                                          const FrameDesc& desc);
  void recordCompose(gpu::Commands& commands, const FrameDesc& desc, const Plan& plan);
  // One layer of the composition: `overlay` is laid over the surface, `visibility` multiplies it,
  // by channel where it is tinted; null: the neutral texture.
  struct Layer {
    gpu::Texture overlay, visibility;
    bool tinted = false;
  };
  void composeLayer(gpu::Commands& commands, gpu::Texture surface, const Layer& layer,
                    gpu::Texture target, const FrameDesc& desc);
  gpu::Texture target(const std::string& name, gpu::Format format, gpu::TextureUsage usage,
                      uint32_t width, uint32_t height);
  gpu::Texture find(std::string_view name) const;

  gpu::Device& device_;
  std::unique_ptr<AttachmentSource> scene_;  // null: the source is somebody else's
  AttachmentSource& source_;
  std::map<std::string, Slot, std::less<>> targets_;         // by output name, or attachment name
  std::map<std::string, std::string, std::less<>> outputs_;  // of the last frame: name to target
  gpu::ComputePipeline compose_, composeTinted_;
  gpu::Sampler nearest_;
  gpu::Texture white_, clear_;
  uint64_t waiting_ = 0;
};

}  // namespace grisaille::frame
