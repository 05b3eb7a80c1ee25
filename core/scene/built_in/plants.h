// SPDX-License-Identifier: MIT
// Trees, hedges and grass. A plant stands on y = 0 and grows along +y. Lengths are in metres.
#pragma once

#include <cstdint>

#include "core/image/image.h"
#include "core/scene/mesh_builder.h"

namespace grisaille::scene {

struct Plant {
  Solid wood;    // closed tubes
  Solid leaves;  // cards for twigTexture() or hedgeTexture()
};

struct TreeForm {
  double height = 4;           // of the trunk
  double radius = 0.1;         // of the trunk, at the ground
  double clear = 1.2;          // height of the lowest branch
  uint32_t branches = 8;       // that leave the trunk
  double reach = 1.4;          // length of the lowest branch
  double card = 0.3;           // length of a leaf card
  uint32_t cardsPerTwig = 19;  // each branch has 5 twigs
};
Plant tree(const TreeForm& form, uint32_t seed);

// A clipped hedge along x. size: length, height, depth
Plant hedge(const glm::dvec3& size, uint32_t cards, uint32_t seed);

// A tuft of blades, each a sheet that narrows to its tip.
Solid grass(uint32_t blades, double radius, double height, uint32_t seed);

// Textures of leaf cards, alpha 0 between the leaves: a twig with leaves on both sides, and a dense
// spray of small leaves. The stem enters at the middle of the lower edge.
image::Image8 twigTexture();
image::Image8 hedgeTexture();

}  // namespace grisaille::scene
