// SPDX-License-Identifier: MIT
// What to write where, as the command line gives it: NAME=FILE.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/image/image.h"

namespace grisaille::app {

struct OutputFile {
  std::string output, file;
};

// A file that a command is to write, with the words of the command line that name it.
struct NamedOutput {
  std::string words;  // "--write ao=x.exr"
  std::string file;   // "": none
};

// Throws kUsage where two of these name the same file, by whatever path. Character devices, such as
// /dev/null, take any number of outputs.
void requireDistinct(std::span<const NamedOutput> outputs);

// With the words of --write.
std::vector<NamedOutput> namedOutputs(std::span<const OutputFile> writes);

// Throws Error(kUsage).
inline OutputFile parseOutputFile(const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    throw Error(ErrorId::kUsage, "'{}' is not of the form NAME=FILE", text);
  }
  return {.output = text.substr(0, equals), .file = text.substr(equals + 1)};
}

// Throws as parseOutputFile() and image::checkWritable() do.
inline std::vector<OutputFile> parseOutputFiles(const std::vector<std::string>& texts) {
  std::vector<OutputFile> writes;
  for (const std::string& text : texts) {
    writes.push_back(parseOutputFile(text));
    image::checkWritable(writes.back().file);
  }
  return writes;
}

// Writes what an effect or the scene put out. What is not finite is written as it is, for whoever
// looks for the fault, and a warning says so.
inline void writeOutput(const image::Image& picture, const OutputFile& write,
                        const image::WriteOptions& options) {
  image::write(picture, write.file, options);
  const size_t odd = image::countNonFinite(picture);
  if (odd == 0) return;
  fmt::print(stderr,
             "warning: {} holds {} values that are no finite numbers; `grisaille effects --verify "
             "FILE` checks an effect's plugin\n",
             write.output, odd);
}

}  // namespace grisaille::app
