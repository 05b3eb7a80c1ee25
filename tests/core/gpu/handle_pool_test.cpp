// SPDX-License-Identifier: MIT
#include "core/gpu/handle_pool.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>

#include "tests/support/expect_error.h"

namespace grisaille::gpu {
namespace {

using Pool = HandlePool<Buffer, std::string>;

// Compared with a map: handles are unique, find their value while it lives, and are stale
// afterwards.
TEST(HandlePool, BehavesAsAMap) {
  std::mt19937 random(7);
  Pool pool("buffer");
  std::map<uint32_t, std::string> model;
  std::vector<Buffer> dead;
  for (int step = 0; step < 20000; ++step) {
    if (model.empty() || random() % 5 < 2 + (model.size() < 100 ? 1 : 0)) {
      const std::string value = std::to_string(step);
      const Buffer handle = pool.add(value);
      EXPECT_TRUE(handle);
      EXPECT_TRUE(model.emplace(handle.value, value).second);
    } else {
      const auto victim = std::next(model.begin(), random() % model.size());
      EXPECT_EQ(pool.remove({victim->first}), victim->second);
      dead.push_back({victim->first});
      model.erase(victim);
    }
    if (!dead.empty()) {
      const Buffer stale = dead[random() % dead.size()];
      // A slot's generation repeats after 65535 uses, more than this test reaches.
      EXPECT_ERROR(ErrorId::kStaleHandle, pool.get(stale));
    }
  }
  size_t visited = 0;
  pool.forEach([&](Buffer handle, const std::string& value) {
    EXPECT_EQ(model.at(handle.value), value);
    ++visited;
  });
  EXPECT_EQ(visited, model.size());
}

TEST(HandlePool, NothingIsFoundByTheNullHandle) {
  Pool pool("buffer");
  EXPECT_ERROR(ErrorId::kStaleHandle, pool.get({}));
  pool.add("first");
  EXPECT_ERROR(ErrorId::kStaleHandle, pool.get({}));
  EXPECT_ERROR(ErrorId::kStaleHandle, pool.remove({.value = 0x1ffff}));
}

TEST(HandlePool, IsFullAt65535) {
  HandlePool<Sampler, int> pool("sampler");
  std::vector<Sampler> all;
  for (int i = 0; i < 65535; ++i) all.push_back(pool.add(i));
  EXPECT_ERROR(ErrorId::kTooManyResources, pool.add(0));
  pool.remove(all[1234]);
  EXPECT_EQ(pool.add(1).index(), 1234u);
}

TEST(HandlePool, GenerationsNeverBecomeZero) {
  HandlePool<Sampler, int> pool("sampler");
  Sampler before;
  for (int i = 0; i < 70000; ++i) {
    const Sampler handle = pool.add(i);
    EXPECT_NE(handle.generation(), 0u);
    EXPECT_NE(handle, before);
    before = handle;
    pool.remove(handle);
  }
}

}  // namespace
}  // namespace grisaille::gpu
