// SPDX-License-Identifier: MIT
#include "device_words.h"

#include <algorithm>
#include <iterator>

#include "shaders/sspm_scatter.h"

namespace grisaille::sspm {
namespace {

// shaders/sspm/scatter.comp
constexpr size_t kHeader = 4;        // words: payload words, runs, first payload word, unused
constexpr size_t kThreads = 64;      // threads
constexpr size_t kMostGroups = 256;  // a thread writes several words
constexpr size_t kBatch = 1 << 18;   // most payload words in one dispatch: 1 MiB
constexpr size_t kLeast = 1 << 10;   // least words of an array
constexpr size_t kMoved = 1 << 16;   // words that a frame moves at least
// An array with less than this share of its words free moves: if it is planned, and if not. The
// next one is larger by an eighth or by all of it.
constexpr size_t kPlannedFull = 16, kNearlyFull = 4;

}  // namespace

void DeviceWords::resize(size_t words) {
  size_ = std::max(size_, words);
}

// Returns the memory, which the clear() of containers would keep.
void DeviceWords::discard() {
  payload_ = std::vector<uint32_t>();
  runs_ = std::vector<Run>();
  runAt_ = std::unordered_map<size_t, size_t>();
}

void DeviceWords::clear() {
  discard();
  size_ = uploaded_ = 0;
  buffer_ = {};
  larger_ = {};
  deviceWords_ = largerWords_ = 0;
  planned_ = 0;
}

uint64_t DeviceWords::sizeFor(uint64_t words) const {
  return std::max({words + words / 32, planned_, uint64_t{kLeast}});
}

// Without a plan, only an array that has just grown: others may stay as they are for long.
uint64_t DeviceWords::wantedWords(uint64_t most) const {
  if (deviceWords_ == 0 || size_ > deviceWords_) return 0;
  if (planned_ > std::max(deviceWords_, largerWords_)) return planned_;
  const bool isPlanned = planned_ > 0;
  const size_t free = deviceWords_ - size_;
  if (largerWords_ > 0 || size_ <= uploaded_) return 0;
  if (free >= size_ / (isPlanned ? kPlannedFull : kNearlyFull)) return 0;
  if (isPlanned) return size_ + size_ / 8;
  const uint64_t wanted = size_ > most / 4 ? most : 2 * size_;
  return wanted > deviceWords_ ? wanted : 0;
}

std::span<uint32_t> DeviceWords::write(size_t first, size_t count) {
  const auto [at, added] = runAt_.try_emplace(first, runs_.size());
  if (!added) {
    Run& waiting = runs_[at->second];
    if (waiting.count == count) return std::span(payload_).subspan(waiting.payload, count);
    waiting.count = 0;
  }
  at->second = runs_.size();
  // The limit of memory counts the capacity: less than twice the contents.
  const auto reserve = [](auto& list, size_t wanted) {
    if (wanted > list.capacity()) list.reserve(std::max(wanted, list.capacity() / 4 * 5));
  };
  reserve(runs_, runs_.size() + 1);
  reserve(payload_, payload_.size() + count);
  runs_.push_back({.payload = payload_.size(), .target = first, .count = count});
  payload_.resize(payload_.size() + count);
  return std::span(payload_).last(count);
}

void DeviceWords::drop(size_t first) {
  const auto at = runAt_.find(first);
  if (at == runAt_.end()) return;
  runs_[at->second].count = 0;
  runAt_.erase(at);
}

uint64_t DeviceWords::bytes() const {
  return (deviceWords_ + largerWords_ + payload_.capacity()) * sizeof(uint32_t) +
         runs_.capacity() * sizeof(Run);
}

uint64_t DeviceWords::peakBytes(size_t words) const {
  words = std::max(words, size_);
  const bool grows = words > std::max(deviceWords_, largerWords_);
  return bytes() + (grows ? sizeFor(words) * sizeof(uint32_t) : 0);
}

Uploader::Uploader(const plugin::Host& host)
    : host_(host), scatter_(host, "scatter", grisaille_shader_sspm_scatter) {}

void Uploader::upload(const plugin::Frame& frame, DeviceWords& words, uint64_t spare,
                      uint64_t most) {
  const uint64_t wanted = words.wantedWords(most / sizeof(uint32_t));
  if (words.size_ > words.deviceWords_ || words.deviceWords_ == 0) {
    grow(frame, words);
  } else if (wanted > 0 && wanted * sizeof(uint32_t) <= spare) {
    begin(words, wanted);
  }
  write(frame, words);
  if (words.largerWords_ > 0) {
    // So much that the array has moved before it is full.
    const size_t grown = words.size_ - words.uploaded_, left = words.toMove_ - words.moved_;
    const size_t room = std::max<size_t>(words.deviceWords_ - words.size_, 1);
    move(frame, words, std::max(kMoved, 4 * grown * left / room));
  }
  words.uploaded_ = words.size_;
  words.discard();
}

// Writes what waits, also to the array to which the words move.
void Uploader::write(const plugin::Frame& frame, const DeviceWords& words) {
  std::vector<uint32_t> runs, payload;
  const auto flush = [&] {
    if (payload.empty()) return;
    std::vector<uint32_t> staging = {static_cast<uint32_t>(payload.size()),
                                     static_cast<uint32_t>(runs.size() / 2),
                                     static_cast<uint32_t>(kHeader + runs.size()), 0};
    staging.insert(staging.end(), runs.begin(), runs.end());
    staging.insert(staging.end(), payload.begin(), payload.end());
    stage(frame, staging);
    scatter(frame, payload.size(), staging_, words.buffer_);
    if (words.largerWords_ > 0) scatter(frame, payload.size(), staging_, words.larger_);
    runs.clear();
    payload.clear();
  };
  for (const DeviceWords::Run& run : words.runs_) {
    for (size_t done = 0; done < run.count;) {
      const size_t count = std::min(run.count - done, kBatch - payload.size());
      runs.push_back(static_cast<uint32_t>(payload.size()));
      runs.push_back(static_cast<uint32_t>(run.target + done));
      const auto from = words.payload_.begin() + static_cast<std::ptrdiff_t>(run.payload + done);
      payload.insert(payload.end(), from, from + static_cast<std::ptrdiff_t>(count));
      done += count;
      if (payload.size() == kBatch) flush();
    }
  }
  flush();
}

// Makes the larger array, of `count` words.
void Uploader::begin(DeviceWords& words, size_t count) {
  words.larger_ = host_.buffer(words.label_, count * sizeof(uint32_t));
  words.largerWords_ = count;
  words.toMove_ = words.uploaded_;
  words.moved_ = 0;
}

// Makes the array as large as its words need, in this frame.
void Uploader::grow(const plugin::Frame& frame, DeviceWords& words) {
  if (std::max<size_t>(words.size_, 1) > words.largerWords_) {
    begin(words, words.sizeFor(words.size_));
    // Shaders may bind an array before it has contents, not before its first write.
    const uint32_t nothing = 0;
    if (words.deviceWords_ == 0) frame.uploadBuffer(words.larger_, 0, std::span(&nothing, 1));
  }
  move(frame, words, words.toMove_);
}

// Moves words to the larger array, at most `count`. It replaces the other one with the last of
// them.
void Uploader::move(const plugin::Frame& frame, DeviceWords& words, size_t count) {
  count = std::min(count, words.toMove_ - words.moved_);
  if (count > 0) {
    const auto first = static_cast<uint32_t>(words.moved_);
    const uint32_t staging[] = {static_cast<uint32_t>(count), 1, first, 0, 0, first};
    stage(frame, staging);
    scatter(frame, count, words.buffer_, words.larger_);
    words.moved_ += count;
  }
  if (words.moved_ < words.toMove_) return;
  words.buffer_ = std::move(words.larger_);
  words.deviceWords_ = std::exchange(words.largerWords_, 0);
}

void Uploader::stage(const plugin::Frame& frame, std::span<const uint32_t> staging) {
  if (stagingWords_ < staging.size()) {
    stagingWords_ = std::max(staging.size(), kLeast);
    staging_ = host_.buffer("changes", stagingWords_ * sizeof(uint32_t));
  }
  frame.uploadBuffer(staging_, 0, staging);
}

// Writes staged runs. words: of their payload, which `source` holds.
void Uploader::scatter(const plugin::Frame& frame, size_t words, grisaille_buffer source,
                       grisaille_buffer target) {
  const grisaille_binding bindings[] = {plugin::storage(0, plugin::whole(staging_)),
                                        plugin::storage(1, plugin::whole(source)),
                                        plugin::storage(2, plugin::whole(target))};
  const size_t groups = std::clamp<size_t>(words / kThreads + 1, 1, kMostGroups);
  frame.pass("changes",
             [&] { frame.dispatch(scatter_.get({}), bindings, static_cast<uint32_t>(groups), 1); });
}

uint32_t Runs::take(uint32_t count) {
  const auto fit = bySize_.lower_bound({count, 0});
  if (fit == bySize_.end()) {
    const uint32_t first = end_;
    end_ += count;
    words_.resize(size_t{end_} * unit_);
    return first;
  }
  const auto [size, first] = *fit;
  bySize_.erase(fit);
  spaces_.erase(first);
  free_ -= size;
  if (size > count) addSpace(first + count, size - count);
  return first;
}

bool Runs::fits(uint32_t count) const {
  return bySize_.lower_bound({count, 0}) != bySize_.end() ||
         (uint64_t{end_} + count) * unit_ <= words_.capacity();
}

void Runs::give(uint32_t first, uint32_t count) {
  auto next = spaces_.lower_bound(first);
  if (next != spaces_.end() && next->first == first + count) {
    count += next->second;
    free_ -= next->second;
    bySize_.erase({next->second, next->first});
    next = spaces_.erase(next);
  }
  if (next != spaces_.begin()) {
    const auto last = std::prev(next);
    if (last->first + last->second == first) {
      first = last->first;
      count += last->second;
      free_ -= last->second;
      bySize_.erase({last->second, last->first});
      spaces_.erase(last);
    }
  }
  addSpace(first, count);
}

void Runs::addSpace(uint32_t first, uint32_t count) {
  spaces_.emplace(first, count);
  bySize_.emplace(count, first);
  free_ += count;
}

uint64_t Runs::freeWords() const {
  return words_.capacity() - size_t{end_} * unit_ + free_ * unit_;
}

void Runs::clear() {
  spaces_.clear();
  bySize_.clear();
  end_ = 0;
  free_ = 0;
}

}  // namespace grisaille::sspm
