// SPDX-License-Identifier: MIT
#version 460
#include "common/bindings.glsl"

layout(local_size_x = 8) in;
layout(TEXTURE(0)) uniform sampler2D sampled;
layout(TEXTURE(1)) uniform sampler2D coarse;
layout(IMAGE(0), r32f) readonly uniform image2D image;
layout(STORAGE(0), std430) writeonly buffer Out { vec4 data[]; };

// Three reads of one texture: through a sampler, through a view of its second level, and as an
// image.
void main() {
  const int x = int(gl_GlobalInvocationID.x);
  data[x] = vec4(textureLod(sampled, vec2((float(x) + 0.5) / 8.0, 0.5), 0.0).r,
                 textureLod(coarse, vec2((float(x / 2) + 0.5) / 4.0, 0.5), 0.0).r,
                 imageLoad(image, ivec2(x, 0)).r, 1.0);
}
