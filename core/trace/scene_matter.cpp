// SPDX-License-Identifier: MIT
#include "core/trace/scene_matter.h"

#include "core/base/error.h"
#include "core/scene/rig.h"
#include "core/trace/background.h"
#include "core/trace/buried.h"

namespace grisaille::trace {
namespace {

std::vector<bool> findBuried(const scene::Scene& scene) {
  std::vector<bool> buried(scene.indices.size() / 3);
  if (scene.rig != nullptr) return buried;
  try {
    leavingACore([&] { buried = buriedTriangles(scene); });
  } catch (const Error&) {
    // Embree cannot take the scene. It is drawn all the same.
  }
  return buried;
}

}  // namespace

void SceneMatter::prepare() {
  if (matter_ || finding_.valid() || scene_.rig != nullptr) return;
  finding_ = std::async(std::launch::async, [this] { return scene::matterOf(scene_); });
}

void SceneMatter::prepareBuried() {
  if (buried_ || burying_.valid() || scene_.rig != nullptr) return;
  burying_ = std::async(std::launch::async, [this] { return findBuried(scene_); });
}

const scene::Matter& SceneMatter::get() {
  if (matter_) return *matter_;
  if (finding_.valid()) return matter_.emplace(finding_.get());
  if (scene_.rig == nullptr) return matter_.emplace(scene::matterOf(scene_));
  // A picture of a pose must not depend on the poses that were drawn before it.
  scene::Scene rest = scene_;
  scene::pose(rest, {});
  return matter_.emplace(scene::matterOf(rest));
}

const std::vector<bool>& SceneMatter::buried() {
  if (buried_) return *buried_;
  return buried_.emplace(burying_.valid() ? burying_.get() : findBuried(scene_));
}

}  // namespace grisaille::trace
