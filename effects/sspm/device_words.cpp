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
  size_ = 0;
  buffer_ = {};
  deviceWords_ = 0;
  planned_ = 0;
}

uint64_t DeviceWords::sizeFor(uint64_t words) const {
  return std::max({words + words / 32, planned_, uint64_t{kLeast}});
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
  return (deviceWords_ + payload_.capacity()) * sizeof(uint32_t) + runs_.capacity() * sizeof(Run);
}

uint64_t DeviceWords::peakBytes(size_t words) const {
  words = std::max(words, size_);
  return bytes() + (words > deviceWords_ ? sizeFor(words) * sizeof(uint32_t) : 0);
}

Uploader::Uploader(const plugin::Host& host)
    : host_(host), scatter_(host, "scatter", grisaille_shader_sspm_scatter) {}

void Uploader::upload(const plugin::Frame& frame, DeviceWords& words) {
  grow(frame, words);
  std::vector<uint32_t> runs, payload;
  const auto flush = [&] {
    if (payload.empty()) return;
    std::vector<uint32_t> staging = {static_cast<uint32_t>(payload.size()),
                                     static_cast<uint32_t>(runs.size() / 2),
                                     static_cast<uint32_t>(kHeader + runs.size()), 0};
    staging.insert(staging.end(), runs.begin(), runs.end());
    staging.insert(staging.end(), payload.begin(), payload.end());
    scatter(frame, staging, {}, words.buffer_);
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
  words.discard();
}

void Uploader::grow(const plugin::Frame& frame, DeviceWords& words) {
  if (words.deviceWords_ >= std::max(words.size_, kLeast)) return;
  const size_t grown = words.sizeFor(words.size_);
  plugin::Buffer larger = host_.buffer(words.label_, grown * sizeof(uint32_t));
  if (words.deviceWords_ > 0) {
    const uint32_t copy[] = {static_cast<uint32_t>(words.deviceWords_), 1, 0, 0, 0, 0};
    scatter(frame, copy, words.buffer_, larger);
  } else {
    // Shaders may bind an array before it has contents, not before its first write.
    const uint32_t nothing = 0;
    frame.uploadBuffer(larger, 0, std::span(&nothing, 1));
  }
  words.buffer_ = std::move(larger);
  words.deviceWords_ = grown;
}

// source: holds the payload; 0: `staging` does.
void Uploader::scatter(const plugin::Frame& frame, std::span<const uint32_t> staging,
                       grisaille_buffer source, grisaille_buffer target) {
  if (stagingWords_ < staging.size()) {
    stagingWords_ = std::max(staging.size(), kLeast);
    staging_ = host_.buffer("changes", stagingWords_ * sizeof(uint32_t));
  }
  frame.uploadBuffer(staging_, 0, staging);
  const grisaille_binding bindings[] = {
      plugin::storage(0, plugin::whole(staging_)),
      plugin::storage(1, plugin::whole(source.id == 0 ? staging_ : source)),
      plugin::storage(2, plugin::whole(target))};
  const size_t groups = std::clamp<size_t>(staging[0] / kThreads + 1, 1, kMostGroups);
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
