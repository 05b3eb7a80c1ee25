// SPDX-License-Identifier: MIT
// Renders settings of effects, and measures the error and the cost of each.
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
#include "core/scene/scene.h"

namespace grisaille::app::study {

// One camera with its truth.
struct View {
  std::string scene;  // name of the scene in a gallery, for reports; "": the only one
  std::string name;   // for reports
  scene::Camera camera;
  image::Image truth;  // one channel; NaN at pixels without a surface
  double noise = 0;    // rms standard error of the truth
};

// The scene, cameras and effects that a study measures.
struct Subject {
  const scene::Scene* scene = nullptr;
  std::vector<View> views;
  glm::uvec2 size = glm::uvec2(640, 360);
  const effect::Registry* registry = nullptr;
  std::vector<std::string> effects;                 // in the order they run
  std::vector<effect::ParameterValue> lengths;      // chosen for the scene; `sets` override them
  std::vector<effect::Assignment> sets;             // a setting's values override them
  std::string output;                               // the output to compare with the truth
  std::map<std::string, objects::Objects> objects;  // by effect
};

// Returns the only channel of an output, or the last of four, which is alpha. Throws kEffectOutput
// if a value is not finite, kSettingsInvalid for any other number of channels.
image::Image oneChannel(image::Image picture, const std::string& name);

// Makes the lengths the defaults of the selection; see effect::Values::fit().
void fit(effect::Selection& selection, const std::vector<effect::ParameterValue>& lengths);

// Mean cost of `effects` per frame, milliseconds: the passes with labels "EFFECT/...", and the
// effects' share of the passes that draw the scene, see frame::shareForEffects(). `guardShare`:
// from frame::guardShare(). Returns 0 if there are no frames.
double costOf(const std::vector<gpu::FrameTimes>& frames, const std::vector<std::string>& effects,
              double guardShare);

class Measurer {
 public:
  // `subject` and `device` must outlive this. The device must measure pass times.
  Measurer(const Subject& subject, gpu::Device& device);

  // Starts a chain with the values of a setting. The first frame creates its pipelines. Throws as
  // Selection::set() and Chain::start() do.
  std::unique_ptr<effect::Chain> start(const Setting& setting);

  // Gives a chain that a measurer of the same effects has started the values of a setting, with the
  // lengths and objects of this subject.
  void apply(const Setting& setting, effect::Chain& chain);

  // Renders the output from a camera. Returns its oneChannel().
  image::Image show(effect::Chain& chain, const scene::Camera& camera);

  // Receives the rendered picture of each view.
  using Seen = std::function<void(const View& view, const image::Image& shown)>;

  // The errors of each view. The rmse excludes the truth's noise: the truth's squared standard
  // error is subtracted from the squared rmse, since squares of independent errors add up. Throws
  // as show() does.
  std::vector<CameraErrors> errors(effect::Chain& chain, const Seen& seen = {});

  // Cost of the effects for each view, milliseconds; see costOf().
  std::vector<double> costs(effect::Chain& chain);
  // Their mean.
  double cost(effect::Chain& chain);

 private:
  void render(effect::Chain& chain, const scene::Camera& camera);

  const Subject& subject_;
  gpu::Device& device_;
  SceneServices services_;
  frame::Renderer renderer_;
};

}  // namespace grisaille::app::study
