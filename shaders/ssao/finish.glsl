// SPDX-License-Identifier: MIT
// What the last pass does to a visibility.

// The light that gets to surfaces of which a share `open` is unoccluded, and which, as all about them,
// throw back a share `albedo`: rays that surfaces stop then bring light too. Jimenez et al. 2016,
// "Practical Real-Time Strategies for Accurate Indirect Occlusion", their fit to path-traced scenes,
// for each component.
vec4 bounced(vec4 open, vec4 albedo) {
  const vec4 a = 2.0404 * albedo - 0.3324;
  const vec4 b = 4.7951 * albedo - 0.6417;
  const vec4 c = 2.7552 * albedo + 0.6903;
  return min(max(open, ((open * a - b) * open + c) * open), 1.0);
}

// Of four visibilities at once, since what is asked for is looked at but once then. finish: intensity,
// which multiplies what is shut; power, which bends the rest; albedo.
vec4 finished(vec4 open, vec4 finish) {
  open = clamp(1.0 - finish.x * (1.0 - open), 0.0, 1.0);
  if (finish.z > 0.0) open = bounced(open, vec4(finish.z));
  if (finish.y != 1.0) open = pow(open, vec4(finish.y));
  return open;
}

// A mean open direction of view space in world space, of length 1. Where there is none, that of the
// surface.
vec3 bentNormal(vec3 mean, vec3 world_normal) {
  const float square = dot(mean, mean);
  return square > 1e-8 ? transpose(mat3(view.view_from_world)) * mean * inversesqrt(square)
                       : world_normal;
}
