// SPDX-License-Identifier: MIT
// Reconstructs facet normals from linear view depth. The normal is the cross product of two
// tangents, one along the row and one along the column. For each tangent, the shader chooses among
// the three triples of successive pixels that contain this pixel the one nearest to a line. Declare
// before the include: bool orthographic() and vec3 viewPosition(vec2 pixel, float view_depth), in
// view space.

layout(TEXTURE(0)) uniform sampler2D view_depth;  // metres; sky: 0

const float kOutside = -1.0;
const float kFar = 3.4e38;

float depthAt(ivec2 pixel) {
  const ivec2 size = textureSize(view_depth, 0);
  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, size))) return kOutside;
  return texelFetch(view_depth, pixel, 0).x;
}

// A function of depth that is linear in the pixels of a plane: 1 / depth for a perspective camera.
// Sky: 0.
float linear(float depth) {
  if (depth <= 0.0) return 0.0;
  return orthographic() ? depth : 1.0 / depth;
}

vec3 positionOf(ivec2 pixel, float depth) {
  return viewPosition(vec2(pixel) + 0.5, depth);
}

// Tangent along one axis; 0 if both neighbours are sky or outside the picture.
vec3 along(ivec2 pixel, ivec2 axis, float depth) {
  const vec3 here = positionOf(pixel, depth);
  const float middle = linear(depth);
  float near[2], next[2];  // depths at a distance of one and of two pixels; [0] before, [1] after
  for (int i = 0; i < 2; ++i) {
    const int side = 2 * i - 1;
    near[i] = depthAt(pixel + side * axis);
    next[i] = depthAt(pixel + 2 * side * axis);
  }
  vec3 best = vec3(0.0);
  float least = kFar;
  if (near[0] > 0.0 && near[1] > 0.0) {
    least = abs(linear(near[0]) + linear(near[1]) - 2.0 * middle);
    best = positionOf(pixel + axis, near[1]) - positionOf(pixel - axis, near[0]);
  }
  for (int i = 1; i >= 0; --i) {
    if (near[i] <= 0.0) continue;
    const int side = 2 * i - 1;
    // A triple without its second pixel is the last choice.
    const float bend = next[i] == kOutside
                           ? 0.5 * kFar
                           : abs(middle + linear(next[i]) - 2.0 * linear(near[i]));
    if (bend >= least) continue;
    least = bend;
    best = float(side) * (positionOf(pixel + side * axis, near[i]) - here);
  }
  return best;
}

// xyz: unit normal in view space, towards the camera; 0 if the pixel has no neighbour on a surface.
// w: 1; sky: 0.
vec4 facetNormal(ivec2 pixel) {
  const float depth = depthAt(pixel);
  if (depth <= 0.0) return vec4(0.0);
  const vec3 right = along(pixel, ivec2(1, 0), depth), down = along(pixel, ivec2(0, 1), depth);
  const vec3 normal = cross(down, right);
  const float length = length(normal);
  if (!(length > 0.0)) return vec4(vec3(0.0), 1.0);
  const vec3 sight = orthographic() ? vec3(0.0, 0.0, -1.0) : positionOf(pixel, depth);
  return vec4((dot(normal, sight) > 0.0 ? -normal : normal) / length, 1.0);
}
