// SPDX-License-Identifier: MIT
// Normals in view space, planes of surfaces, and the distance of a surface from such a plane: the
// range term of the bilateral weights in denoise.glsl, edges.glsl, upsample.glsl and refined.glsl.

// Orthonormal basis whose z axis is the unit vector n, without a branch (Duff et al. 2017,
// "Building an Orthonormal Basis, Revisited").
mat3 basisAbout(vec3 n) {
  const float s = n.z >= 0.0 ? 1.0 : -1.0;
  const float a = -1.0 / (s + n.z);
  const float b = n.x * n.y * a;
  return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

// World normal to view space. A normal of length 0 becomes (0, 0, 1), towards the camera.
vec3 viewNormal(vec3 world_normal) {
  return dot(world_normal, world_normal) < 0.25 ? vec3(0.0, 0.0, 1.0)
                                                : mat3(view.view_from_world) * world_normal;
}

// Tangent plane of a pixel's surface. A surface at view depth e, `across` pixels away, has the
// signed distance
//   (e - depth) * facing + depthScale(e) * dot(slope, across)
// from the plane. The form subtracts depths before it multiplies: the pixel itself is at a distance
// of exactly 0, at any scale of the tolerance.
struct Plane {
  vec2 slope;
  float facing;
};

Plane planeOf(vec2 pixel, vec3 normal) {
  return Plane(normal.xy * view.view_from_pixel.xy, dot(normal, rayDirection(pixel)));
}

// The plane of a facet whose slopes in x and y are `tangent`: metres of view depth per metre across.
Plane planeOfTangent(vec2 pixel, vec2 tangent) {
  const float towards = dot(tangent, rayDirection(pixel).xy) - 1.0;
  const float facing = inversesqrt(dot(tangent, tangent) + towards * towards);
  return Plane(tangent * view.view_from_pixel.xy * facing, facing);
}

// Distance of a surface at view depth `other`, `across` pixels away, from the tangent plane of a
// surface at view depth `depth`. Metres, unless the caller has scaled the plane.
float planeDistance(Plane plane, float depth, float other, vec2 across) {
  return abs((other - depth) * plane.facing + depthScale(other) * dot(plane.slope, across));
}

// A surface's point, raised along its normal by the effect's bias. Matter lower than that does not
// occlude it.
struct Raised {
  vec3 position;  // view space
  vec2 moved;     // how far it moves in the picture, pixels; without a bias exactly 0
  bool hidden;    // not in front of the near plane: nothing in the picture occludes it
};

Raised raised(vec3 position, vec3 normal, float bias) {
  const vec3 up = bias * normal, at = position + up;
  const vec2 across = up.xy + position.xy / -position.z * (up.z * perspective());
  return Raised(at, across / depthScale(max(-at.z, 1e-30)) * view.pixel_from_view.xy,
                bias > 0.0 && -at.z <= view.planes.x);
}

// Upper limits of the plane tolerance. Of the denoiser and of the upsampling: texels. Of the denoiser
// of refined pixels: pixels.
const float kTexelTolerance = 0.75, kBetweenTolerance = 0.375, kRefinedTolerance = 1.0;

// Inverse of the plane tolerance at view depth `depth`, 1 / metres. The tolerance is the lesser of
// 1 / `inverse` and the width of `pixels` pixels at that depth: a larger one would smear grooves and
// ledges of a few pixels.
float toleranceAt(float depth, float inverse, float pixels) {
  return max(inverse, 1.0 / max(pixels * depthScale(depth) * abs(view.view_from_pixel.x), 1e-30));
}
