// SPDX-License-Identifier: MIT
// Step 9 of effects/ssao/README.md: visibility averaged over the frames that saw the same surface.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "lab/oracle/occlusion.h"

namespace grisaille::lab::oracle {

// Visibility averaged over frames, and over how many.
struct Mean {
  double open = 1, frames = 1;
};

// The means of a frame, and how it was seen.
struct PastFrame : Past {
  PastFrame(const View& seen, int pixels, int count, Lazy<Mean>& all)
      : view(seen), scale(pixels), frames(count), texels(all.size()) {
    for (int y = 0; y < texels.y; ++y) {
      for (int x = 0; x < texels.x; ++x) means.push_back(all({x, y}));
    }
  }
  // What the frame averaged of a surface at a place in the world, with its normal there; 0 frames:
  // it did not see it.
  Mean seenAt(const glm::dvec3& place, const glm::dvec3& normal) const;

  const View& view;  // outlives this
  int scale;         // pixels a texel
  int frames;        // since there was nothing
  glm::ivec2 texels;
  std::vector<Mean> means;
};

}  // namespace grisaille::lab::oracle
