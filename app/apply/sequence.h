// SPDX-License-Identifier: MIT
// Files of a numbered sequence: "depth.%04d.exr" or "depth.####.exr".
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace grisaille::app {

class FileName {
 public:
  // Two or more '#' or one %d or %0Nd in the file's name number it; without, it is one file. Throws
  // kSequence for more than one number, or one in the folder.
  explicit FileName(const std::string& text);

  bool numbered() const { return width_ > 0; }
  std::string at(int number) const;

  // The numbers of the files that are there, ascending. Throws kSequence where there is none.
  std::vector<int> numbers() const;

 private:
  std::string text_;
  std::string before_, after_;  // around the number
  size_t width_ = 0;            // digits at least; 0: not numbered
};

// "7", "1-100" or "1-100x2", ascending. Throws kUsage.
std::vector<int> parseFrames(const std::string& text);

}  // namespace grisaille::app
