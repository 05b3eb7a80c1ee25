// SPDX-License-Identifier: MIT
// What the last pass does to a visibility.

// The light that gets to a surface of which a share `open` is unoccluded, and which, as all about it,
// throws back a share `albedo`: rays that surfaces stop then bring light too. Jimenez et al. 2016,
// "Practical Real-Time Strategies for Accurate Indirect Occlusion", their fit to path-traced scenes,
// for each component.
vec3 bounced(float open, vec3 albedo) {
  const vec3 a = 2.0404 * albedo - 0.3324;
  const vec3 b = 4.7951 * albedo - 0.6417;
  const vec3 c = 2.7552 * albedo + 0.6903;
  return min(max(vec3(open), ((open * a - b) * open + c) * open), 1.0);
}

// finish: intensity, which multiplies what is shut; power, which bends the rest; albedo.
float finished(float open, vec4 finish) {
  open = clamp(1.0 - finish.x * (1.0 - open), 0.0, 1.0);
  if (finish.z > 0.0) open = bounced(open, vec3(finish.z)).x;
  return finish.y != 1.0 ? pow(open, finish.y) : open;
}

// A mean open direction of view space in world space, of length 1. Where there is none, that of the
// surface.
vec3 bentNormal(vec3 mean, vec3 world_normal) {
  const float square = dot(mean, mean);
  return square > 1e-8 ? transpose(mat3(view.view_from_world)) * mean * inversesqrt(square)
                       : world_normal;
}
