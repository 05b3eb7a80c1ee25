// SPDX-License-Identifier: MIT
// Texels of GRISAILLE_MOTION.

const float kResting = 1.0, kMoving = 2.0;  // component w; 0: unknown, or the sky

// shift: pixels from the surface's place to its previous one; before, now: its view depths, metres.
// Surfaces that were not in front of the camera, or beyond the range of half floats, are unknown.
vec4 motionOf(vec2 shift, float before, float now, float kind) {
  const float change = (before - now) / now;
  const bool seen = before > 1e-6 * now && max(max(abs(shift.x), abs(shift.y)), abs(change)) < 6e4;
  return seen ? vec4(shift, change, kind) : vec4(0.0);
}
