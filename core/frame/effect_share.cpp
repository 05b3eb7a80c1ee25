// SPDX-License-Identifier: MIT
#include "core/frame/effect_share.h"

#include <algorithm>

#include "core/effect/chain.h"
#include "core/frame/scene_attachments.h"

namespace grisaille::frame {

double guardShare(const effect::Selection& selection, uint32_t width, uint32_t height) {
  double band = 0;
  for (const effect::Selection::Entry& entry : selection.entries()) {
    if (entry.on) band = std::max<double>(band, effect::guardBand(entry.values, height));
  }
  return 1 - double{1} * width * height / ((width + 2 * band) * (height + 2 * band));
}

double shareForEffects(std::string_view pass, double guardShare) {
  const bool guarded = pass.starts_with(kGuardedPasses);
  const bool scene = guarded || pass.starts_with(kScenePasses);
  if (!scene) return 0;
  pass.remove_prefix(guarded ? kGuardedPasses.size() : kScenePasses.size());
  if (pass.starts_with(SceneAttachments::kBackPasses)) return 1;
  if (pass.starts_with(SceneAttachments::kNextPasses)) return 1;
  return guarded ? guardShare : 0;
}

}  // namespace grisaille::frame
