// SPDX-License-Identifier: MIT
// Videos of numbered pictures, made by the program ffmpeg.
#pragma once

#include <string>

#include "app/options/sequence.h"

namespace grisaille::app {

// The pictures that become a video.
struct VideoFrames {
  FileName files;  // numbered, from 0
  int count = 0;
  double rate = 24;  // frames a second, over 0
};

// Throws kVideo unless $PATH has ffmpeg and `file` has an ending.
void requireVideo(const std::string& file);

// Runs ffmpeg, which chooses the format by the ending of `file`. Writes a temporary file beside it
// first, and renames that. An odd side of the pictures grows by one black row or column, because
// most formats have even sides. Throws kVideo with ffmpeg's last line if it fails, and
// truth::Interrupted if a signal ends it.
void writeVideo(const VideoFrames& frames, const std::string& file);

}  // namespace grisaille::app
