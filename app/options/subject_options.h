// SPDX-License-Identifier: MIT
// The options that `measure` and `tune` share: scene, cameras, effects, and the truth to compare
// them with.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "app/options/pose_options.h"
#include "app/study/measurer.h"
#include "app/truth/progress.h"

namespace grisaille::app {

struct SubjectOptions {
  std::string scene, size = "640x360", output;
  std::string name;  // of the scene in a gallery; "": the only scene
  // A settings file, and presets as EFFECT=NAME. No option of addTo() sets them; `sets` override
  // both, and the file the presets.
  std::string config;
  std::vector<std::string> presets;
  std::vector<std::string> cameras, references, loads, sets, effects, pluginPaths;
  PoseOptions pose;
  double radius = 0;       // metres; 0: chosen for the scene
  uint32_t samples = 256;  // rays per pixel
  truth::ProgressStyle progress = truth::usualProgress();

  void addTo(CLI::App& command);
};

// A study's subject, with the scene, effects and objects that it points to.
class LoadedSubject {
 public:
  // Checks the options and loads objects and cameras; loadScene() and trace() load the rest.
  // `registry`: the effects of options.pluginPaths. `swept`: parameters whose effects run even if
  // no option names them. Throws kUsage, and the errors of cameras, objects, effects and their
  // parameters.
  LoadedSubject(const SubjectOptions& options, std::shared_ptr<const effect::Registry> registry,
                const std::vector<effect::ParameterName>& swept);

  LoadedSubject(const LoadedSubject&) = delete;
  LoadedSubject& operator=(const LoadedSubject&) = delete;

  const effect::Registry& registry() const { return *registry_; }
  const study::Subject& subject() const { return subject_; }

  // Loads the scene. Takes its default camera and chooses the radius and the scene's lengths, if no
  // option gives them; prints the lengths.
  void loadScene();

  // The first camera; its size is not set. Call it after loadScene().
  const scene::Camera& firstCamera() const { return cameras_.front().camera; }

  // Length of the truth's rays, metres. Call it after loadScene().
  double radius() const { return options_.radius; }

  // Traces the truth of every camera, or takes it from the cache. Throws truth::Interrupted.
  void trace();

  // Traces the truth of one more camera. `name`: the view's name. `bar`: name of the progress bar.
  // Throws truth::Interrupted.
  study::View viewOf(const std::string& name, const scene::Camera& camera,
                     const std::string& bar) const;

  // Everything that results depend on except setting and backend, as text. Call it after trace().
  std::string key() const;

  // The command line that renders a setting's picture from the first camera.
  std::string renderCommand(const study::SettingText& setting, const std::string& backend) const;

 private:
  effect::Chain chooseEffects();
  void loadObjects(effect::Chain& chain);
  void chooseLengths();

  SubjectOptions options_;
  scene::Pose pose_;
  std::vector<effect::ParameterName> swept_;
  std::shared_ptr<const effect::Registry> registry_;
  scene::Scene scene_;
  study::Subject subject_;
  struct Place {
    std::string name;
    scene::Camera camera;
    std::string reference;  // a picture file; "": trace the truth
  };
  study::View referenceOf(const Place& place) const;

  std::vector<Place> cameras_;
};

}  // namespace grisaille::app
