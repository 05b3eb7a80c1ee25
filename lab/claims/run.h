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
#include "lab/claims/claims.h"

namespace grisaille::lab::claims {

struct ClaimPicture {
  std::string name;  // of a run, or "truth"
  image::Image8 picture;
};

// What the runs of one camera show, the truth first where the pictures show what is measured.
using PictureRow = std::vector<ClaimPicture>;

struct ExpectationResult {
  double left = 0,
         right = 0;  // the right hand without its factor; the number where there is no term
  bool holds = false, timed = false;
};

struct ClaimResult {
  // By run, then by quantity: every quantity that an expectation names, of every run of the claim.
  std::map<std::string, std::map<std::string, double>> values;
  std::vector<ExpectationResult> expectations;  // as the claim lists them
  std::vector<PictureRow> pictures;

  bool holds() const;  // all expectations do
};

struct ClaimsDesc {
  const effect::Registry* registry = nullptr;
  uint32_t samples = 256;  // the truth's rays a pixel
  uint32_t rounds = 5;     // how often a cost is measured, all runs in turn
  app::truth::ProgressStyle progress = app::truth::ProgressStyle::kNone;  // while rays are cast
};

class ClaimsRunner {
 public:
  // The device times its passes. It outlives this.
  ClaimsRunner(const ClaimsDesc& desc, gpu::Device& device);
  ~ClaimsRunner();

  // Throws kSettingsInvalid where a region has no pixels, kScene*, app::truth::Interrupted.
  ClaimResult run(const Claim& claim);

 private:
  struct Run;
  struct View;
  class Stage;

  const scene::Scene& sceneOf(const std::string& path);

  ClaimsDesc desc_;
  gpu::Device& device_;
  std::map<std::string, scene::Scene> scenes_;
};

}  // namespace grisaille::lab::claims
