// SPDX-License-Identifier: MIT
#include "app/truth/cache.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "app/truth/content_hash.h"
#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/regular_file.h"

namespace grisaille::app::truth {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "\x89GRTR\r\n\x1a";
constexpr size_t kPixelBytes = sizeof(trace::OcclusionCounts);
static_assert(kPixelBytes == 32);

template <typename T>
void put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

uint64_t hashOf(std::string_view bytes) {
  ContentHash hash;
  hash.add(bytes);
  return hash.value();
}

std::string headOf(const std::string& key) {
  std::string head(kMagic);
  put(head, static_cast<uint32_t>(key.size()));
  return head + key;
}

// Returns false if the bytes are not a complete, undamaged file.
bool parse(std::string_view bytes, const std::string& head, size_t pixels, Counts& counts) {
  constexpr size_t kNumbers = 2 * sizeof(uint32_t);
  uint64_t hash = 0;
  if (bytes.size() != head.size() + kNumbers + pixels * kPixelBytes + sizeof(hash)) return false;
  const std::string_view hashed = bytes.substr(0, bytes.size() - sizeof(hash));
  std::memcpy(&hash, bytes.data() + hashed.size(), sizeof(hash));
  if (!bytes.starts_with(head) || hash != hashOf(hashed)) return false;
  uint32_t count = 0;
  const char* at = bytes.data() + head.size();
  std::memcpy(&counts.samples, at, sizeof(uint32_t));
  std::memcpy(&count, at + sizeof(uint32_t), sizeof(uint32_t));
  if (count != pixels || counts.samples > trace::kMostOcclusionRays) return false;
  counts.pixels.resize(pixels);
  std::memcpy(counts.pixels.data(), at + kNumbers, pixels * kPixelBytes);
  return true;
}

}  // namespace

fs::path cacheFolder() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && cache[0] == '/') return fs::path(cache) / "grisaille" / "truth";
  const char* home = std::getenv("HOME");
  if (home != nullptr && home[0] == '/') return fs::path(home) / ".cache" / "grisaille" / "truth";
  return {};
}

Cache::Cache(const fs::path& folder, std::string key) : key_(std::move(key)) {
  if (!folder.empty()) file_ = folder / fmt::format("{:016x}.bin", hashOf(key_));
}

Counts Cache::load(size_t pixels) const {
  Counts none{.samples = 0, .pixels = std::vector<trace::OcclusionCounts>(pixels)};
  std::error_code failed;
  if (file_.empty() || !fs::exists(file_, failed)) return none;
  const std::string bytes = readRegularFile(file_, ErrorId::kTruthCache);
  Counts counts;
  if (parse(bytes, headOf(key_), pixels, counts)) return counts;
  fmt::print(stderr, "note: removing the damaged cache file {}\n", file_.string());
  fs::remove(file_, failed);
  return none;
}

bool Cache::save(const Counts& counts) {
  if (file_.empty()) return false;
  std::string bytes = headOf(key_);
  bytes.reserve(bytes.size() + 16 + counts.pixels.size() * kPixelBytes);
  put(bytes, counts.samples);
  put(bytes, static_cast<uint32_t>(counts.pixels.size()));
  bytes.append(reinterpret_cast<const char*>(counts.pixels.data()),
               counts.pixels.size() * kPixelBytes);
  put(bytes, hashOf(bytes));
  try {
    std::error_code failed;  // a failure shows when the file is written
    fs::create_directories(file_.parent_path(), failed);
    writeFileAtomically(file_.string(), bytes);
    return true;
  } catch (const Error& error) {
    fmt::print(stderr, "note: the traced rays cannot be cached: {}\n", error.detail());
    file_.clear();
    return false;
  }
}

}  // namespace grisaille::app::truth
