// SPDX-License-Identifier: MIT
// What is measured and against what: the options that `measure` and `tune` share.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "app/study/measurer.h"
#include "app/truth/progress.h"

namespace grisaille::app {

struct SubjectOptions {
  std::string scene, size = "640x360", output;
  std::vector<std::string> cameras, references, loads, sets, effects, pluginPaths;
  double radius = 0.5;     // metres
  uint32_t samples = 256;  // rays a pixel
  truth::ProgressStyle progress = truth::usualProgress();

  void addTo(CLI::App& command);
};

// A study's subject with all that it points to.
class LoadedSubject {
 public:
  // Checks the options, but loads neither the scene nor the truth: see trace(). `registry`: the
  // effects of options.pluginPaths. `swept`: effects that run even if no option names them. Throws
  // as what it loads does, and kUsage.
  LoadedSubject(const SubjectOptions& options, std::unique_ptr<effect::Registry> registry,
                const std::vector<std::string>& swept);

  LoadedSubject(const LoadedSubject&) = delete;
  LoadedSubject& operator=(const LoadedSubject&) = delete;

  const effect::Registry& registry() const { return *registry_; }
  const study::Subject& subject() const { return subject_; }

  // Loads the scene and the cameras.
  void loadScene();

  // Traces the truth of every camera, or takes it from the cache. Throws truth::Interrupted.
  void trace();

  // Of one more camera. `bar` is the progress bar's name.
  study::View viewOf(const std::string& name, const scene::Camera& camera,
                     const std::string& bar) const;

  // Text: all that results depend on but setting and backend.
  std::string key() const;

  // The command that makes a setting's picture of the first camera.
  std::string renderCommand(const study::SettingText& setting, const std::string& backend) const;

 private:
  void loadObjects(effect::Chain& chain);

  SubjectOptions options_;
  std::unique_ptr<effect::Registry> registry_;
  scene::Scene scene_;
  study::Subject subject_;
  struct Place {
    std::string name;
    scene::Camera camera;
    std::string reference;  // a picture; "": traced
  };
  study::View referenceOf(const Place& place) const;

  std::vector<Place> cameras_;
};

}  // namespace grisaille::app
