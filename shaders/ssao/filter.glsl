// SPDX-License-Identifier: MIT
// Bindings of denoise.glsl and edges.glsl. LAST is 1 in the filter's last pass, BENT is 1 with bent
// normals.
#define ORTHOGRAPHIC_ID 7
#include "common/view.glsl"
#include "finish.glsl"
#include "plane.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(UNIFORM(1), std140) uniform Settings {
  vec4 finish;      // see finished() in finish.glsl
  float tolerance;  // inverse of the plane tolerance, 1 / metres
} settings;
layout(TEXTURE(0)) uniform sampler2D source;  // visibility and view depth; nearest, clamped
layout(TEXTURE(1)) uniform usampler2D tangents;  // of facets, see facet.glsl; nearest, clamped
#if BENT
layout(TEXTURE(2)) uniform sampler2D source_bent;
#if LAST
layout(TEXTURE(3)) uniform sampler2D world_normal;
#endif
layout(IMAGE(1), rgba16f) writeonly uniform image2D bent_target;
#endif
#if LAST
layout(IMAGE(0), r16f) writeonly uniform image2D target;
#else
layout(IMAGE(0), rg32f) writeonly uniform image2D target;  // same as source
#endif
