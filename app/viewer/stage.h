// SPDX-License-Identifier: MIT
// The scene on the screen: renders what the two sides of the picture show when something that it
// depends on has changed, and keeps it while nothing has.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/services/scene_services.h"
#include "core/effect/chain.h"
#include "core/frame/renderer.h"

namespace grisaille::app::viewer {

// How numbers become colours; as shaders/viewer/show.comp has it.
enum class Kind : uint32_t { kLight, kNumber, kSigned, kDepth, kOverlay, kEncoded };

// An output of the frame that can be looked at.
struct Viewable {
  std::string output, label;
  Kind kind = Kind::kNumber;
};

// Of a frame with these effects, in the order of the outputs; those of integers left out.
std::vector<Viewable> viewables(const effect::Selection& effects);

// What the picture is made of. Revisions change with what they stand for.
struct StageDesc {
  scene::Camera camera;
  glm::uvec2 size = glm::uvec2(0);
  frame::Surface surface = frame::Surface::kWhite;
  effect::Chain* chain = nullptr;
  uint64_t liveRevision = 0;                // of its selection
  const effect::Selection* held = nullptr;  // the right side's settings; null: the chain's
  uint64_t heldRevision = 0;
  std::string left = "color";
  std::string right;                    // "": there is no right side
  std::vector<std::string> extra = {};  // outputs of the live settings to be read
  double patience = 0.05;               // seconds of work that can wait which a frame may do
};

class Stage {
 public:
  // All outlive this; the scene stays unchanged. The chain is started on the device.
  Stage(gpu::Device& device, const scene::Scene& scene, SceneServices& services,
        effect::Chain& chain);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  // Whether update() would render.
  bool isStale(const StageDesc& desc) const;

  // Renders what is stale. Throws Error where an effect or the device fails: the picture is then
  // what it was, and is not stale until something changes.
  void update(const StageDesc& desc);

  // Null where nothing has been rendered yet.
  gpu::Texture texture(bool right) const;
  Kind kind(bool right) const { return (right ? right_ : left_).kind; }
  glm::uvec2 size() const { return size_; }
  uint64_t revision() const { return revision_; }  // of the picture

  // The numbers of one texel, as many as the output has channels. Waits for the device at the first
  // call after an update().
  std::vector<float> valueAt(bool right, glm::uvec2 texel);

  // The next update() renders, whatever has changed.
  void touch() { done_.reset(); }

  // An output of the last update(): left, right where that is live, or one of the extra ones.
  image::Image read(const std::string& output) { return renderer_.read(output); }

  // One output at any size, for a file; the screen's picture is stale afterwards.
  image::Image picture(const StageDesc& desc, const std::string& output);

  // What waits to be drawn in a later frame: the picture is not whole.
  uint64_t waiting() const { return waiting_; }

 private:
  struct Side {
    gpu::Texture texture;
    std::string output;
    Kind kind = Kind::kLight;
    std::optional<image::Image> values;  // read when first asked for
  };
  // All that a side's picture depends on.
  struct Wanted {
    scene::Camera camera;
    glm::uvec2 size;
    frame::Surface surface;
    uint64_t revision;
    std::string left, right;
    std::vector<std::string> extra;
    uint64_t objects;  // revision

    bool operator==(const Wanted& other) const;
  };
  static Wanted wanted(const StageDesc& desc, bool held);
  void render(const StageDesc& desc, glm::uvec2 size, std::span<const std::string> outputs);
  void updateHeld(const StageDesc& desc);

  gpu::Device& device_;
  SceneServices& services_;
  frame::Renderer renderer_;
  effect::StartedChain started_;
  std::optional<Wanted> done_, heldDone_;  // what the sides hold
  Side left_, right_;
  glm::uvec2 size_ = glm::uvec2(0);
  uint64_t waiting_ = 0, heldWaiting_ = 0, revision_ = 0;
  gpu::Texture held_;  // a copy of the held settings' output
  glm::uvec2 heldSize_ = glm::uvec2(0);
  gpu::ComputePipeline keep_;
  gpu::Sampler nearest_;
};

}  // namespace grisaille::app::viewer
