// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <istream>
#include <ostream>
#include <string>
#include <type_traits>

#include "core/base/error.h"
#include "core/shots/formats.h"
#include "core/shots/shot.h"

namespace grisaille::shots {
namespace {

constexpr std::array<unsigned char, 8> kMagic = {kBinaryMark, 'G', 'R', 'S', 'H', '\r', '\n', 0x1a};
constexpr uint32_t kBinaryVersion = 1;
constexpr size_t kVersionAt = kMagic.size();
constexpr size_t kCountAt = kVersionAt + 4;
constexpr size_t kHeaderBytes = kCountAt + 8;
constexpr size_t kShotBytes = 52;
constexpr size_t kHashBytes = 8;
constexpr size_t kShotsAtOnce = 4096;

template <typename T>
using BitsOf = std::conditional_t<sizeof(T) == 8, uint64_t, uint32_t>;

template <typename T>
void put(std::string& bytes, T value) {
  const auto bits = std::bit_cast<BitsOf<T>>(value);
  std::array<char, sizeof(T)> little;
  for (size_t i = 0; i < sizeof(T); ++i) little[i] = static_cast<char>(bits >> (8 * i) & 0xff);
  bytes.append(little.data(), little.size());
}

template <typename T>
T take(const char*& at) {
  BitsOf<T> bits = 0;
  for (size_t i = 0; i < sizeof(T); ++i) {
    bits |= BitsOf<T>{static_cast<unsigned char>(*at++)} << (8 * i);
  }
  return std::bit_cast<T>(bits);
}

void putShot(std::string& bytes, const grisaille_shot& shot) {
  for (const double value : shot.origin) put(bytes, value);
  for (const float value : shot.direction) put(bytes, value);
  for (const float value : shot.color) put(bytes, value);
  put(bytes, shot.range);
}

ShotValues takeShot(const char* at) {
  ShotValues values;
  for (double& value : values.origin) value = take<double>(at);
  for (double& value : values.direction) value = double{take<float>(at)};
  for (double& value : values.color) value = double{take<float>(at)};
  values.range = double{take<float>(at)};
  return values;
}

// FNV-1a of 64 bits: each step is a bijection, so that no single changed byte goes unseen.
class Hash {
 public:
  void add(const std::string& bytes) {
    for (const char byte : bytes) {
      value_ = (value_ ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
    }
  }
  uint64_t value() const { return value_; }

 private:
  uint64_t value_ = 0xcbf29ce484222325u;
};

[[noreturn]] void refuse(uint64_t byte, std::string_view why) {
  throw Error(ErrorId::kShotFileInvalid, " byte {}: {}", byte, why);
}

class BinaryReader {
 public:
  BinaryReader(std::istream& in, uint64_t bytes) : in_(in), bytes_(bytes) {}

  std::vector<grisaille_shot> read() {
    const uint64_t count = readHeader();
    std::vector<grisaille_shot> shots;
    shots.reserve(count);
    while (shots.size() < count) {
      const uint64_t start = at_;
      const size_t next = std::min<size_t>(count - shots.size(), kShotsAtOnce);
      fetch(next * kShotBytes);
      hash_.add(chunk_);
      for (size_t i = 0; i < next; ++i) {
        shots.push_back(decode(i * kShotBytes, start, shots.size()));
      }
    }
    const uint64_t hash = hash_.value();
    fetch(kHashBytes);
    const char* at = chunk_.data();
    if (take<uint64_t>(at) != hash) refuse(at_ - kHashBytes, "the checksum is not the file's own");
    return shots;
  }

 private:
  // Returns the number of shots.
  uint64_t readHeader() {
    if (bytes_ < kHeaderBytes + kHashBytes) refuse(bytes_, "the file ends too early");
    fetch(kHeaderBytes);
    hash_.add(chunk_);
    for (size_t i = 0; i < kMagic.size(); ++i) {
      if (static_cast<unsigned char>(chunk_[i]) != kMagic[i]) {
        refuse(i, "a file of shots begins otherwise");
      }
    }
    const char* at = chunk_.data() + kVersionAt;
    const auto version = take<uint32_t>(at);
    if (version != kBinaryVersion) {
      throw Error(ErrorId::kShotFileVersion, " byte {}: version {}, and only {} can be read",
                  kVersionAt, version, kBinaryVersion);
    }
    const auto count = take<uint64_t>(at);
    const uint64_t room = bytes_ - kHeaderBytes - kHashBytes;
    if (count != room / kShotBytes || room % kShotBytes != 0) {
      refuse(kCountAt, fmt::format("a file of {} bytes holds no {} shots", bytes_, count));
    }
    return count;
  }

  grisaille_shot decode(size_t offset, uint64_t chunkStart, size_t index) const {
    try {
      return makeShot(takeShot(chunk_.data() + offset));
    } catch (const Error& error) {
      refuse(chunkStart + offset, fmt::format("shots[{}].{}", index, error.detail()));
    }
  }

  // The next `size` bytes into chunk_.
  void fetch(size_t size) {
    chunk_.resize(size);
    in_.read(chunk_.data(), static_cast<std::streamsize>(size));
    if (!in_) throw Error(ErrorId::kShotFileUnreadable, " byte {}: cannot be read", at_);
    at_ += size;
  }

  std::istream& in_;
  uint64_t bytes_;
  uint64_t at_ = 0;
  std::string chunk_;
  Hash hash_;
};

}  // namespace

void writeBinary(std::span<const grisaille_shot> shots, std::ostream& out) {
  Hash hash;
  std::string chunk(kMagic.begin(), kMagic.end());
  const auto flush = [&] {
    hash.add(chunk);
    out.write(chunk.data(), static_cast<std::streamsize>(chunk.size()));
    chunk.clear();
  };
  put(chunk, kBinaryVersion);
  put(chunk, uint64_t{shots.size()});
  for (const grisaille_shot& shot : shots) {
    putShot(chunk, shot);
    if (chunk.size() >= kShotsAtOnce * kShotBytes) flush();
  }
  flush();
  put(chunk, hash.value());
  flush();
}

std::vector<grisaille_shot> readBinary(std::istream& in, uint64_t bytes) {
  return BinaryReader(in, bytes).read();
}

}  // namespace grisaille::shots
