// SPDX-License-Identifier: MIT
// Counts of rays that are kept from one run to the next, one file an estimate:
//
//    byte            bytes
//    0               8       89 47 52 54 52 0D 0A 1A (hexadecimal)
//    8               4       k, the bytes of the key
//    12              k       the key: text that tells what was traced, and the format's version
//    12 + k          4       rays a pixel
//    16 + k          4       n, the number of pixels
//    20 + k          32 n    trace::OcclusionCounts, by rows
//    20 + k + 32 n   8       FNV-1a, 64 bits, of all bytes before
//
// Numbers are in the machine's own order: the file stays on it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/trace/occlusion.h"

namespace grisaille::app::truth {

struct Counts {
  uint32_t samples = 0;  // rays a pixel so far
  std::vector<trace::OcclusionCounts> pixels;
};

// $XDG_CACHE_HOME/grisaille/truth or ~/.cache/grisaille/truth; "" where neither is an absolute
// path.
std::filesystem::path cacheFolder();

// A damaged file or one that cannot be written is a note on standard error and nothing worse.
class Cache {
 public:
  // `folder` "": nothing is kept. `key` names all that the counts depend on, but how many they are.
  Cache(const std::filesystem::path& folder, std::string key);

  const std::filesystem::path& file() const { return file_; }  // "": nothing is kept

  // What is kept of a picture of so many pixels, else none. A damaged file is thrown away.
  // Throws kTruthCache where the file is a folder, a device or a named pipe, or may not be read.
  Counts load(size_t pixels) const;

  // Whether it was written, aside and then renamed. After a failure no more is tried.
  bool save(const Counts& counts);

 private:
  std::filesystem::path file_;
  std::string key_;
};

}  // namespace grisaille::app::truth
