// SPDX-License-Identifier: MIT
// Where a scene's matter is: what its own mesh tells, and what rays find.
#pragma once

#include <future>
#include <optional>
#include <vector>

#include "core/scene/bodies.h"

namespace grisaille::trace {

// The matter of one scene, found once: when it is first asked for, or before that in the
// background.
class SceneMatter {
 public:
  // `scene` must outlive this and change only by scene::pose(). The matter is that at rest.
  explicit SceneMatter(const scene::Scene& scene) : scene_(scene) {}

  // Begins to find what get() or buried() return, each on a thread of its own, at the first call,
  // unless the scene can move: scene::pose() must not write what those threads read.
  void prepare();
  void prepareBuried();
  // These wait, or find it now. The errors are those of std::vector.
  const scene::Matter& get();
  // buriedTriangles(), one value per triangle of Scene::indices. None are buried in a scene that
  // can move, if Embree cannot take the scene, and in builds without Embree.
  const std::vector<bool>& buried();

 private:
  const scene::Scene& scene_;
  std::optional<scene::Matter> matter_;
  std::optional<std::vector<bool>> buried_;
  std::future<scene::Matter> finding_;  // these last: their threads read the scene
  std::future<std::vector<bool>> burying_;
};

}  // namespace grisaille::trace
