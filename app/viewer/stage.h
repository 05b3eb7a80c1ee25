// SPDX-License-Identifier: MIT
// Renders the outputs that the two sides of the picture show. Renders again only when one of its
// inputs has changed.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/services/scene_services.h"
#include "core/effect/chain.h"
#include "core/frame/renderer.h"

namespace grisaille::app::viewer {

// How show.comp converts values to colours; same numbers as in shaders/viewer/show.comp.
enum class Kind : uint32_t { kLight, kNumber, kSigned, kDepth, kOverlay, kEncoded };

// The texture that one side of the picture shows.
struct Side {
  gpu::Texture texture = {};
  Kind kind = Kind::kLight;

  bool operator==(const Side&) const = default;
};

// An output of the frame that the viewer can show.
struct Viewable {
  std::string output, label;
  Kind kind = Kind::kNumber;
};

// The viewable outputs of a frame with these effects, in order. Leaves out integer outputs.
std::vector<Viewable> viewables(const effect::Selection& effects);

// The key of the parameter by which effects average frames: their number, 1 for no average.
constexpr std::string_view kHistory = "history";

// The largest number of frames that an effect of the selection averages; 1: no effect does.
// `converges`: as many as the effects can, whatever their values.
uint32_t framesAveraged(const effect::Selection& effects, bool converges);

// Inputs of the picture. A revision changes whenever the input that it belongs to changes.
struct StageDesc {
  scene::Camera camera;
  glm::uvec2 size = glm::uvec2(0);  // pixels
  bool halves = false;              // renders at half that size
  // Renders the live settings as often as their effects average frames, as framesAveraged() counts.
  bool averages = false, converges = false;
  frame::Surface surface = frame::Surface::kWhite;
  frame::Background background = frame::kGrey;
  effect::Chain* chain = nullptr;
  uint64_t liveRevision = 0;                // of the chain's selection
  const effect::Selection* held = nullptr;  // settings of the right side; null: the chain's
  uint64_t heldRevision = 0;
  std::string left = "color";
  std::string right;                    // "": no right side
  std::vector<std::string> extra = {};  // further outputs of the live settings, for read()
  double patience = 0.05;               // seconds per frame for work that can wait
  uint64_t poses = 0;                   // Scene::poses
};

class Stage {
 public:
  // All arguments must outlive this; the scene may change between updates, by scene::pose(). Starts
  // the chain on the device.
  Stage(gpu::Device& device, const scene::Scene& scene, SceneServices& services,
        effect::Chain& chain);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  // True if update() would render.
  bool isStale(const StageDesc& desc) const;

  // Renders stale sides. Throws Error if an effect or the device fails; isStale() is then false
  // until an input changes.
  void update(const StageDesc& desc);

  // Null before the first update().
  gpu::Texture texture(bool right) const;
  Kind kind(bool right) const { return (right ? right_ : left_).kind; }
  glm::uvec2 size() const { return size_; }  // of the last update's picture, pixels
  uint32_t scale() const { return scale_; }  // pixels per texel, both ways: 1 or 2
  glm::uvec2 texels() const { return texelsOf(size_, scale_); }  // size of the textures
  uint64_t revision() const { return revision_; }                // of the picture's content

  // How many frames of the present inputs are in the picture: more than 1 while effects average.
  uint32_t frames() const { return frames_; }

  // The values at one pixel, one per channel of the output. The first call after an update() waits
  // for the device.
  std::vector<float> valueAt(bool right, glm::uvec2 pixel);

  // The view depth in metres at pixels of the last update's picture; infinite: sky, or a pixel
  // outside. Empty if nothing was rendered. At most kMostDepths pixels. Waits for the device.
  static constexpr size_t kMostDepths = 16;
  std::vector<double> depthsAt(std::span<const glm::ivec2> pixels);
  // The camera of the last update; null: nothing was rendered.
  const scene::Camera* camera() const { return done_ ? &done_->camera : nullptr; }

  // Makes the next update() render even if no input changes. retry() also renders the held side.
  void touch() { done_.reset(); }
  void retry() {
    done_.reset();
    heldDone_.reset();
  }

  // Reads an output of the last update(): left, right unless it shows held settings, or an extra
  // one.
  image::Image read(const std::string& output) { return renderer_.read(output); }

  // Renders one output at any size, for a file. Makes the screen's picture stale.
  image::Image picture(const StageDesc& desc, const std::string& output);

  // Number of objects still to be drawn in later frames; 0: the picture is complete.
  uint64_t waiting() const { return waiting_; }
  // Objects for which a limit leaves no room.
  uint64_t givenUp() const { return givenUp_; }
  // Objects that are drawn less exactly because of a limit.
  uint64_t coarser() const { return coarser_; }
  // The effects that are on but could not run in the last update().
  const std::vector<frame::LeftOut>& leftOut() const { return renderer_.leftOut(); }

 private:
  struct Side {
    gpu::Texture texture;
    std::string output;
    Kind kind = Kind::kLight;
    std::optional<image::Image> values;  // read at the first valueAt()
  };
  // Every input of a side's picture.
  struct Wanted {
    scene::Camera camera;
    glm::uvec2 size;
    bool halves;
    frame::Surface surface;
    frame::Background background;
    uint64_t revision;
    std::string left, right;
    std::vector<std::string> extra;
    uint64_t objects;  // revision
    uint64_t poses;

    bool operator==(const Wanted& other) const;
  };
  static Wanted wanted(const StageDesc& desc, bool held);
  static uint32_t scaleOf(const StageDesc& desc) { return desc.halves ? 2 : 1; }
  static glm::uvec2 texelsOf(glm::uvec2 pixels, uint32_t scale) {
    return (pixels + scale - 1u) / scale;
  }
  static uint32_t framesWanted(const StageDesc& desc);
  void renderLive(const StageDesc& desc, std::span<const std::string> outputs);
  void render(const StageDesc& desc, glm::uvec2 size, std::span<const std::string> outputs);
  void updateHeld(const StageDesc& desc);
  void makePipelines();

  gpu::Device& device_;
  SceneServices& services_;
  frame::Renderer renderer_;
  effect::StartedChain started_;
  std::optional<Wanted> done_, heldDone_;  // inputs of the rendered sides
  Side left_, right_;
  glm::uvec2 size_ = glm::uvec2(0);
  uint32_t scale_ = 1, frames_ = 0;
  uint64_t waiting_ = 0, heldWaiting_ = 0, givenUp_ = 0, coarser_ = 0, revision_ = 0;
  gpu::Texture held_;  // a copy of the held settings' output
  glm::uvec2 heldSize_ = glm::uvec2(0);
  gpu::ComputePipeline keep_, depths_;
  gpu::Sampler nearest_;
  gpu::Buffer depthsRead_;
};

}  // namespace grisaille::app::viewer
