// SPDX-License-Identifier: MIT
// Measures a claim on a device.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/truth/progress.h"
#include "core/gpu/device.h"
#include "core/image/image.h"
#include "core/scene/scene.h"
#include "lab/claims/claims.h"

namespace grisaille::lab::claims {

struct ClaimPicture {
  std::string name;  // a run's name, or "truth"
  image::Image8 picture;
};

// Pictures of all runs with one camera. The truth comes first, unless the pictures show changes.
using PictureRow = std::vector<ClaimPicture>;

struct ExpectationResult {
  double left = 0,
         right = 0;  // right-hand term without its factor; without a term, the number
  bool holds = false, timed = false;
};

struct ClaimResult {
  // By run, then by quantity: all quantities that an expectation names, for all runs of the claim.
  std::map<std::string, std::map<std::string, double>> values;
  std::vector<ExpectationResult> expectations;  // as the claim lists them
  std::vector<PictureRow> pictures;

  bool holds() const;  // whether all expectations hold
};

struct ClaimsDesc {
  const effect::Registry* registry = nullptr;
  uint32_t samples = 256;  // the truth's rays per pixel
  uint32_t rounds = 5;     // times that each run's cost is measured; runs take turns
  app::truth::ProgressStyle progress = app::truth::ProgressStyle::kNone;  // of ray casting
};

class ClaimsRunner {
 public:
  // `device` must time its passes and outlive this object.
  ClaimsRunner(const ClaimsDesc& desc, gpu::Device& device);
  ~ClaimsRunner();

  // Throws kSettingsInvalid if a region has no pixels, kScene*, app::truth::Interrupted.
  ClaimResult run(const Claim& claim);

 private:
  struct Run;
  struct View;
  class Stage;

  scene::Scene& sceneOf(const Claim& claim);

  ClaimsDesc desc_;
  gpu::Device& device_;
  std::map<std::pair<std::string, bool>, scene::Scene> scenes_;  // by path and floor
};

}  // namespace grisaille::lab::claims
