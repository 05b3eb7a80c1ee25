// SPDX-License-Identifier: MIT
// The lens, and the tiles of the picture that both passes share.
#include "common/view.glsl"

layout(UNIFORM(1), std140) uniform Lens {
  float focus;     // view depth of the plane in focus, metres
  float aperture;  // diameter of the lens, metres
  float largest;   // largest radius of a blur disc, pixels
  float samples;
} lens;

const uint kTile = 16;  // pixels on a side of a tile, and threads on a side of a workgroup
layout(local_size_x = kTile, local_size_y = kTile) in;
