// SPDX-License-Identifier: MIT
// Owners of a host's resources: what an owner gives up is destroyed at once.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "grisaille/effect_host.hpp"

namespace grisaille::tests {
namespace {

class OwnedTest : public ::testing::Test {
 protected:
  OwnedTest() {
    destroyed.clear();
    host_.destroy_buffer = [](const grisaille_host*, grisaille_buffer buffer) {
      destroyed.push_back(buffer.id);
    };
  }
  plugin::Buffer buffer(uint32_t id) { return {&host_, {id}}; }

  static inline std::vector<uint64_t> destroyed;
  grisaille_host host_ = {};
};

TEST_F(OwnedTest, AssignmentDestroysWhatWasOwned) {
  {
    plugin::Buffer buffer = this->buffer(1), larger = this->buffer(2);
    buffer = std::move(larger);
    EXPECT_EQ(destroyed, std::vector<uint64_t>{1});
    EXPECT_FALSE(larger);  // NOLINT(bugprone-use-after-move): documented
    buffer = {};
    EXPECT_EQ(destroyed, (std::vector<uint64_t>{1, 2}));
    EXPECT_FALSE(buffer);
  }
  EXPECT_EQ(destroyed, (std::vector<uint64_t>{1, 2}));
}

TEST_F(OwnedTest, AssignmentToItselfKeepsTheResource) {
  plugin::Buffer buffer = this->buffer(1);
  plugin::Buffer& same = buffer;
  buffer = std::move(same);
  EXPECT_TRUE(buffer);
  EXPECT_TRUE(destroyed.empty());
}

TEST_F(OwnedTest, ExchangesDestroyNothing) {
  plugin::Buffer now = this->buffer(1), then = this->buffer(2);
  std::swap(now, then);
  EXPECT_TRUE(destroyed.empty());
  EXPECT_EQ(static_cast<grisaille_buffer>(now).id, 2u);
}

}  // namespace
}  // namespace grisaille::tests
