// SPDX-License-Identifier: MIT
#include "app/viewer/scene_loading.h"

#include <fmt/format.h>

#include <chrono>

#include "core/base/error.h"
#include "core/scene/built_in.h"

namespace grisaille::app::viewer {

std::string sceneLabel(const std::string& path) {
  const scene::BuiltIn* builtIn = scene::findBuiltIn(path);
  return builtIn != nullptr ? fmt::format("built-in {}", builtIn->name) : path;
}

SceneLoading::~SceneLoading() {
  cancel();
  for (const Result& result : ending_) result.wait();
}

void SceneLoading::start(const std::string& path) {
  path_ = path;
  progress_ = std::make_shared<std::atomic<double>>(0);
  cancelled_ = std::make_shared<std::atomic<bool>>(false);
  ended_ = std::make_shared<std::atomic<bool>>(false);
  result_ = std::async(std::launch::async, [path, progress = progress_, cancelled = cancelled_,
                                            ended = ended_, wake = wake_] {
    // Also at an error. The future is ready only after this.
    const std::shared_ptr<void> end(nullptr, [&](void*) {
      *ended = true;
      wake();
    });
    const auto report = [&](double share) {
      if (*cancelled) throw Error(ErrorId::kSceneUnreadable, "{}: cancelled", path);
      *progress = share;
    };
    return std::make_shared<scene::Scene>(scene::readScene(path, report));
  });
}

void SceneLoading::cancel() {
  std::erase_if(ending_, [](const Result& result) {
    return result.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  });
  if (!result_.valid()) return;
  *cancelled_ = true;
  ending_.push_back(std::move(result_));
  result_ = {};
}

std::shared_ptr<scene::Scene> SceneLoading::take() {
  if (!result_.valid() || !*ended_) return nullptr;
  return result_.get();
}

}  // namespace grisaille::app::viewer
