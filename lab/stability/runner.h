// SPDX-License-Identifier: MIT
// Makes a case's picture on every backend, and compares it with the oracle and with the other one.
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

// A picture of visibility, and what the effect read to make it.
struct Seen {
  image::Image ao;
  oracle::View view;
};

// A case's picture and the oracle's, NaN where that was not asked.
struct Compared {
  image::Image picture, expected;
};

class Runner {
 public:
  // Both outlive this; `devices` are of different backends.
  Runner(const effect::Registry& registry, std::span<gpu::Device* const> devices);
  ~Runner();
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  // What fails on a backend is told in its result.
  Result run(const Case& one);

  // On the first backend, of a case that it can run.
  Compared compare(const Case& one);

  size_t backends() const { return stages_.size(); }
  const std::string& backend(size_t index) const;
  // Of a case of ssao, on one backend. Throws what the device and the effect do.
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
