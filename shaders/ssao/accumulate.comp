#version 460
// SPDX-License-Identifier: MIT
// A texel's visibility averaged with what the frame before had of the same surface: the texel's
// position is looked up there, in the four texels about it, less those that lie off its plane or
// face elsewhere. The mean runs over as many frames as saw the surface, up to a number; from then on
// the oldest fade.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/view.glsl"
#include "plane.glsl"

layout(constant_id = 0) const uint kScale = 1u;  // pixels a texel, each way

layout(local_size_x = 8, local_size_y = 8) in;
// `then` is the frame before, of a size and a scale of its own.
layout(UNIFORM(1), std140) uniform Settings {
  mat4 then_from_view;        // this frame's view space to that one's
  vec4 then_view_from_pixel;  // as view.glsl has them
  vec4 then_pixel_from_view;
  vec2 then_size;             // texels
  float then_scale;           // pixels a texel
  float most;                 // frames that count of those before; 0: there is none
  float tolerance;            // 1 / view depths
} settings;
layout(TEXTURE(0)) uniform sampler2D raw;  // visibility and view depth; nearest, clamped
layout(TEXTURE(1)) uniform sampler2D world_normal;
layout(TEXTURE(2)) uniform sampler2D history;
// Visibility, view depth, frames in the mean, world normal in two times 12 bits.
layout(IMAGE(0), rgba32f) writeonly uniform image2D target;

// Octahedral: Meyer et al. 2010, "On Floating-Point Normal Vectors".
float packed(vec3 n) {
  n /= max(abs(n.x) + abs(n.y) + abs(n.z), 1e-6);
  const vec2 s = vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
  const vec2 at = n.z >= 0.0 ? n.xy : (1.0 - abs(n.yx)) * s;
  const vec2 steps = round((at * 0.5 + 0.5) * 4095.0);
  return steps.x * 4096.0 + steps.y;
}

vec3 unpacked(float bits) {
  const float x = floor(bits / 4096.0);
  const vec2 at = vec2(x, bits - x * 4096.0) / 4095.0 * 2.0 - 1.0;
  vec3 n = vec3(at, 1.0 - abs(at.x) - abs(at.y));
  const float below = max(-n.z, 0.0);
  n.x -= n.x >= 0.0 ? below : -below;
  n.y -= n.y >= 0.0 ? below : -below;
  return normalize(n);
}

// Visibility and frames in its mean, as the frame before had them; 0 frames where it did not see the
// surface.
vec2 before(vec3 position, vec3 normal, vec3 world) {
  const vec3 then = (settings.then_from_view * vec4(position, 1.0)).xyz;
  const vec3 facing = mat3(settings.then_from_view) * normal;
  if (then.z >= -1e-6 * length(position)) return vec2(0.0);
  const vec2 pixel =
      then.xy * (settings.then_pixel_from_view.xy / -then.z) + settings.then_pixel_from_view.zw;
  const vec2 at = (pixel - 0.5) / settings.then_scale;
  if (any(lessThan(at, vec2(-0.5))) || any(greaterThan(at, settings.then_size - 0.5))) {
    return vec2(0.0);
  }
  const vec2 first = floor(at), part = at - first;
  vec2 sum = vec2(0.0);
  float weights = 0.0;
  [[unroll]] for (uint i = 0u; i < 4u; ++i) {
    const vec2 corner = vec2(i & 1u, i >> 1u);
    const vec2 texel = clamp(first + corner, vec2(0.0), settings.then_size - 1.0);
    const vec4 old = textureLod(history, (texel + 0.5) / settings.then_size, 0.0);
    const vec2 from = (texel * settings.then_scale + 0.5) * settings.then_view_from_pixel.xy +
                      settings.then_view_from_pixel.zw;
    const float off = abs(dot(facing, vec3(from, -1.0) * old.y - then)) * settings.tolerance / -then.z;
    const vec2 share = mix(1.0 - part, part, corner);
    const float faces = dot(unpacked(old.w), world) > 0.8 ? 1.0 : 0.0;
    const float weight = old.y > 0.0 ? share.x * share.y * max(0.0, 1.0 - off) * faces : 0.0;
    sum += weight * old.xz;
    weights += weight;
  }
  return weights > 0.01 ? sum / weights : vec2(0.0);
}

void main() {
  const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  const ivec2 size = imageSize(target);
  if (any(greaterThanEqual(texel, size))) return;
  const vec2 now = textureLod(raw, (vec2(texel) + 0.5) / vec2(size), 0.0).xy;
  vec4 result = vec4(now, 1.0, 0.0);
  if (now.y > 0.0) {
    const vec2 pixel = vec2(texel) * float(kScale) + 0.5;
    const vec3 world = textureLod(world_normal, attachmentAt(pixel), 0.0).xyz;
    const vec2 old = before(viewPosition(pixel, now.y), viewNormal(world), world);
    const float frames = min(old.y, settings.most);
    if (frames > 0.0) {  // of an uninitialised history: not
      result.x = (old.x * frames + now.x) / (frames + 1.0);
      result.z = frames + 1.0;
    }
    result.w = packed(world);
  }
  imageStore(target, texel, result);
}
