// SPDX-License-Identifier: MIT
// A scene read beside the window's thread.
#pragma once

#include <atomic>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "core/scene/scene.h"

namespace grisaille::app::viewer {

class SceneLoading {
 public:
  ~SceneLoading();  // waits for what is being read

  bool running() const { return result_.valid(); }
  double progress() const { return *progress_; }  // 0 ... 1
  const std::string& path() const { return path_; }

  // "": the built-in scene. Not while one is running.
  void start(const std::string& path);

  // The scene once it is read. Throws Error as scene::loadGltf() does. Null: it is still being
  // read.
  std::shared_ptr<const scene::Scene> take();

 private:
  std::string path_;
  std::shared_ptr<std::atomic<double>> progress_ = std::make_shared<std::atomic<double>>(0);
  std::future<std::shared_ptr<const scene::Scene>> result_;
};

}  // namespace grisaille::app::viewer
