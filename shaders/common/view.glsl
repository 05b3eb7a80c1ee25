// SPDX-License-Identifier: MIT
// The camera of a frame, as grisaille_frame.view_block holds it: a pinhole looking along -z with y
// up. Pixel coordinates have (0.5, 0.5) at the top left pixel's centre, as gl_FragCoord has. Define
// VIEW_SLOT before to bind it elsewhere than UNIFORM(0).
#include "common/bindings.glsl"

#ifndef VIEW_SLOT
#define VIEW_SLOT 0
#endif

layout(UNIFORM(VIEW_SLOT), std140) uniform View {
  vec4 view_from_pixel;  // view.xy at view depth 1 = pixel * .xy + .zw
  vec4 pixel_from_view;  // pixel = view.xy / view depth * .xy + .zw
  vec4 size;             // width and height in pixels, then their inverses
  mat4 view_from_world;  // rotation alone: world axes to view axes
  ivec4 camera_cell;     // the camera's world position: whole metres
  vec4 camera_fraction;  // and the rest, in [0, 1) metres; w: near plane, metres
  vec4 attachment;       // attachments go beyond the picture by .xy pixels; .zw: 1 / their size
} view;

// Texture coordinates in an attachment, of pixels as far outside the picture as its guard band.
vec2 attachmentAt(vec2 pixel) {
  return (pixel + view.attachment.xy) * view.attachment.zw;
}

// A pixel put back into view space. view_depth in metres.
vec3 viewPosition(vec2 pixel, float view_depth) {
  return vec3((pixel * view.view_from_pixel.xy + view.view_from_pixel.zw) * view_depth, -view_depth);
}

// The pixel that sees a point in front of the camera (position.z < 0).
vec2 pixelOf(vec3 position) {
  return position.xy * (view.pixel_from_view.xy / -position.z) + view.pixel_from_view.zw;
}
