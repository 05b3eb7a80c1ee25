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

// A plane through a pixel's surface, for points put back into view space from pixels. What lies
// `across` pixels on at view depth e is
//   (e - depth) * facing + e * dot(slope, across)
// from it: differences of nearly equal numbers, so that the pixel itself lies on its plane exactly
// however small the lengths are that this is compared with.
struct Plane {
  vec2 slope;
  float facing;
};

Plane planeOf(vec2 pixel, vec3 normal) {
  const vec2 ray = pixel * view.view_from_pixel.xy + view.view_from_pixel.zw;
  return Plane(normal.xy * view.view_from_pixel.xy, dot(normal.xy, ray) - normal.z);
}

// How far off the plane of a surface at view depth `depth` another is at `other`, `across` pixels on.
float offPlane(Plane plane, float depth, float other, vec2 across) {
  return abs((other - depth) * plane.facing + other * dot(plane.slope, across));
}

// 1 / metres: how far off the plane of a surface at view depth `depth` another may lie to be taken for
// the same: as far as `inverse` allows, 1 / metres, and four pixels' width there, past which grooves
// and ledges of a few pixels are lost.
float toleranceAt(float depth, float inverse) {
  return max(inverse, 0.25 / max(depth * abs(view.view_from_pixel.x), 1e-30));
}
