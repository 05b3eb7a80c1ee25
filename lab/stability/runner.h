// SPDX-License-Identifier: MIT
// Renders a case on every backend, and compares the picture with the oracle's and with the other
// backend's.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/effect/registry.h"
#include "core/frame/renderer.h"
#include "core/gpu/device.h"
#include "lab/oracle/view.h"
#include "lab/stability/result.h"

namespace grisaille::lab::stability {

// A picture of visibility, and the input from which the effect computed it.
struct Seen {
  image::Image ao;
  oracle::View view;
};

// A case's picture and the oracle's, which is NaN at pixels that were not compared.
struct Compared {
  image::Image picture, expected;
};

class Runner {
 public:
  // Both must outlive this object. `devices` belong to different backends.
  Runner(const effect::Registry& registry, std::span<gpu::Device* const> devices);
  ~Runner();
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  // Stores an error on a backend in BackendResult::error. Throws kDeviceLost.
  Result run(const Case& one);

  // Compares on the first backend. The case must run there without an error.
  Compared compare(const Case& one);

  size_t backends() const { return stages_.size(); }
  const std::string& backend(size_t index) const;
  // Renders a case of ssao on one backend. Throws what the device and the effect throw.
  Seen see(size_t backend, const Case& one);

 private:
  struct Stage;
  struct Picture;
  BackendResult runOn(Stage& stage, const Case& one, const scene::Scene& scene, Picture& picture);
  void choose(Stage& stage, const Case& one);
  void render(Stage& stage, const Case& one, const scene::Scene& scene, Picture& picture);

  const effect::Registry& registry_;
  std::vector<std::unique_ptr<Stage>> stages_;
};

}  // namespace grisaille::lab::stability
