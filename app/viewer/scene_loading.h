// SPDX-License-Identifier: MIT
// Reads a scene on its own thread, while the window's thread goes on drawing.
#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace grisaille::app::viewer {

// What the viewer calls the scene of a path: "built-in leaves", or the path itself.
std::string sceneLabel(const std::string& path);

class SceneLoading {
 public:
  // `wake` is called on the reading thread once take() has a result.
  explicit SceneLoading(std::function<void()> wake) : wake_(std::move(wake)) {}
  ~SceneLoading();  // cancels, and waits for the threads

  bool running() const { return result_.valid(); }
  double progress() const { return *progress_; }  // 0 ... 1
  const std::string& path() const { return path_; }

  // Starts to read a scene; "" and the name of a built-in scene stand for that. Do not call while
  // running().
  void start(const std::string& path);

  // Ends the reading without a result: running() is false at once. The thread ends at its next
  // report of progress.
  void cancel();

  // The scene, once; null while it is still being read or nothing was started. Throws the errors of
  // scene::readScene().
  std::shared_ptr<scene::Scene> take();

 private:
  std::function<void()> wake_;
  std::string path_;
  using Result = std::future<std::shared_ptr<scene::Scene>>;

  std::shared_ptr<std::atomic<double>> progress_ = std::make_shared<std::atomic<double>>(0);
  std::shared_ptr<std::atomic<bool>> cancelled_, ended_;  // of result_
  Result result_;
  std::vector<Result> ending_;  // of cancelled readings
};

}  // namespace grisaille::app::viewer
