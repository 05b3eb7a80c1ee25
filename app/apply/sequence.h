// SPDX-License-Identifier: MIT
// File names of a numbered sequence: "depth.%04d.exr" or "depth.####.exr".
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

  // The numbers of the files that exist, ascending. Throws kSequence if no file exists.
  std::vector<int> numbers() const;

 private:
  std::string text_;
  std::string before_, after_;  // the text around the number
  size_t width_ = 0;            // smallest number of digits; 0: not numbered
};

// Parses "7", "1-100" or "1-100x2" into ascending frame numbers. Throws kUsage.
std::vector<int> parseFrames(const std::string& text);

}  // namespace grisaille::app
