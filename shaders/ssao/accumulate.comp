#version 460
// SPDX-License-Identifier: MIT
// Temporal accumulation of visibility by reprojection (as in Schied et al. 2017, "Spatiotemporal
// Variance-Guided Filtering"). The texel's position is reprojected into the previous frame. History
// rejection leaves out texels of the bilinear footprint that lie off the tangent plane or have
// another normal. The result is the mean of all frames that saw the surface, up to a limit. Beyond
// the limit it is an exponential moving average. Within reach of surfaces that move, the history is
// clamped to the frame.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define ORTHOGRAPHIC_ID 7
#include "common/view.glsl"
#include "plane.glsl"

layout(constant_id = 0) const uint kScale = 1u;       // pixels per texel, each way
layout(constant_id = 1) const bool kMotion = false;  // the host has motion

layout(local_size_x = 8, local_size_y = 8) in;
// `then` is the previous frame, which may have another size and scale.
layout(UNIFORM(1), std140) uniform Settings {
  mat4 then_from_view;        // this frame's view space to the previous frame's
  vec4 then_view_from_pixel;  // of the previous frame, as in view.glsl
  vec4 then_pixel_from_view;
  vec4 then_from_pixel;       // pixel of a frame of the previous size = pixel * .xy + .zw
  vec2 then_size;             // texels
  float then_scale;           // pixels per texel
  float most;                 // largest history length, frames; 0: no history
  float tolerance;            // inverse of the plane tolerance, 1 / depthScale()
  float margin;               // largest difference of a history from this frame near movement
} settings;
layout(TEXTURE(0)) uniform sampler2D denoised;  // visibility and view depth; nearest, clamped
layout(TEXTURE(1)) uniform sampler2D world_normal;
layout(TEXTURE(2)) uniform sampler2D history;
layout(TEXTURE(3)) uniform sampler2D motion;  // with kMotion
layout(TEXTURE(4)) uniform sampler2D reach;   // with kMotion; see spread.comp
// Visibility; view depth; history length, frames; world normal in two times 12 bits.
layout(IMAGE(0), rgba32f) writeonly uniform image2D target;

const float kAfterChange = 2.0;  // largest history length after a change, frames

// Octahedral encoding: Meyer et al. 2010, "On Floating-Point Normal Vectors".
float encodeOctahedral(vec3 n) {
  n /= max(abs(n.x) + abs(n.y) + abs(n.z), 1e-6);
  const vec2 s = vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
  const vec2 at = n.z >= 0.0 ? n.xy : (1.0 - abs(n.yx)) * s;
  const vec2 steps = round((at * 0.5 + 0.5) * 4095.0);
  return steps.x * 4096.0 + steps.y;
}

vec3 decodeOctahedral(float bits) {
  const float x = floor(bits / 4096.0);
  const vec2 at = vec2(x, bits - x * 4096.0) / 4095.0 * 2.0 - 1.0;
  vec3 n = vec3(at, 1.0 - abs(at.x) - abs(at.y));
  const float below = max(-n.z, 0.0);
  n.x -= n.x >= 0.0 ? below : -below;
  n.y -= n.y >= 0.0 ? below : -below;
  return normalize(n);
}

// A surface in the previous frame.
struct Before {
  vec3 position;  // view space
  vec2 pixel;
  bool seen;
};

// Position in the previous frame's view space. A history never spans cameras of two kinds.
vec3 thenPosition(vec2 pixel, float view_depth) {
  const vec2 place = pixel * settings.then_view_from_pixel.xy + settings.then_view_from_pixel.zw;
  return vec3(place * depthScale(view_depth), -view_depth);
}

// A surface that rests, by the cameras alone: motion vectors are half floats.
Before resting(vec3 position) {
  Before before;
  before.position = (settings.then_from_view * vec4(position, 1.0)).xyz;
  before.pixel = before.position.xy * (settings.then_pixel_from_view.xy / depthScale(-before.position.z)) +
                 settings.then_pixel_from_view.zw;
  before.seen = before.position.z < -1e-6 * length(position);
  return before;
}

Before moving(vec2 pixel, float depth, vec4 moved) {
  Before before;
  before.pixel =
      (pixel + moved.xy) * settings.then_from_pixel.xy + settings.then_from_pixel.zw;
  before.position = thenPosition(before.pixel, depth * (1.0 + moved.z));
  before.seen = true;
  return before;
}

// The history of a surface. x: visibility in the previous frame; y: history length, frames. A length
// of 0 is a disocclusion: the previous frame did not see the surface.
vec2 reproject(Before before, vec3 normal, vec3 world) {
  const vec3 then = before.position;
  const vec2 pixel = before.pixel;
  const vec3 facing = mat3(settings.then_from_view) * normal;
  if (!before.seen) return vec2(0.0);
  const vec2 at = (pixel - 0.5) / settings.then_scale;
  if (any(lessThan(at, vec2(-0.5))) || any(greaterThan(at, settings.then_size - 0.5))) {
    return vec2(0.0);
  }
  const vec2 first = floor(at), fraction = at - first;
  vec2 sum = vec2(0.0);
  float weights = 0.0;
  [[unroll]] for (uint i = 0u; i < 4u; ++i) {
    const vec2 corner = vec2(i & 1u, i >> 1u);
    const vec2 texel = clamp(first + corner, vec2(0.0), settings.then_size - 1.0);
    const vec4 old = textureLod(history, (texel + 0.5) / settings.then_size, 0.0);
    const vec3 from = thenPosition(texel * settings.then_scale + 0.5, old.y);
    // History rejection, by the distance from the tangent plane and by the normal.
    const float plane_distance =
        abs(dot(facing, from - then)) * settings.tolerance / depthScale(-then.z);
    const vec2 bilinear = mix(1.0 - fraction, fraction, corner);
    const float same_normal = dot(decodeOctahedral(old.w), world) > 0.8 ? 1.0 : 0.0;
    const float weight =
        old.y > 0.0 ? bilinear.x * bilinear.y * max(0.0, 1.0 - plane_distance) * same_normal : 0.0;
    sum += weight * old.xz;
    weights += weight;
  }
  return weights > 0.01 ? sum / weights : vec2(0.0);
}

// Whether a surface that moves may have changed the visibility of a pixel.
bool mayChange(vec2 pixel) {
  const vec2 tiles = vec2(textureSize(reach, 0));
  const vec2 tile = floor((pixel + view.attachment.xy) / 16.0);
  return textureLod(reach, (tile + 0.5) / tiles, 0.0).x > 0.0;
}

// The history of a pixel whose visibility may have changed: clamped to the frame's own visibility
// (Karis 2014, "High Quality Temporal Supersampling"), and shortened if it was outside. The denoiser
// has removed most of the frame's noise, which would otherwise be wider than a ghost.
vec2 kept(vec2 old, float now) {
  const float clamped = clamp(old.x, now - settings.margin, now + settings.margin);
  return clamped == old.x ? old : vec2(clamped, min(old.y, kAfterChange));
}

void main() {
  const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  const ivec2 size = imageSize(target);
  if (any(greaterThanEqual(texel, size))) return;
  const vec2 now = textureLod(denoised, (vec2(texel) + 0.5) / vec2(size), 0.0).xy;
  vec4 result = vec4(now, 1.0, 0.0);
  if (now.y > 0.0) {
    const vec2 pixel = vec2(texel) * float(kScale) + 0.5;
    const vec3 world = textureLod(world_normal, attachmentAt(pixel), 0.0).xyz;
    Before before = resting(viewPosition(pixel, now.y));
    bool may_change = false;
    if (kMotion) {
      const vec4 moved = textureLod(motion, attachmentAt(pixel), 0.0);
      if (moved.w > 1.5) before = moving(pixel, now.y, moved);
      before.seen = before.seen && moved.w > 0.5;
      may_change = mayChange(pixel);
    }
    vec2 old = reproject(before, viewNormal(world), world);
    if (may_change) old = kept(old, now.x);
    const float frames = min(old.y, settings.most);
    if (frames > 0.0) {  // else the history is uninitialised or rejected
      result.x = (old.x * frames + now.x) / (frames + 1.0);
      result.z = frames + 1.0;
    }
    result.w = encodeOctahedral(world);
  }
  imageStore(target, texel, result);
}
