/* SPDX-License-Identifier: MIT
 *
 * The struct of one object of the test plugin `teller`. */
#pragma once

namespace grisaille::tests {

#ifdef LATER
// The later version of the plugin: no `note`, a text for `colour`, a new `weight`, and a lower
// limit for `size`.
struct Mark {
  double position[3];
  double size;
  float direction[3];
  const char* colour;
  const char* picture;
  double weight;
};
constexpr double kLargestMark = 10;
#else
struct Mark {
  double position[3];
  float direction[3];
  float colour[3];
  double size;
  const char* note;
  const char* picture;
};
constexpr double kLargestMark = 100;
#endif

}  // namespace grisaille::tests
