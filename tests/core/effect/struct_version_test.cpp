// SPDX-License-Identifier: MIT
// Structs that have grown, filled by plugins of an older or a newer version.
#include "core/effect/struct_version.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/support/expect_error.h"

namespace grisaille::effect {
namespace {

// The current version. The first version ended after `kind`, the second after `count`.
struct Desc {
  uint32_t struct_size = 0;
  uint32_t kind = 0;
  uint64_t count = 0;
  const char* key = nullptr;
  double (*answer)(double) = nullptr;
};
constexpr size_t kFirst = offsetof(Desc, count), kSecond = offsetof(Desc, key);
constexpr std::initializer_list<size_t> kSizes = {sizeof(Desc), kFirst, kSecond};

Desc filled(size_t size) {
  return {.struct_size = static_cast<uint32_t>(size),
          .kind = 7,
          .count = 8,
          .key = "key",
          .answer = [](double x) { return x; }};
}

TEST(StructVersion, SizesOfEveryVersionAreTaken) {
  for (const size_t size : kSizes) {
    EXPECT_NO_THROW(checkStructSize("it", static_cast<uint32_t>(size), kSizes)) << size;
  }
}

TEST(StructVersion, EveryOtherSizeIsRefused) {
  for (uint32_t size = 0; size < 2 * sizeof(Desc); ++size) {
    if (std::ranges::find(kSizes, size) != kSizes.end()) continue;
    EXPECT_ERROR(ErrorId::kPluginTable, checkStructSize("it", size, kSizes));
  }
  EXPECT_ERROR(ErrorId::kPluginTable, checkStructSize("it", ~0u, kSizes));
}

TEST(StructVersion, TheMessageTellsNewerFromUnknown) {
  const auto words = [](uint32_t size) {
    try {
      checkStructSize("effects[0]", size, kSizes);
    } catch (const Error& error) {
      return error.detail();
    }
    return std::string();
  };
  EXPECT_EQ(words(sizeof(Desc) + 8),
            fmt::format("effects[0].struct_size is {}, more than the {} that this program knows",
                        sizeof(Desc) + 8, sizeof(Desc)));
  EXPECT_EQ(words(4), fmt::format("effects[0].struct_size is 4, which no version has; versions "
                                  "have {}, {}, {}",
                                  sizeof(Desc), kFirst, kSecond));
}

TEST(StructVersion, FieldsBeyondTheSizeReadAsZero) {
  const Desc now = filled(sizeof(Desc));
  EXPECT_EQ(whole(&now).count, 8u);
  EXPECT_STREQ(whole(&now).key, "key");
  EXPECT_EQ(whole(&now).answer(3), 3);
  const Desc second = filled(kSecond);
  EXPECT_EQ(whole(&second).count, 8u);
  EXPECT_EQ(whole(&second).key, nullptr);
  EXPECT_EQ(whole(&second).answer, nullptr);
  const Desc first = filled(kFirst);
  EXPECT_EQ(whole(&first).kind, 7u);
  EXPECT_EQ(whole(&first).count, 0u);
  EXPECT_EQ(whole(&first).key, nullptr);
}

// Under sanitizers, a read beyond the struct fails the test.
TEST(StructVersion, NothingBehindAnOlderStructIsRead) {
  const Desc first = filled(kFirst);
  const auto* bytes = reinterpret_cast<const std::byte*>(&first);
  const std::vector<std::byte> exact(bytes, bytes + kFirst);
  EXPECT_EQ(whole(reinterpret_cast<const Desc*>(exact.data())).kind, 7u);
}

}  // namespace
}  // namespace grisaille::effect
