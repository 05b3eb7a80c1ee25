// SPDX-License-Identifier: MIT
// Renders settings of effects and tells how far each is from the truth and what it costs.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/services/scene_services.h"
#include "app/study/record.h"
#include "core/frame/renderer.h"
#include "core/image/image.h"
#include "core/scene/camera.h"

namespace grisaille::app::study {

// One camera with what is right there.
struct View {
  std::string name;  // as it was given
  scene::Camera camera;
  image::Image truth;  // one channel; NaN where there is no surface
  double noise = 0;    // the truth's own rms standard error
};

struct Subject {
  const scene::Scene* scene = nullptr;
  std::vector<View> views;
  glm::uvec2 size = glm::uvec2(640, 360);
  const effect::Registry* registry = nullptr;
  std::vector<std::string> effects;                 // that run, in order
  std::vector<effect::Assignment> sets;             // beneath a setting's values
  std::string output;                               // that is compared with the truth
  std::map<std::string, objects::Objects> objects;  // by effect
};

// One channel of an output: the only one, or of four the last, which is alpha. Throws
// kSettingsInvalid where there are others.
image::Image oneChannel(image::Image picture, const std::string& name);

// Milliseconds a frame that the passes of these effects took, as their own labels name them, and
// what they add to drawing the scene: frame::shareForEffects(); `guardShare` is
// frame::guardShare()'s. 0: no frames.
double costOf(const std::vector<gpu::FrameTimes>& frames, const std::vector<std::string>& effects,
              double guardShare);

class Measurer {
 public:
  // Both outlive this. The device measures times.
  Measurer(const Subject& subject, gpu::Device& device);

  // The chain with a setting's values, started: pipelines are created with the first frame. Throws
  // as Selection::set() and Chain::start() do.
  std::unique_ptr<effect::Chain> start(const Setting& setting);

  // The output as a camera sees it, as oneChannel() takes it.
  image::Image show(effect::Chain& chain, const scene::Camera& camera);

  // Of each view, what is shown there.
  using Seen = std::function<void(const View& view, const image::Image& shown)>;

  // One a view. The truth's noise is taken out of rmse: its square is less the truth's squared
  // standard error, which is what independent errors add. Throws as show() does.
  std::vector<CameraErrors> errors(effect::Chain& chain, const Seen& seen = {});

  // Of the effects' passes, the mean of the views, milliseconds.
  double cost(effect::Chain& chain);

 private:
  void render(effect::Chain& chain, const scene::Camera& camera);

  const Subject& subject_;
  gpu::Device& device_;
  SceneServices services_;
  frame::Renderer renderer_;
};

}  // namespace grisaille::app::study
