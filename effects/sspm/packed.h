// SPDX-License-Identifier: MIT
// A vector of 16 bytes, for many short lists. It grows by a quarter and shrinks as it empties.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>

namespace grisaille::sspm {

template <typename T>
class Packed {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  Packed() = default;
  Packed(Packed&& other) noexcept { swap(other); }
  Packed& operator=(Packed&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Packed() { std::free(items_); }

  size_t size() const { return size_; }
  size_t capacity() const { return capacity_; }
  bool empty() const { return size_ == 0; }
  T* begin() { return items_; }
  T* end() { return items_ + size_; }
  const T* begin() const { return items_; }
  const T* end() const { return items_ + size_; }
  T& operator[](size_t i) { return items_[i]; }
  const T& operator[](size_t i) const { return items_[i]; }

  // Throws std::bad_alloc.
  void insert(size_t at, const T& item) {
    const T copy = item;
    if (size_ == capacity_) setCapacity(capacity_ + capacity_ / 4 + 1);
    std::memmove(items_ + at + 1, items_ + at, (size_ - at) * sizeof(T));
    items_[at] = copy;
    ++size_;
  }
  void add(const T& item) { insert(size_, item); }

  // Returns the number of erased items. Calls erased() once for each item, in order.
  template <typename Erased>
  size_t eraseIf(const Erased& erased) {
    T* kept = begin();
    for (T* item = begin(); item != end(); ++item) {
      if (!erased(*item)) *kept++ = *item;
    }
    const auto count = static_cast<size_t>(end() - kept);
    truncate(size_ - count);
    return count;
  }
  // Keeps the first items.
  void truncate(size_t size) {
    const bool fewer = size < size_;
    size_ = static_cast<uint32_t>(size);
    if (fewer && (size_ == 0 || size_ < capacity_ / 2)) setCapacity(size_);
  }

 private:
  void setCapacity(uint32_t capacity) {
    if (capacity == 0) {
      std::free(std::exchange(items_, nullptr));
    } else {
      void* moved = std::realloc(items_, capacity * sizeof(T));
      if (moved == nullptr) throw std::bad_alloc();
      items_ = static_cast<T*>(moved);
    }
    capacity_ = capacity;
  }
  void swap(Packed& other) {
    std::swap(items_, other.items_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }

  T* items_ = nullptr;
  uint32_t size_ = 0;
  uint32_t capacity_ = 0;
};

}  // namespace grisaille::sspm
