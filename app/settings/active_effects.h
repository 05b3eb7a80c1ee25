// SPDX-License-Identifier: MIT
// The effects that a command runs, with their values: what --effects, --config and --set say.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/effect/registry.h"
#include "core/effect/values.h"
#include "core/frame/renderer.h"
#include "core/gpu/device.h"

namespace grisaille::app {

// Loads every effect of effect::searchPaths(pluginPaths).
std::unique_ptr<effect::Registry> loadEffects(const std::vector<std::string>& pluginPaths);

class ActiveEffects {
 public:
  // In this order. Throws kEffectUnknown, kEffectTwice.
  ActiveEffects(const effect::Registry& registry, const std::vector<std::string>& keys);

  // "ssao.radius=0.5". Throws kUsage, kEffectUnknown where the effect is not active, kParameter*.
  void set(const std::string& assignment);

  // Throws kEffectUnknown unless the effect is active.
  effect::Values& values(std::string_view key);

  std::vector<const effect::Effect*> effects() const;

  // An instance of each on a device, which they must not outlive.
  std::vector<std::unique_ptr<effect::Instance>> start(gpu::Device& device) const;

  // These instances with their values, for a frame.
  std::vector<frame::ActiveEffect> with(
      const std::vector<std::unique_ptr<effect::Instance>>& instances) const;

 private:
  const effect::Registry& registry_;
  std::vector<std::unique_ptr<effect::Values>> values_;
};

}  // namespace grisaille::app
