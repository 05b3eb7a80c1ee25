// SPDX-License-Identifier: MIT
// The cache of ray counts, kept from one run to the next. One file per estimate:
//
//    byte            bytes
//    0               8       89 47 52 54 52 0D 0A 1A (hexadecimal)
//    8               4       k, the length of the key in bytes
//    12              k       the key: text that names everything traced, and the format's version
//    12 + k          4       rays per pixel
//    16 + k          4       n, the number of pixels
//    20 + k          32 n    trace::OcclusionCounts, by rows
//    20 + k + 32 n   8       FNV-1a, 64 bits, of all preceding bytes
//
// Numbers are in the machine's byte order: the file is not for other machines.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/trace/occlusion.h"

namespace grisaille::app::truth {

struct Counts {
  uint32_t samples = 0;  // rays per pixel so far
  std::vector<trace::OcclusionCounts> pixels;
};

// $XDG_CACHE_HOME/grisaille/truth, else $HOME/.cache/grisaille/truth; "" if neither is an absolute
// path.
std::filesystem::path cacheFolder();

// One file of the cache. A damaged file, or a failure to write, causes a note on standard error.
class Cache {
 public:
  // `folder`: "" turns the cache off. `key`: everything that the counts depend on, except the
  // number of rays.
  Cache(const std::filesystem::path& folder, std::string key);

  const std::filesystem::path& file() const { return file_; }  // "": the cache is off

  // The cached counts of a picture with this number of pixels; zero counts if there is no file.
  // Removes a damaged file. Throws kTruthCache if the file is a folder, a device or a named pipe,
  // or cannot be read.
  Counts load(size_t pixels) const;

  // Writes the file atomically. Returns whether it was written. After a failure, turns the cache
  // off.
  bool save(const Counts& counts);

 private:
  std::filesystem::path file_;
  std::string key_;
};

}  // namespace grisaille::app::truth
