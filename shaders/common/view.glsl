// SPDX-License-Identifier: MIT
// The camera of a frame: the uniform block that grisaille_frame.view_block holds. A pinhole camera
// looks along -z, with y up. The centre of the top left pixel has the pixel coordinates (0.5, 0.5),
// same as gl_FragCoord. To bind the block elsewhere than at UNIFORM(0), define VIEW_SLOT before the
// include.
#include "common/bindings.glsl"

#ifndef VIEW_SLOT
#define VIEW_SLOT 0
#endif

layout(UNIFORM(VIEW_SLOT), std140) uniform View {
  vec4 view_from_pixel;  // view.xy at view depth 1 = pixel * .xy + .zw
  vec4 pixel_from_view;  // pixel = view.xy / view depth * .xy + .zw
  vec4 size;             // width and height in pixels, then their inverses
  mat4 view_from_world;  // rotation only: world axes to view axes
  ivec4 camera_cell;     // the camera's world position: whole metres
  vec4 camera_fraction;  // xyz: its remainder, in [0, 1) metres; w: near plane, metres
  vec4 attachment;       // xy: guard band on each side, pixels; zw: 1 / attachments' size
} view;

// Texture coordinates of a pixel in an attachment. The pixel may lie outside the picture, in the
// guard band.
vec2 attachmentAt(vec2 pixel) {
  return (pixel + view.attachment.xy) * view.attachment.zw;
}

// Position in view space of the surface that a pixel shows. view_depth in metres.
vec3 viewPosition(vec2 pixel, float view_depth) {
  return vec3((pixel * view.view_from_pixel.xy + view.view_from_pixel.zw) * view_depth, -view_depth);
}

// Pixel coordinates of a view-space position in front of the camera (position.z < 0).
vec2 pixelOf(vec3 position) {
  return position.xy * (view.pixel_from_view.xy / -position.z) + view.pixel_from_view.zw;
}
