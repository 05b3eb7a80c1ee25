// SPDX-License-Identifier: MIT
#include "core/base/nearest.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace grisaille {
namespace {

TEST(Nearest, FindsWhatWasMeantAndNothingElse) {
  const std::vector<std::string> keys = {"radius", "bias", "blur", "kernel_size", "blur_size"};
  for (const std::string& key : keys) {
    EXPECT_EQ(nearest(key, keys), key);
    for (size_t i = 0; i < key.size(); ++i) {  // one letter missing, doubled or swapped
      std::string out = key, twice = key, swapped = key;
      out.erase(i, 1);
      twice.insert(i, 1, key[i]);
      if (i > 0) std::swap(swapped[i], swapped[i - 1]);
      EXPECT_EQ(nearest(out, keys), key) << out;
      EXPECT_EQ(nearest(twice, keys), key) << twice;
      EXPECT_EQ(nearest(swapped, keys), key) << swapped;
    }
  }
  EXPECT_EQ(nearest("intensity", keys), "");
  EXPECT_EQ(nearest("", keys), "");
  EXPECT_EQ(nearest("radius", {}), "");
}

// A key from a file may be as long as the file. Comparing lengths alone must reject it.
TEST(Nearest, LongWordsTakeNoTime) {
  const std::vector<std::string> keys = {"radius", std::string(1000, 'r')};
  EXPECT_EQ(nearest(std::string(8'000'000, 'r'), keys), "");
}

}  // namespace
}  // namespace grisaille
