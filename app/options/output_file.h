// SPDX-License-Identifier: MIT
// Output files of the command line: NAME=FILE.
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

// A file that a command writes.
struct NamedOutput {
  std::string words;  // the option that names it, for messages: "--write ao=x.exr"
  std::string file;   // "": no file
};

// Throws kUsage if two outputs name the same file, even by different paths. Character devices, for
// example /dev/null, accept any number of outputs.
void requireDistinct(std::span<const NamedOutput> outputs);

// The files of --write, named for messages.
std::vector<NamedOutput> namedOutputs(std::span<const OutputFile> writes);

// Parses NAME=FILE. Throws kUsage.
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

// Writes an output of the scene or of an effect. Values that are not finite are written unchanged,
// so that the user can find the fault, and a warning counts them.
inline void writeOutput(const image::Image& picture, const OutputFile& write,
                        const image::WriteOptions& options) {
  image::write(picture, write.file, options);
  const size_t odd = image::countNonFinite(picture);
  if (odd == 0) return;
  fmt::print(stderr,
             "warning: {} holds {} values that are not finite; `grisaille effects --verify FILE` "
             "checks the plugin of an effect\n",
             write.output, odd);
}

}  // namespace grisaille::app
