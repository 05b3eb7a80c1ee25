// SPDX-License-Identifier: MIT
// What the last pass does to a visibility: intensity multiplies what is shut, power bends the rest.
float finished(float open, float intensity, float power) {
  open = clamp(1.0 - intensity * (1.0 - open), 0.0, 1.0);
  return power != 1.0 ? pow(open, power) : open;
}
