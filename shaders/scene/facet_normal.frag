#version 460
// SPDX-License-Identifier: MIT
// Reconstructs facet normals from depth, as unit world normals, for pictures without normals.
#extension GL_GOOGLE_include_directive : require
#include "common/view.glsl"

#include "facet_normal.glsl"

layout(location = 0) out vec4 world_normal;

void main() {
  const vec4 normal = facetNormal(ivec2(gl_FragCoord.xy));
  world_normal = vec4(transpose(mat3(view.view_from_world)) * normal.xyz, normal.w);
}
