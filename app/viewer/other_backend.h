// SPDX-License-Identifier: MIT
// Renders the right side of the picture on another backend, without a window, and brings it to the
// window's device as a texture.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/viewer/screen.h"
#include "app/viewer/stage.h"
#include "backends/backends.h"
#include "core/effect/chain.h"

namespace grisaille::app::viewer {

class OtherBackend {
 public:
  // `options`: of the other device. `device`: the window's, which must outlive this. Throws as
  // backends::create() does.
  OtherBackend(const std::string& backend, const gpu::DeviceOptions& options, gpu::Device& device);
  ~OtherBackend();
  OtherBackend(const OtherBackend&) = delete;
  OtherBackend& operator=(const OtherBackend&) = delete;

  const std::string& backend() const { return backend_; }

  // Forgets the scene and the effects, which may then end. update() starts them again.
  void forget();

  // True if update() would render. `desc`: the right side, as Stage takes it for its left; its
  // chain gives the objects, `effects` the settings.
  bool isStale(const scene::Scene& scene, StageDesc desc, const effect::Selection& effects);

  // Renders and brings the picture over. All arguments but `desc` must live until forget(). Throws
  // as Stage::update() does.
  void update(const scene::Scene& scene, SceneServices& services, StageDesc desc,
              const effect::Selection& effects);

  // None before the first update() since forget(). Valid until the next update().
  std::optional<Side> side() const;
  std::vector<float> valueAt(glm::uvec2 pixel) const;
  uint64_t revision() const { return revision_; }  // of the side's content; only grows
  uint64_t waiting() const { return stage_ ? stage_->waiting() : 0; }

 private:
  StageDesc ownDesc(StageDesc desc, const effect::Selection& effects);
  void bringOver();

  std::string backend_;
  gpu::Device& window_;
  std::unique_ptr<gpu::Device> device_;
  const scene::Scene* scene_ = nullptr;  // of the stage
  effect::Chain chain_;
  std::map<std::string, uint64_t, std::less<>> copied_;  // revisions of lists in the chain
  std::unique_ptr<Stage> stage_;
  image::Image values_;
  gpu::Texture texture_;  // of the window's device
  gpu::TextureDesc made_;
  Kind kind_ = Kind::kLight;
  uint64_t revision_ = 1;
};

}  // namespace grisaille::app::viewer
