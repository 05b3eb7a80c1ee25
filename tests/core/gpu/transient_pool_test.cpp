// SPDX-License-Identifier: MIT
#include "core/gpu/transient_pool.h"

#include <gtest/gtest.h>

#include <set>

namespace grisaille::gpu {
namespace {

class TransientPoolTest : public ::testing::Test {
 protected:
  Texture take(uint32_t width) {
    return pool_.take({.format = Format::kR32Float, .width = width, .height = 8},
                      [this](const TextureDesc&) {
                        const Texture made{next_++};
                        alive_.insert(made.value);
                        return made;
                      });
  }
  void endFrame() {
    pool_.endFrame([this](Texture texture) { EXPECT_EQ(alive_.erase(texture.value), 1u); });
  }

  TransientPool pool_;
  uint32_t next_ = 1;
  std::set<uint32_t> alive_;
};

TEST_F(TransientPoolTest, GivesEachOutOnceAFrame) {
  const Texture a = take(8), b = take(8), c = take(9);
  EXPECT_EQ((std::set{a.value, b.value, c.value}).size(), 3u);
}

TEST_F(TransientPoolTest, ReusesWhatIsAlike) {
  for (int frame = 0; frame < 100; ++frame) {
    take(8);
    take(8);
    take(9);
    endFrame();
  }
  EXPECT_EQ(next_, 4u);
}

TEST_F(TransientPoolTest, EveryFieldButTheLabelCounts) {
  std::set<uint32_t> made;
  const TextureDesc plain{.label = "one", .format = Format::kR32Float, .width = 8, .height = 8};
  TextureDesc descs[7];
  for (TextureDesc& desc : descs) desc = plain;
  descs[1].format = Format::kR16Float;
  descs[2].width = 9;
  descs[3].height = 9;
  descs[4].mips = 2;
  descs[5].layers = 2;
  descs[6].usage = TextureUsage::kTarget;
  for (const TextureDesc& desc : descs) {
    const Texture taken = pool_.take(desc, [this](const TextureDesc&) { return Texture{next_++}; });
    made.insert(taken.value);
    pool_.endFrame([](Texture) {});
  }
  EXPECT_EQ(made.size(), 7u);
  TextureDesc renamed = descs[6];
  renamed.label = "another";
  pool_.take(renamed, [](const TextureDesc&) -> Texture {
    throw std::logic_error("created instead of reused");
  });
}

TEST_F(TransientPoolTest, DropsWhatStaysIdle) {
  take(8);
  endFrame();
  EXPECT_EQ(alive_.size(), 1u);
  for (int frame = 0; frame < 10; ++frame) {
    take(9);
    endFrame();
  }
  EXPECT_EQ(alive_.size(), 1u);
  for (int frame = 0; frame < 10; ++frame) endFrame();
  EXPECT_TRUE(alive_.empty());
}

}  // namespace
}  // namespace grisaille::gpu
