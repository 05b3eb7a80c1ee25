// SPDX-License-Identifier: MIT
// An array of 32-bit words with a copy on the device. upload() copies the changed pages.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "grisaille/effect.hpp"

namespace grisaille::sspm {

class Mirror {
 public:
  explicit Mirror(const char* label) : label_(label) {}

  size_t size() const { return words_.size(); }
  const uint32_t* data() const { return words_.data(); }

  // Words [first, first + count), for writing. Marks their pages as changed. Valid until resize().
  std::span<uint32_t> change(size_t first, size_t count) {
    for (size_t page = first / kPage; page * kPage < first + count; ++page) dirty_[page] = true;
    return std::span(words_).subspan(first, count);
  }

  // New words are 0.
  void resize(size_t count) {
    if (count > words_.capacity()) words_.reserve(std::max(count, words_.capacity() / 4 * 5));
    words_.resize(count);
    dirty_.resize((count + kPage - 1) / kPage, true);
  }

  void fill(uint32_t value) {
    std::ranges::fill(words_, value);
    std::fill(dirty_.begin(), dirty_.end(), true);
  }

  // Uploads the changed pages, and grows the buffer if necessary. Call it inside record(), outside
  // passes. Throws plugin::Failure.
  void upload(const plugin::Host& host, const plugin::Frame& frame) {
    if (words_.empty()) resize(kPage);
    if (deviceWords_ < words_.size()) {
      deviceWords_ = std::max(words_.size(), words_.capacity());
      buffer_ = host.buffer(label_, deviceWords_ * sizeof(uint32_t));
      std::fill(dirty_.begin(), dirty_.end(), true);
    }
    for (size_t page = 0; page < dirty_.size();) {
      if (!dirty_[page]) {
        ++page;
        continue;
      }
      const size_t first = page;
      while (page < dirty_.size() && dirty_[page] && page - first < kRun) dirty_[page++] = false;
      const size_t end = std::min(page * kPage, words_.size());
      frame.uploadBuffer(buffer_, first * kPage * sizeof(uint32_t),
                         std::span(words_).subspan(first * kPage, end - first * kPage));
    }
  }

  grisaille_buffer buffer() const { return buffer_; }

 private:
  static constexpr size_t kPage = 1024;  // words
  static constexpr size_t kRun = 4096;   // pages in one upload: 16 MiB

  const char* label_;
  std::vector<uint32_t> words_;
  std::vector<bool> dirty_;
  size_t deviceWords_ = 0;
  plugin::Buffer buffer_;
};

// Allocates runs of units in a Mirror. Size classes: 1 to 3, and 4, 5, 6 or 7 times a power of two.
// Freed runs are reused within their class.
class Runs {
 public:
  // unit: size of a unit, words.
  Runs(Mirror& mirror, size_t unit) : mirror_(mirror), unit_(unit) {}

  static uint32_t capacityFor(uint32_t count) {
    if (count <= 4) return count;
    const int shift = std::bit_width(count - 1) - 3;
    return (((count - 1) >> shift) + 1) << shift;
  }

  // Allocates a run of at least `count` units, count > 0. Returns its first unit. May resize the
  // mirror.
  uint32_t take(uint32_t count) {
    const uint32_t capacity = capacityFor(count);
    auto& free = free_[classOf(capacity)];
    if (!free.empty()) {
      const uint32_t first = free.back();
      free.pop_back();
      return first;
    }
    const uint32_t first = end_;
    end_ += capacity;
    mirror_.resize(std::max(mirror_.size(), size_t{end_} * unit_));
    return first;
  }

  // Frees a run. `count`: same as at take(), or the run's capacity.
  void give(uint32_t first, uint32_t count) { free_[classOf(capacityFor(count))].push_back(first); }

  void clear() {
    for (auto& free : free_) free.clear();
    end_ = 0;
  }

 private:
  static size_t classOf(uint32_t capacity) {
    if (capacity <= 4) return capacity - 1;
    const int shift = std::bit_width(capacity) - 3;
    return static_cast<size_t>(4 * shift) + (capacity >> shift) - 1;
  }

  Mirror& mirror_;
  size_t unit_;
  uint32_t end_ = 0;
  std::vector<uint32_t> free_[128];
};

}  // namespace grisaille::sspm
