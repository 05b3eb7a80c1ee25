// SPDX-License-Identifier: MIT
#include "core/gpu/state_tracker.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "tests/core/gpu/checked_null.h"

namespace grisaille::gpu {
namespace {

// One subresource, or a buffer (with mip and layer 0).
struct Place {
  bool texture = false;
  uint32_t handle = 0, mip = 0, layer = 0;
  auto operator<=>(const Place&) const = default;
};
using Change = std::pair<Access, Access>;
using Changes = std::map<Place, Change>;

// Reference model: tracks each subresource separately.
struct Model {
  std::map<Place, Access> states, pending;

  void use(const Place& place, Access access) { pending[place] = pending[place] | access; }
  Changes flush() {
    Changes changes;
    for (const auto& [place, after] : pending) {
      const Access before = states[place];
      const bool onlyReads = !has(before, kWriteAccess);
      if (before != after || !onlyReads) changes[place] = {before, after};
      states[place] = after;
    }
    pending.clear();
    return changes;
  }
};

Changes expanded(std::span<const Transition> transitions) {
  Changes changes;
  for (const Transition& t : transitions) {
    const Change change{t.before, t.after};
    if (t.buffer) {
      EXPECT_FALSE(t.texture);
      EXPECT_TRUE(changes.emplace(Place{false, t.buffer.value, 0, 0}, change).second);
      continue;
    }
    for (uint32_t layer = t.layer; layer < t.layer + t.layerCount; ++layer) {
      for (uint32_t mip = t.mip; mip < t.mip + t.mipCount; ++mip) {
        EXPECT_TRUE(changes.emplace(Place{true, t.texture.value, mip, layer}, change).second)
            << "a subresource is named twice";
      }
    }
  }
  return changes;
}

constexpr Access kBufferAccess[] = {Access::kVertex,      Access::kIndex,    Access::kUniform,
                                    Access::kStorageRead, Access::kCopyRead, Access::kStorageWrite,
                                    Access::kCopyWrite};
constexpr Access kTextureAccess[] = {
    Access::kSampled,     Access::kStorageRead, Access::kStorageWrite, Access::kColorTarget,
    Access::kDepthTarget, Access::kCopyRead,    Access::kCopyWrite};

struct TextureShape {
  uint32_t mips, layers;
};
constexpr TextureShape kShapes[] = {{1, 1}, {6, 1}, {1, 5}, {4, 3}, {9, 6}};

class StateTrackerProperty : public ::testing::Test {
 protected:
  StateTrackerProperty() {
    for (uint32_t i = 0; i < 3; ++i) tracker_.add(bufferOf(i));
    for (uint32_t i = 0; i < std::size(kShapes); ++i) {
      tracker_.add(textureOf(i), kShapes[i].mips, kShapes[i].layers);
    }
  }
  // Handles of buffers and textures share the same values.
  static Buffer bufferOf(uint32_t i) { return {0x10000u + i}; }
  static Texture textureOf(uint32_t i) { return {0x10000u + i}; }
  uint32_t below(uint32_t end) { return static_cast<uint32_t>(random_() % end); }

  void useRandomly() {
    if (below(3) == 0) {
      const uint32_t i = below(3);
      const Access access = kBufferAccess[below(std::size(kBufferAccess))];
      tracker_.use(bufferOf(i), access);
      model_.use({false, bufferOf(i).value, 0, 0}, access);
      return;
    }
    const uint32_t i = below(std::size(kShapes));
    const auto [mips, layers] = kShapes[i];
    const Access access = kTextureAccess[below(std::size(kTextureAccess))];
    TextureView view{.texture = textureOf(i), .mip = below(mips), .layer = below(layers)};
    view.mipCount = below(mips - view.mip + 1);  // 0: all remaining mips
    view.layerCount = below(layers - view.layer + 1);
    tracker_.use(view, access);
    const uint32_t mipEnd = view.mipCount == 0 ? mips : view.mip + view.mipCount;
    const uint32_t layerEnd = view.layerCount == 0 ? layers : view.layer + view.layerCount;
    for (uint32_t layer = view.layer; layer < layerEnd; ++layer) {
      for (uint32_t mip = view.mip; mip < mipEnd; ++mip) {
        model_.use({true, view.texture.value, mip, layer}, access);
      }
    }
  }

  std::mt19937 random_{99};
  StateTracker tracker_;
  Model model_;
};

TEST_F(StateTrackerProperty, TransitionsAreThoseOfEverySubresource) {
  for (int call = 0; call < 20000; ++call) {
    for (uint32_t uses = below(5); uses > 0; --uses) useRandomly();
    ASSERT_EQ(expanded(tracker_.flush()), model_.flush()) << "call " << call;
  }
}

TEST_F(StateTrackerProperty, RollingBackForgetsTheFrame) {
  for (int frame = 0; frame < 500; ++frame) {
    const StateTracker trackerBefore = tracker_;
    const Model modelBefore = model_;
    for (int call = 0; call < 10; ++call) {
      for (uint32_t uses = below(4); uses > 0; --uses) useRandomly();
      ASSERT_EQ(expanded(tracker_.flush()), model_.flush());
    }
    if (below(2) == 0) {
      useRandomly();  // a call that is never finished
      tracker_.rollBack(trackerBefore);
      model_ = modelBefore;
    } else {
      tracker_.flush();
    }
  }
}

TEST_F(StateTrackerProperty, RollingBackKeepsWhatCameAndWent) {
  const StateTracker before = tracker_;
  const Texture came{0x20000}, went = textureOf(3);
  tracker_.add(came, 2, 2);
  tracker_.use({.texture = came}, Access::kStorageWrite);
  tracker_.remove(went);
  tracker_.flush();
  tracker_.rollBack(before);
  tracker_.use({.texture = came, .mip = 1}, Access::kSampled);
  tracker_.use({.texture = went}, Access::kSampled);
  const Changes changes = expanded(tracker_.flush());
  EXPECT_EQ(changes, (Changes{{{true, came.value, 1, 0}, {Access::kNone, Access::kSampled}},
                              {{true, came.value, 1, 1}, {Access::kNone, Access::kSampled}}}));
}

TEST_F(StateTrackerProperty, WholeTexturesAreOneTransition) {
  for (uint32_t i = 0; i < std::size(kShapes); ++i) {
    for (const Access access : {Access::kCopyWrite, Access::kSampled}) {
      tracker_.use({.texture = textureOf(i)}, access);
      const std::span<const Transition> transitions = tracker_.flush();
      ASSERT_EQ(transitions.size(), 1u);
      EXPECT_EQ(transitions[0].mipCount, kShapes[i].mips);
      EXPECT_EQ(transitions[0].layerCount, kShapes[i].layers);
    }
  }
}

TEST_F(StateTrackerProperty, ReadsAfterReadsOfTheSameKindNeedNothing) {
  tracker_.use({.texture = textureOf(3)}, Access::kSampled);
  EXPECT_EQ(tracker_.flush().size(), 1u);
  tracker_.use({.texture = textureOf(3)}, Access::kSampled);
  EXPECT_TRUE(tracker_.flush().empty());
  tracker_.use(bufferOf(0), Access::kStorageWrite);
  EXPECT_EQ(tracker_.flush().size(), 1u);
  tracker_.use(bufferOf(0), Access::kStorageWrite);
  EXPECT_EQ(tracker_.flush().size(), 1u) << "a write after a write needs a barrier";
}

TEST_F(StateTrackerProperty, BindingsAreUsedAsTheShaderSays) {
  const Binding bindings[] = {
      textureBinding(0, {.texture = textureOf(1), .mip = 2, .mipCount = 1}, {}),
      imageBinding(0, textureOf(1), 3), uniformBinding(9, {.buffer = bufferOf(2)})};
  tracker_.use(tests::kFilter, bindings);
  EXPECT_EQ(expanded(tracker_.flush()),
            (Changes{{{true, textureOf(1).value, 2, 0}, {Access::kNone, Access::kSampled}},
                     {{true, textureOf(1).value, 3, 0}, {Access::kNone, Access::kStorageWrite}}}));
  const Binding data[] = {storageBinding(0, {.buffer = bufferOf(1)})};
  tracker_.use(tests::kStep, data);
  EXPECT_EQ(expanded(tracker_.flush()),
            (Changes{{{false, bufferOf(1).value, 0, 0},
                      {Access::kNone, Access::kStorageRead | Access::kStorageWrite}}}));
}

// A shader that only reads a resource's size still needs it in a readable state.
TEST_F(StateTrackerProperty, ASlotThatIsNeitherReadNorWrittenIsARead) {
  static constexpr grisaille_shader_slot kSlots[] = {
      {GRISAILLE_SLOT_IMAGE, 0, 0, 0, 0, 0, "r32f", "sized"}};
  static constexpr Shader kSized = tests::computeShader("sized", kSlots);
  tracker_.use({.texture = textureOf(0)}, Access::kStorageWrite);
  tracker_.flush();
  const Binding bindings[] = {imageBinding(0, textureOf(0))};
  tracker_.use(kSized, bindings);
  EXPECT_EQ(
      expanded(tracker_.flush()),
      (Changes{{{true, textureOf(0).value, 0, 0}, {Access::kStorageWrite, Access::kStorageRead}}}));
}

TEST_F(StateTrackerProperty, ViewsOutsideAreRefused) {
  const Texture texture = textureOf(3);  // 4 mips, 3 layers
  const TextureView outside[] = {{.texture = texture, .mip = 4},
                                 {.texture = texture, .mip = 2, .mipCount = 3},
                                 {.texture = texture, .mip = 1, .mipCount = ~0u},
                                 {.texture = texture, .layer = 3},
                                 {.texture = texture, .layer = 1, .layerCount = ~0u}};
  for (const TextureView& view : outside) {
    EXPECT_ERROR(ErrorId::kBindingRange, tracker_.use(view, Access::kSampled));
  }
  EXPECT_TRUE(tracker_.flush().empty());
}

TEST_F(StateTrackerProperty, TheUnknownAreIgnored) {
  tracker_.use(Buffer{.value = 5}, Access::kUniform);
  tracker_.use(TextureView{.texture = {.value = 5}}, Access::kSampled);
  tracker_.use(bufferOf(0), Access::kUniform);
  tracker_.remove(bufferOf(0));
  tracker_.use({.texture = textureOf(0)}, Access::kSampled);
  tracker_.remove(textureOf(0));
  EXPECT_TRUE(tracker_.flush().empty());
}

}  // namespace
}  // namespace grisaille::gpu
