#version 460
// SPDX-License-Identifier: MIT
// Shows outputs of a frame in the window: magnified; split by a line that the user drags, with one
// output on each side; or as the difference of both.
#extension GL_GOOGLE_include_directive : require
#include "common/bindings.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(TEXTURE(0)) uniform sampler2D left_side;
layout(TEXTURE(1)) uniform sampler2D right_side;
layout(IMAGE(0), rgba8) writeonly uniform image2D window;
layout(UNIFORM(0)) uniform Show {
  ivec2 place;      // top left corner of the picture in the window, pixels
  ivec2 size;       // of the picture in the window, pixels; 0: no picture
  vec2 centre;      // texel of the outputs at the picture's centre
  float zoom;       // pixels per texel
  float line;       // x of the line, from the picture's left edge, pixels
  float far_depth;  // depth drawn as mid grey, metres
  float line_width; // pixels; 0: no line
  float full;       // the difference that has the full colour; 0: no difference is shown
} show;

// Kinds of the left and the right side: how numbers become colours. Without a right side, both are
// equal.
layout(constant_id = 0) const uint left_kind = 0u;
layout(constant_id = 1) const uint right_kind = 0u;

const uint kLight = 0u;   // linear light
const uint kNumber = 1u;  // one channel, 0 black to 1 white
const uint kSigned = 2u;  // three channels from -1 to 1
const uint kDepth = 3u;   // metres, 0: sky
const uint kOverlay = 4u;   // straight alpha over a checkerboard
const uint kEncoded = 5u; // three channels, unchanged

const vec3 kGround = vec3(0.07, 0.07, 0.08);
const vec3 kLine = vec3(0.90, 0.62, 0.0);
const vec3 kLower = vec3(0.0, 0.45, 0.70), kHigher = vec3(0.90, 0.62, 0.0);  // Okabe and Ito

vec3 encoded(vec3 light) {
  light = clamp(light, 0.0, 1.0);
  return mix(12.92 * light, 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055,
             greaterThan(light, vec3(0.0031308)));
}

vec3 shown(vec4 value, uint kind, ivec2 pixel) {
  if (any(isnan(value)) || any(isinf(value))) return vec3(1.0, 0.0, 1.0);
  switch (kind) {
    case kLight: return encoded(value.rgb);
    case kNumber: return clamp(value.rrr, 0.0, 1.0);
    case kSigned: return clamp(value.rgb * 0.5 + 0.5, 0.0, 1.0);
    case kDepth: return value.r > 0.0 ? vec3(show.far_depth / (show.far_depth + value.r)) : vec3(0.0);
    case kOverlay: {
      const ivec2 square = pixel >> 4;
      const vec3 under = vec3(((square.x ^ square.y) & 1) != 0 ? 0.20 : 0.16);
      return encoded(mix(under, value.rgb, clamp(value.a, 0.0, 1.0)));
    }
    default: return clamp(value.rgb, 0.0, 1.0);
  }
}

// Blue where the left side is darker, orange where it is brighter, as truth::errorColor(). The
// channel that differs most gives the strength; the mean gives the sign.
vec3 difference(vec2 uv, ivec2 pixel) {
  const vec4 a = textureLod(left_side, uv, 0.0), b = textureLod(right_side, uv, 0.0);
  if (any(isnan(a)) || any(isinf(a)) || any(isnan(b)) || any(isinf(b))) return vec3(0.5);
  const vec3 off = shown(a, left_kind, pixel) - shown(b, right_kind, pixel);
  const vec3 size = abs(off);
  const float most = max(size.r, max(size.g, size.b));
  const vec3 colour = off.r + off.g + off.b < 0.0 ? kLower : kHigher;
  return mix(vec3(1.0), colour, min(most / show.full, 1.0));
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(window)))) return;
  const ivec2 inside = pixel - show.place;
  vec3 color = kGround;
  if (all(greaterThanEqual(inside, ivec2(0))) && all(lessThan(inside, show.size))) {
    const float x = float(inside.x) + 0.5;
    const bool right = x > show.line;
    const ivec2 extent = right ? textureSize(right_side, 0) : textureSize(left_side, 0);
    const vec2 texel = floor(show.centre + (vec2(inside) + 0.5 - 0.5 * vec2(show.size)) / show.zoom);
    const vec2 uv = (texel + 0.5) / vec2(extent);
    if (all(greaterThanEqual(texel, vec2(0.0))) && all(lessThan(texel, vec2(extent)))) {
      // Equal kinds: one conversion for both sides.
      if (show.full > 0.0) {
        color = difference(uv, inside);
      } else if (left_kind == right_kind) {
        const vec4 value = right ? textureLod(right_side, uv, 0.0) : textureLod(left_side, uv, 0.0);
        color = shown(value, left_kind, inside);
      } else color = right ? shown(textureLod(right_side, uv, 0.0), right_kind, inside)
                    : shown(textureLod(left_side, uv, 0.0), left_kind, inside);
    }
    if (show.full == 0.0 && abs(x - show.line) < show.line_width) color = kLine;
  }
  imageStore(window, pixel, vec4(color, 1.0));
}
