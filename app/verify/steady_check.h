// SPDX-License-Identifier: MIT
// Checks that equal frames give equal outputs, and that an effect frees what it makes.
#pragma once

#include <string>
#include <vector>

#include "app/services/scene_services.h"
#include "app/verify/shader_variants.h"
#include "app/verify/verify.h"
#include "core/effect/chain.h"
#include "core/frame/renderer.h"

namespace grisaille::app {

class SteadyCheck {
 public:
  // All arguments must outlive this. `chain` holds the effect alone; `outputs` are the full names
  // of its outputs. `title` begins each line of the report.
  SteadyCheck(Report& report, gpu::Device& device, const scene::Scene& scene,
              SceneServices& services, effect::Chain& chain,
              const std::vector<std::string>& outputs, const std::string& title)
      : report_(report),
        device_(device),
        scene_(scene),
        services_(services),
        chain_(chain),
        outputs_(outputs),
        title_(title) {}

  // Ends the chain's instance and creates it anew. Takes a bit more than a second.
  void run();

 private:
  using Pictures = std::vector<image::Image>;  // one per output

  void render(frame::Renderer& renderer, int frames);
  Pictures read(frame::Renderer& renderer) const;
  Pictures drawAfresh(bool once, Variant variant = Variant::kPlain);
  void checkVariants(const Pictures& plain);
  // Returns whether the pictures are the same: bit for bit, or within `allowed` of each value, at
  // least of 1. `cause`: which faults have one cause.
  bool compare(const Pictures& one, const Pictures& other, const std::string& fault,
               const char* cause = "unsteady", float allowed = 0);
  void checkGrowth();

  Report& report_;
  gpu::Device& device_;
  const scene::Scene& scene_;
  SceneServices& services_;
  effect::Chain& chain_;
  const std::vector<std::string>& outputs_;
  const std::string& title_;
};

}  // namespace grisaille::app
