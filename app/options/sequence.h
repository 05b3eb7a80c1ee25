// SPDX-License-Identifier: MIT
// Numbered sequences: their file names, "depth.%04d.exr" or "depth.####.exr", and their frames.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace grisaille::app {

class FileName {
 public:
  // Two or more '#', %d or %0Nd stand for the frame number; a name without any of them is a single
  // file. Throws kSequence for more than one frame number, for a frame number in the folder, and
  // for more than 9 digits.
  explicit FileName(const std::string& text);

  bool numbered() const { return width_ > 0; }
  // The name of one frame's file; the same for all frames if the name is not numbered.
  std::string at(int number) const;

  // The name for ffmpeg: %0Nd stands for the frame number, and %% for '%'.
  std::string pattern() const;

  // The numbers of the files that exist, ascending. Throws kSequence if no file exists.
  std::vector<int> numbers() const;

 private:
  std::string text_;
  std::string before_, after_;  // the text around the number
  size_t width_ = 0;            // smallest number of digits; 0: not numbered
};

// An output and its file or files.
struct OutputFiles {
  std::string output;
  FileName file;
};

// Parses "7", "1-100" or "1-100x2" into ascending frame numbers. Throws kUsage.
std::vector<int> parseFrames(const std::string& text);

// Parses "FIRST:LAST:STEP" into ascending times, in seconds, of which the last is LAST if a step
// meets it up to rounding. Each part is a number of 0 or more, or a fraction such as 1/24; the step
// is over 0. Throws kUsage, also for more than 100,000 times.
std::vector<double> parseTimes(const std::string& text);

}  // namespace grisaille::app
