#version 460
// SPDX-License-Identifier: MIT
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"

#if NORMAL
layout(location = 0) in vec3 world_normal;
layout(location = 0) out vec4 out_normal;
#endif
#if BASE || MASK
layout(location = 1) in vec2 uv;
layout(TEXTURE(0)) uniform sampler2D base_texture;
#endif
#if COLOUR
layout(location = 3) in vec4 colour;  // of the vertices, linear
#endif
#if BASE
layout(location = NORMAL) out vec4 out_base;
#endif
#if FACET
layout(location = 2) in vec3 from_camera;  // world axes, metres
layout(location = NORMAL + BASE) out vec4 out_facet;
#endif

#if THICKNESS
layout(location = 4) in float matter;
layout(location = NORMAL + BASE + FACET) out float out_thickness;
#endif
#if BEHIND
layout(TEXTURE(1)) uniform sampler2D front;  // clip depth
#endif

void main() {
#if BASE || MASK
  vec4 factor = draw.base_color;
#if COLOUR
  factor *= colour;
#endif
#endif
#if BEHIND == 1
  // Discards fragments nearer than the front surface. The factor keeps two-sided surfaces, whose back
  // has the front's depth up to rounding.
  if (gl_FragCoord.z > texelFetch(front, ivec2(gl_FragCoord.xy), 0).x * 1.000001) discard;
#elif BEHIND == 2
  // Discards fragments that are not behind the back. The factor discards the two-sided surface that
  // is this back.
  if (gl_FragCoord.z >= texelFetch(front, ivec2(gl_FragCoord.xy), 0).x * 0.999999) discard;
#endif
#if FACET
  // Before any discard: screen-space derivatives need all four pixels of the quad.
  const vec3 facet = cross(dFdx(from_camera), dFdy(from_camera));
#endif
#if MASK
  // Reads the mask from mip 0: smaller mips would thin or close leaves. Without base colour, the
  // texture holds only the alpha channel, in r.
#if BASE
  const float alpha = textureLod(base_texture, uv, 0.0).a * factor.a;
#else
  const float alpha = textureLod(base_texture, uv, 0.0).r * factor.a;
#endif
  if (alpha < draw.alpha_cutoff) discard;
#endif
#if NORMAL
  const float facing = gl_FrontFacing ? draw.front_sign : -draw.front_sign;
  // An interpolated normal of length 0 has no direction and becomes 0, same as the sky's.
  const float squared = dot(world_normal, world_normal);
  out_normal = vec4(squared > 0.0 ? world_normal * (facing * inversesqrt(squared)) : vec3(0.0), 1.0);
#endif
#if BASE
  out_base = vec4(texture(base_texture, uv).rgb * factor.rgb, 1.0);
#endif
#if THICKNESS
  out_thickness = matter;
#endif
#if FACET
  const float area = dot(facet, facet);
  const float towards = dot(facet, draw.sight.xyz + draw.sight.w * from_camera) > 0.0 ? -1.0 : 1.0;
  out_facet = vec4(area > 0.0 ? facet * (towards * inversesqrt(area)) : vec3(0.0), 1.0);
#endif
}
