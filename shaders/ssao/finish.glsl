// SPDX-License-Identifier: MIT
// Post-processing of the visibility, in the last pass: intensity, interreflection, power.

// Visibility with interreflections, for each component: `open` is the visibility without them,
// `albedo` that of the surface and of its surroundings. Jimenez et al. 2016, "Practical Real-Time
// Strategies for Accurate Indirect Occlusion" (GTAO): the cubic fit to path-traced scenes.
vec4 bounced(vec4 open, vec4 albedo) {
  const vec4 a = 2.0404 * albedo - 0.3324;
  const vec4 b = 4.7951 * albedo - 0.6417;
  const vec4 c = 2.7552 * albedo + 0.6903;
  return min(max(open, ((open * a - b) * open + c) * open), 1.0);
}

// Applies intensity (finish.x, a factor on the occlusion), interreflection (finish.z, the albedo)
// and power (finish.y, an exponent) to four visibilities. Four at once evaluate the conditions
// once.
vec4 finished(vec4 open, vec4 finish) {
  open = clamp(1.0 - finish.x * (1.0 - open), 0.0, 1.0);
  if (finish.z > 0.0) open = bounced(open, vec4(finish.z));
  if (finish.y != 1.0) open = pow(open, vec4(finish.y));
  return open;
}

// Bent normal in world space, length 1, from the mean open direction in view space. If that is 0,
// the surface's normal.
vec3 bentNormal(vec3 mean, vec3 world_normal) {
  const float squared_length = dot(mean, mean);
  return squared_length > 1e-8
             ? transpose(mat3(view.view_from_world)) * mean * inversesqrt(squared_length)
             : world_normal;
}
