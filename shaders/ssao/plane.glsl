// SPDX-License-Identifier: MIT
// Normals in view space, and how far a pixel's surface lies from another's plane.

// Axes with z along n, a unit vector, in one branchless step (Duff et al. 2017).
mat3 basisAbout(vec3 n) {
  const float s = n.z >= 0.0 ? 1.0 : -1.0;
  const float a = -1.0 / (s + n.z);
  const float b = n.x * n.y * a;
  return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

// A surface without a direction is taken to face the camera.
vec3 viewNormal(vec3 world_normal) {
  return dot(world_normal, world_normal) < 0.25 ? vec3(0.0, 0.0, 1.0)
                                                : mat3(view.view_from_world) * world_normal;
}

// The plane through a pixel's surface, for points put back into view space from pixels: the distance
// of pixel p at view depth d from it is d * (p.x * x + p.y * y + z) + w.
vec4 planeOf(vec2 pixel, float depth, vec3 normal) {
  vec4 plane;
  plane.xy = normal.xy * view.view_from_pixel.xy;
  plane.z = dot(normal.xy, view.view_from_pixel.zw) - normal.z;
  plane.w = -depth * (dot(plane.xy, pixel) + plane.z);
  return plane;
}

float distanceFrom(vec4 plane, vec2 pixel, float depth) {
  return abs(depth * (dot(plane.xy, pixel) + plane.z) + plane.w);
}
