// SPDX-License-Identifier: MIT
// Files of shots, in either format. A binary one is read as it is and once more with its checksum
// made right, which a fuzzer would hardly find.
#include <bit>
#include <sstream>
#include <vector>

#include "core/shots/formats.h"
#include "core/shots/shot.h"
#include "tests/fuzz/fuzz.h"

namespace grisaille::fuzz {
namespace {

using Shots = std::vector<grisaille_shot>;

constexpr size_t kHashBytes = 8;

Shots read(const std::string& bytes) {
  std::istringstream in(bytes);
  const bool binary =
      !bytes.empty() && static_cast<unsigned char>(bytes.front()) == shots::kBinaryMark;
  return binary ? shots::readBinary(in, bytes.size()) : shots::readJson(in);
}

uint64_t bits(double value) {
  return std::bit_cast<uint64_t>(value);
}

void requireSame(const Shots& a, const Shots& b) {
  require(a.size() == b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) {
      require(bits(a[i].origin[k]) == bits(b[i].origin[k]));
      require(bits(a[i].direction[k]) == bits(b[i].direction[k]));
      require(bits(a[i].color[k]) == bits(b[i].color[k]));
    }
    require(bits(a[i].range) == bits(b[i].range));
  }
}

void check(const std::string& bytes) {
  Shots all;
  const bool good =
      accepted({ErrorId::kShotFileInvalid, ErrorId::kShotFileVersion, ErrorId::kShotFileUnreadable},
               [&] { all = read(bytes); });
  if (!good) return;
  for (const grisaille_shot& shot : all) shots::check(shot);
  for (const auto write : {shots::writeBinary, shots::writeJson}) {
    std::ostringstream out;
    write(all, out);
    requireSame(read(out.str()), all);
  }
}

uint64_t checksumOf(std::string_view bytes) {
  uint64_t hash = 0xcbf29ce484222325u;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
  return hash;
}

}  // namespace
}  // namespace grisaille::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace grisaille;
  std::string bytes(fuzz::textOf(data, size));
  fuzz::check(bytes);
  if (size <= fuzz::kHashBytes || data[0] != shots::kBinaryMark) return 0;
  bytes.resize(size - fuzz::kHashBytes);
  const uint64_t hash = fuzz::checksumOf(bytes);
  for (size_t i = 0; i < fuzz::kHashBytes; ++i) {
    bytes.push_back(static_cast<char>(hash >> (8 * i) & 0xff));
  }
  fuzz::check(bytes);
  return 0;
}
