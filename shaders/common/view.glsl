// SPDX-License-Identifier: MIT
// The camera of a frame: the uniform block that grisaille_frame.view_block holds. The functions hold
// for every camera: perspective or orthographic, centred or off-centre, jittered. The camera looks
// along -z, with y up; view depth is -z, metres. The centre of the top left pixel has the pixel
// coordinates (0.5, 0.5), same as gl_FragCoord.
//
// To bind the block elsewhere than at UNIFORM(0), define VIEW_SLOT before the include. A shader with
// a long loop may define ORTHOGRAPHIC_ID, the id of a specialization constant that then replaces the
// test of the camera's kind: set it to grisaille_view.orthographic.
#include "common/bindings.glsl"

#ifndef VIEW_SLOT
#define VIEW_SLOT 0
#endif

layout(UNIFORM(VIEW_SLOT), std140) uniform View {
  vec4 view_from_pixel;  // pixel * .xy + .zw: view.xy; perspective: at view depth 1
  vec4 pixel_from_view;  // the inverse: view.xy * .xy + .zw; perspective: at view depth 1
  vec4 size;             // width and height in pixels, then their inverses
  mat4 view_from_world;  // rotation only: world axes to view axes
  ivec4 camera_cell;     // the camera's world position: whole metres
  vec4 camera_fraction;  // xyz: its remainder, in [0, 1) metres
  vec4 attachment;       // xy: guard band on each side, pixels; zw: 1 / attachments' size
  vec4 planes;           // x: near plane, y: far plane, 0 without, metres; z: 1 if orthographic
} view;

#ifdef ORTHOGRAPHIC_ID
layout(constant_id = ORTHOGRAPHIC_ID) const bool kOrthographic = false;
bool orthographic() { return kOrthographic; }
#else
bool orthographic() { return view.planes.z > 0.0; }
#endif

// Texture coordinates of a pixel in an attachment. The pixel may lie outside the picture, in the
// guard band.
vec2 attachmentAt(vec2 pixel) {
  return (pixel + view.attachment.xy) * view.attachment.zw;
}

// How lengths in the picture grow with view depth: in proportion to it, or not at all.
float depthScale(float view_depth) {
  return orthographic() ? 1.0 : view_depth;
}

// 1 for a perspective camera, else 0. A factor, since lavapipe evaluates a vector that a
// specialization constant selects with the constant's default.
float perspective() {
  return orthographic() ? 0.0 : 1.0;
}

// Position in view space of the surface that a pixel shows.
vec3 viewPosition(vec2 pixel, float view_depth) {
  const vec2 place = pixel * view.view_from_pixel.xy + view.view_from_pixel.zw;
  return vec3(place * depthScale(view_depth), -view_depth);
}

// The ray through a pixel, in view space: it starts at view depth 0. A step along its direction adds
// 1 m of view depth.
vec3 rayStart(vec2 pixel) {
  return viewPosition(pixel, 0.0);
}
vec3 rayDirection(vec2 pixel) {
  const vec2 place = pixel * view.view_from_pixel.xy + view.view_from_pixel.zw;
  return vec3(place * perspective(), -1.0);
}

// Pixel coordinates of a position in view space. Perspective: in front of the camera (z < 0).
vec2 pixelOf(vec3 position) {
  return position.xy * (view.pixel_from_view.xy / depthScale(-position.z)) + view.pixel_from_view.zw;
}

// Unit vector in view space from a position towards the camera.
vec3 towardsCamera(vec3 position) {
  const vec3 away = vec3(position.xy * perspective(), orthographic() ? -1.0 : position.z);
  return away * -inversesqrt(dot(away, away));
}

// Height of a pixel at a view depth, metres, and its inverse.
float pixelSize(float view_depth) {
  return -view.view_from_pixel.y * depthScale(view_depth);
}
float pixelsPerMetre(float view_depth) {
  return -view.pixel_from_view.y / depthScale(view_depth);
}

// Conversion of clip depth (GRISAILLE_DEPTH, over 0) to view depth, and the inverse.
float viewDepthOf(float clip_depth) {
  if (orthographic()) return view.planes.y + clip_depth * (view.planes.x - view.planes.y);
  return view.planes.x / clip_depth;
}
float clipDepthOf(float view_depth) {
  if (orthographic()) return (view.planes.y - view_depth) / (view.planes.y - view.planes.x);
  return view.planes.x / view_depth;
}

// How far the surface at view depth `centre` lies in front of the line through two others, which lie
// equally many pixels before and after it in the picture: metres of view depth, 0 on a plane.
float bulge(float before, float centre, float after) {
  if (orthographic()) return 0.5 * (before + after) - centre;
  return centre - 0.5 * centre * centre * (1.0 / before + 1.0 / after);
}
