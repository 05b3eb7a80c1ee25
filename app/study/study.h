// SPDX-License-Identifier: MIT
// Measures every setting of a grid: its error against the truth of each camera, once, and its cost,
// round by round over all settings (A B C A B C ...), so that what disturbs the machine is shared.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/active_effects.h"
#include "app/scene_rays.h"
#include "app/study/flicker_run.h"
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
};

struct StudyDesc {
  std::string key;  // all that results depend on but setting and backend
  const scene::Scene* scene = nullptr;
  std::vector<View> views;
  // A camera path's frames, whose pictures the study fills in; null: no flicker is measured.
  std::vector<trace::FlickerFrame>* path = nullptr;
  glm::uvec2 size = glm::uvec2(640, 360);
  const effect::Registry* registry = nullptr;
  std::vector<std::string> effects;  // that run, in order
  std::vector<std::string> sets;     // beneath the swept values
  std::string output;                // that is compared with the truth
  std::string machine, commit;
  uint32_t rounds = 5;
  std::filesystem::path folder;
  // The command that makes a setting's picture from the first camera.
  std::function<std::string(const Setting&, const std::string& backend)> commandOf;
};

// What is done of all that there is to do, in renderings of all views.
using Told = std::function<void(size_t done, size_t all)>;

class Study {
 public:
  // All outlive this.
  Study(const StudyDesc& desc, gpu::Device& device, std::vector<Setting> settings);

  // Begins where the folder's records end; `stop` is asked after each step. False where it stopped.
  bool run(const Told& told, const std::function<bool()>& stop);

 private:
  struct Job {
    Record record;
    std::unique_ptr<ActiveEffects> active;
    std::vector<std::unique_ptr<effect::Instance>> instances;
  };

  void start(Job& job);
  void render(Job& job, const scene::Camera& camera);
  void measureErrors(Job& job);
  void measureFlicker(Job& job);
  void measureCost(Job& job);

  const StudyDesc& desc_;
  gpu::Device& device_;
  SceneRays rays_;
  frame::Renderer renderer_;
  std::vector<Job> jobs_;
};

// Milliseconds a frame that the passes of these effects took, as their own labels name them; 0: no
// frames.
double costOf(const std::vector<gpu::FrameTimes>& frames, const std::vector<std::string>& effects);

// How a picture of one channel differs from the truth: blue where it is too dark, orange where it
// is too bright, full at `full`; grey where the truth is NaN.
image::Image errorMap(const image::Image& shown, const image::Image& truth, float full = 0.25f);

// Pictures of a record: what it shows of the first view, and how that differs from the truth: blue
// where it is too dark, orange where it is too bright, full at 0.25.
std::filesystem::path pictureOf(const std::filesystem::path& folder, const Record& record);
std::filesystem::path errorMapOf(const std::filesystem::path& folder, const Record& record);

}  // namespace grisaille::app::study
