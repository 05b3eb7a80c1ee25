// SPDX-License-Identifier: MIT
// Settings of what the picture shows: the split into two sides, the comparison with the truth, how
// finely it is drawn while it moves and while it rests, and the sequence along a path of cameras.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/camera.h"

namespace grisaille::app::viewer {

// How a split picture shows its two sides: beside a line, as their difference, or in turn.
enum class SplitWay : uint8_t { kLine, kDifference, kFlicker };

// Settings of a split picture.
struct SplitSettings {
  static constexpr float kLeastFull = 1e-4f, kMostFull = 1;
  static constexpr double kLeastTurn = 0.2, kMostTurn = 2;  // at most 5 changes a second

  SplitWay way = SplitWay::kLine;
  float full = 0.25f;        // the difference that has the full colour, kLeastFull ... kMostFull
  double turn = 0.5;         // seconds that a side is shown in turn, kLeastTurn ... kMostTurn
  std::string backend = "";  // that renders the right side; "": the window's
};

// Settings of the comparison with the truth.
struct TruthSettings {
  static constexpr uint32_t kLeastRays = 16, kMostRays = 4096;
  static constexpr double kFarthest = 1e6;  // metres

  bool on = false;
  std::string output = "";            // compared output; "": the first comparable one
  std::optional<double> radius = {};  // metres, over 0 to kFarthest; none: the effect's
  uint32_t rays = 256;                // per pixel, kLeastRays ... kMostRays
};

// How finely the picture is drawn.
struct Fineness {
  static constexpr double kSlowFrame = 0.05;  // seconds

  // While the picture moves, draws it at half its resolution if a whole frame takes over
  // kSlowFrame.
  bool halves = true;
  // While the picture rests, averages as many frames as an effect's `history` can, whatever its
  // value. Else it averages as many as the value says.
  bool converges = false;

  bool operator==(const Fineness&) const = default;
};

// A sequence that the user sets up.
struct Sequence {
  static constexpr double kShortest = 1.0 / 24;  // seconds: two frames
  static constexpr double kLongest = 400;  // seconds; scene::kMostPathFrames are a little more

  static constexpr size_t kMostKeys = 10000;

  std::vector<scene::Camera> keys = {};  // of the path; empty: the camera stays
  double seconds = 4;                    // of the path, without an animation
  bool animated = false;                 // takes as long as the animation, which plays once
  std::string file = "walk.####.png";
  bool filmed = false;  // ffmpeg makes a video of the files
  std::string video = "walk.mp4";
};

}  // namespace grisaille::app::viewer
