// SPDX-License-Identifier: MIT
// The plane of the facet that a pixel shows, from the depths around it. Interpolated normals differ
// from it, and filters whose weights follow them leave the noise pattern in streaks. Include after
// plane.glsl and the declaration of view_depth.

// Deviations of three pixels in a row from a line, pixel widths: at kLeastBend, the weight of their
// slope is half of the most; the interpolated normal has the weight of kNormalBend.
const float kLeastBend = 0.01, kNormalBend = 0.1;

// A function of view depth that is linear in the pixels of a plane.
float linearDepth(float depth) {
  return orthographic() ? depth : -1.0 / max(depth, 1e-30);
}

// Increase of linearDepth() per pixel along an axis: a weighted mean, so that roundings change it only
// a little. `depths`: view depths one and two pixels before the pixel, then one and two after it; 0
// without a surface there. `straight`: factor from deviations to pixel widths. `by_normal`: the
// increase on the interpolated normal's plane.
float facetSlope(float depth, vec4 depths, float straight, float by_normal) {
  const float own = linearDepth(depth);
  const vec4 d = vec4(linearDepth(depths.x), linearDepth(depths.y), linearDepth(depths.z),
                      linearDepth(depths.w)) - own;
  const vec4 there = vec4(greaterThan(depths, vec4(0.0)));
  const vec3 slopes = vec3(-d.x, 0.5 * (d.z - d.x), d.z);
  const vec3 bends = vec3(d.y - 2.0 * d.x, d.x + d.z, d.w - 2.0 * d.z) * straight;
  const vec3 weights = vec3(there.x * there.y, there.x * there.z, there.z * there.w) /
                       (bends * bends + kLeastBend * kLeastBend);
  const float normal_weight = 1.0 / (kNormalBend * kNormalBend);
  // A slope of no weight may be infinite.
  const vec3 sum = mix(vec3(0.0), slopes * weights, greaterThan(weights, vec3(0.0)));
  return (dot(sum, vec3(1.0)) + by_normal * normal_weight) /
         (dot(weights, vec3(1.0)) + normal_weight);
}

// View depth of a pixel; 0 outside the attachments and without a surface.
float depthNear(vec2 pixel) {
  const vec2 at = attachmentAt(pixel);
  const float depth = textureLod(view_depth, at, 0.0).x;
  return all(equal(at, clamp(at, vec2(0.0), vec2(1.0)))) ? depth : 0.0;
}

// View depths at two pixels before and two after, in the order of facetSlope().
vec4 depthsAlong(vec2 pixel, vec2 axis) {
  return vec4(depthNear(pixel - axis), depthNear(pixel - 2.0 * axis), depthNear(pixel + axis),
              depthNear(pixel + 2.0 * axis));
}

// Slopes of the facet in x and y: metres of view depth per metre across. `normal`: interpolated, in
// view space. `in_row`, `in_column`: see depthsAlong().
vec2 facetTangent(vec2 pixel, float depth, vec3 normal, vec4 in_row, vec4 in_column) {
  const vec2 across = view.view_from_pixel.xy;
  const float facing = min(dot(normal, rayDirection(pixel)), -0.01);
  const float scale = depthScale(depth);
  const float straight = scale * abs(facing / across.x);
  const vec2 by_normal = -normal.xy / facing * across / scale;
  return -scale / across * vec2(facetSlope(depth, in_row, straight, by_normal.x),
                                facetSlope(depth, in_column, straight, by_normal.y));
}
