// SPDX-License-Identifier: MIT
// Arrays of 32-bit words that are on the device alone. Changes wait on the host, and an Uploader
// writes them there. An array that is nearly full moves to a larger one, some words in each frame,
// so that no frame waits for all of them.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "grisaille/effect.hpp"

namespace grisaille::sspm {

class DeviceWords {
 public:
  explicit DeviceWords(const char* label) : label_(label) {}

  size_t size() const { return size_; }
  // Grows to `words`, or more. New words are undefined.
  void resize(size_t words);
  // The array moves to one of at least `words`.
  void plan(uint64_t words) { planned_ = words; }
  // Drops the waiting changes.
  void discard();
  // Drops the array too.
  void clear();
  // Words [first, first + count), to fill in. Replaces what waits at the same `first`; other runs
  // must not overlap. Valid until the next call.
  std::span<uint32_t> write(size_t first, size_t count);
  // Drops what waits at `first`.
  void drop(size_t first);

  // Bytes on the device and of waiting changes.
  uint64_t bytes() const;
  // The same at the next upload, if the array has at least `words` then: an array that grows takes
  // a thirty-second more, and the device needs the old one too until the frame has ended.
  uint64_t peakBytes(size_t words = 0) const;
  uint64_t waitingBytes() const { return payload_.size() * sizeof(uint32_t); }
  // Words that it has, or will have after the next upload.
  uint64_t capacity() const { return std::max({size_, deviceWords_, largerWords_}); }
  grisaille_buffer buffer() const { return buffer_; }

 private:
  friend class Uploader;
  // Size of an array on the device that holds `words`.
  uint64_t sizeFor(uint64_t words) const;
  // Size of the array to which it should begin to move, words; 0: none. most: of an array that is
  // not planned; words.
  uint64_t wantedWords(uint64_t most) const;

  struct Run {
    size_t payload, target, count;  // words; first word in payload_, and in the array
  };

  const char* label_;
  size_t size_ = 0;
  size_t uploaded_ = 0;     // size_ at the last upload
  size_t deviceWords_ = 0;  // of buffer_
  size_t largerWords_ = 0;  // of larger_; 0: it does not move
  size_t moved_ = 0;        // words that larger_ has already
  size_t toMove_ = 0;       // words that larger_ is to get from buffer_
  uint64_t planned_ = 0;
  plugin::Buffer buffer_, larger_;
  std::vector<uint32_t> payload_;
  std::vector<Run> runs_;
  std::unordered_map<size_t, size_t> runAt_;  // index of the run at a target
};

// Writes changes on the device with shaders/sspm/scatter.comp.
class Uploader {
 public:
  explicit Uploader(const plugin::Host& host);

  // Call it inside record(), outside passes. Throws plugin::Failure.
  // spare: what a larger array may take if the array should begin to move, bytes. most: the same if
  // the array is not planned.
  void upload(const plugin::Frame& frame, DeviceWords& words, uint64_t spare, uint64_t most);
  uint64_t bytes() const { return stagingWords_ * sizeof(uint32_t); }

 private:
  void begin(DeviceWords& words, size_t count);
  void grow(const plugin::Frame& frame, DeviceWords& words);
  void write(const plugin::Frame& frame, const DeviceWords& words);
  void move(const plugin::Frame& frame, DeviceWords& words, size_t count);
  void stage(const plugin::Frame& frame, std::span<const uint32_t> staging);
  void scatter(const plugin::Frame& frame, size_t words, grisaille_buffer source,
               grisaille_buffer target);

  plugin::Host host_;
  plugin::PipelineCache scatter_;
  plugin::Buffer staging_;
  size_t stagingWords_ = 0;
};

// Allocates runs of units in an array. A run takes the smallest free space that is long enough;
// neighbouring free spaces are one.
class Runs {
 public:
  // unit: size of a unit, words.
  Runs(DeviceWords& words, size_t unit) : words_(words), unit_(unit) {}

  // Capacity for a list of `count` units that changes: 1 to 8, or 8 to 15 times a power of two.
  static uint32_t capacityFor(uint32_t count) {
    if (count <= 8) return count;
    const int shift = std::bit_width(count - 1) - 4;
    return (((count - 1) >> shift) + 1) << shift;
  }

  // Allocates a run of `count` units, count > 0. Returns its first unit. May resize the array.
  uint32_t take(uint32_t count);
  // Whether a run of `count` units needs no larger array on the device.
  bool fits(uint32_t count) const;
  // Frees a run.
  void give(uint32_t first, uint32_t count);
  void clear();

  // Free words that need no larger array on the device.
  uint64_t freeWords() const;
  // Memory on the host, bytes.
  uint64_t bytes() const { return spaces_.size() * kSpaceBytes; }

 private:
  static constexpr uint64_t kSpaceBytes = 2 * 64;  // of a space, with its nodes in both trees

  void addSpace(uint32_t first, uint32_t count);

  DeviceWords& words_;
  size_t unit_;
  uint32_t end_ = 0;
  uint64_t free_ = 0;                               // units, of all spaces
  std::map<uint32_t, uint32_t> spaces_;             // count by first unit
  std::set<std::pair<uint32_t, uint32_t>> bySize_;  // count, first unit
};

}  // namespace grisaille::sspm
