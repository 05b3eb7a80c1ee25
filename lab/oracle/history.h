// SPDX-License-Identifier: MIT
// Step 9 of effects/ssao/README.md (history): averages visibility over the frames that saw the same
// surface.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "lab/oracle/occlusion.h"

namespace grisaille::lab::oracle {

// Visibility averaged over `frames` frames.
struct Mean {
  double open = 1, frames = 1;
};

// The means of a frame, with the view that it was computed from.
struct PastFrame : Past {
  PastFrame(const View& seen, int pixels, int count, Lazy<Mean>& all)
      : view(seen), scale(pixels), frames(count), texels(all.size()) {
    for (int y = 0; y < texels.y; ++y) {
      for (int x = 0; x < texels.x; ++x) means.push_back(all({x, y}));
    }
  }
  // The frame's mean for a surface, given by a world position and its world normal. Its `frames` is
  // 0 if the frame did not see the surface.
  Mean seenAt(const glm::dvec3& place, const glm::dvec3& normal) const;

  const View& view;  // must outlive this object
  int scale;         // pixels per texel
  int frames;        // since the history began
  glm::ivec2 texels;
  std::vector<Mean> means;
};

}  // namespace grisaille::lab::oracle
