// SPDX-License-Identifier: MIT
// out = texture * gain * table[kEntry]
#version 460
#include "common/view.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint kEntry = 0u;
layout(UNIFORM(1), std140) uniform Settings { float gain; };
layout(STORAGE(0), std430) readonly buffer Table { float table[]; };
layout(TEXTURE(0)) uniform sampler2D source;
layout(IMAGE(0), r32f) uniform writeonly image2D target;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(view.size.xy)))) return;
  vec2 at = (vec2(pixel) + 0.5) * view.size.zw;
  imageStore(target, pixel, vec4(textureLod(source, at, 0.0).x * gain * table[kEntry]));
}
