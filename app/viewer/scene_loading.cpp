// SPDX-License-Identifier: MIT
#include "app/viewer/scene_loading.h"

#include <fmt/format.h>

#include <chrono>

#include "core/scene/built_in.h"

namespace grisaille::app::viewer {

std::string sceneLabel(const std::string& path) {
  const scene::BuiltIn* builtIn = scene::findBuiltIn(path);
  return builtIn != nullptr ? fmt::format("built-in {}", builtIn->name) : path;
}

SceneLoading::~SceneLoading() {
  if (result_.valid()) result_.wait();
}

void SceneLoading::start(const std::string& path) {
  path_ = path;
  *progress_ = 0;
  result_ = std::async(std::launch::async, [path, progress = progress_] {
    const auto report = [&](double share) { *progress = share; };
    return std::make_shared<scene::Scene>(scene::loadScene(path, report));
  });
}

std::shared_ptr<scene::Scene> SceneLoading::take() {
  if (!result_.valid() || result_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    return nullptr;
  }
  return result_.get();
}

}  // namespace grisaille::app::viewer
