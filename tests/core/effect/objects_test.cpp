// SPDX-License-Identifier: MIT
// What an effect sees of its objects from frame to frame.
#include <random>

#include "tests/core/effect/instance_fixture.h"
#include "tests/core/effect/plugins/mark.h"
#include "tests/support/expect_error.h"

namespace grisaille::effect {
namespace {

struct ObjectsTest : InstanceTest {
  using Keys = std::vector<std::string>;

  const std::vector<gpu::Texture> outputs = {makeTexture("told", gpu::Format::kR32Float)};
  const objects::Table& table = *registry.find("teller").objects();
  Chain chain{Selection(registry, Keys{"teller"})};
  objects::ObjectList& list = *chain.objects("teller");

  ObjectsTest() { chain.start(*device); }
  ~ObjectsTest() override { chain.stop(); }

  // `count` objects, each different from all objects of earlier calls.
  objects::Objects marks(size_t count) {
    objects::Objects made(table);
    objects::Object mark(table);
    for (size_t i = 0; i < count; ++i) {
      mark.at(table, "position").numbers = {static_cast<double>(++made_), 0, 0};
      made.append(mark);
    }
    return made;
  }

  std::vector<float> told() {
    record(chain, "teller", outputs);
    return texelsOf(outputs[0]);
  }
  // Runs a frame that shows all objects. Returns how many leading objects the effect is told are
  // unchanged.
  size_t kept() {
    const std::vector<float> texels = told();
    EXPECT_EQ(texels[0], static_cast<float>(list.size()));
    return static_cast<size_t>(texels[1]);
  }

  int made_ = 0;
};

TEST_F(ObjectsTest, TheEffectSeesTheList) {
  EXPECT_EQ(told()[0], 0);
  list.add(marks(3).view());
  const std::vector<float> texels = told();
  EXPECT_EQ(texels[0], 3);
  EXPECT_EQ(texels[3], 3);
}

TEST_F(ObjectsTest, NothingIsKeptFromBeforeTheFirstFrame) {
  list.add(marks(5).view());
  EXPECT_EQ(kept(), 0u);
  EXPECT_EQ(kept(), 5u);
}

TEST_F(ObjectsTest, AddingKeepsAllAndUndoingAllBefore) {
  list.add(marks(5).view());
  kept();
  list.add(marks(2).view());
  EXPECT_EQ(kept(), 5u);
  EXPECT_EQ(kept(), 7u);
  list.undo();
  EXPECT_EQ(kept(), 5u);
  list.redo();
  EXPECT_EQ(kept(), 5u);
  // Two steps between frames: the shortest of the lists in between counts.
  list.undo();
  list.redo();
  EXPECT_EQ(kept(), 5u);
  EXPECT_EQ(kept(), 7u);
}

TEST_F(ObjectsTest, ChangingOneKeepsThoseBeforeIt) {
  list.add(marks(6).view());
  kept();
  list.set(4, marks(1).view().object(0));
  EXPECT_EQ(kept(), 4u);
  list.remove(2);
  EXPECT_EQ(kept(), 2u);
  list.move(3, 1);
  EXPECT_EQ(kept(), 1u);
}

TEST_F(ObjectsTest, ReplacingKeepsNone) {
  list.add(marks(6).view());
  kept();
  list.replace(marks(8).view());
  EXPECT_EQ(kept(), 0u);
  list.clear();
  EXPECT_EQ(kept(), 0u);
  list.undo();
  EXPECT_EQ(kept(), 0u);
  EXPECT_EQ(kept(), 8u);
}

// Hosts hand over their whole list each time.
TEST_F(ObjectsTest, AssigningKeepsTheCommonBeginning) {
  objects::Objects all = marks(6);
  list.assign(all.view());
  EXPECT_EQ(kept(), 0u);
  list.assign(all.view());
  EXPECT_EQ(kept(), 6u);
  all.append(marks(1).view());
  list.assign(all.view());
  EXPECT_EQ(kept(), 6u);
  list.assign({&table, all.view().data, 3});
  EXPECT_EQ(kept(), 3u);
  objects::Objects others(table);
  others.append(objects::View{&table, all.view().data, 2});
  others.append(marks(4).view());
  list.assign(others.view());
  EXPECT_EQ(kept(), 2u);
  list.assign({});
  EXPECT_EQ(kept(), 0u);
}

TEST_F(ObjectsTest, AFailedFrameDoesNotCount) {
  list.add(marks(5).view());
  kept();
  list.undo();
  chain.selection.set(Assignment{{"teller", "fails"}, "true"});
  EXPECT_ERROR(ErrorId::kEffectRecord, told());
  chain.selection.set(Assignment{{"teller", "fails"}, "false"});
  list.add(marks(7).view());
  EXPECT_EQ(kept(), 0u);
  EXPECT_EQ(kept(), 7u);
}

// A frame with the effect off or its output not wanted does not count either: the effect does not
// record.
TEST_F(ObjectsTest, WhatChangesWhileItDoesNotRecordIsNotKept) {
  list.add(marks(5).view());
  kept();
  chain.selection.find("teller")->on = false;
  list.set(3, marks(1).view().object(0));
  list.add(marks(2).view());
  frame(outputs, {}, [](FrameInputs&) {});
  chain.selection.find("teller")->on = true;
  EXPECT_EQ(kept(), 3u);
}

TEST_F(ObjectsTest, ANewInstanceHasSeenNone) {
  list.add(marks(5).view());
  kept();
  EXPECT_EQ(kept(), 5u);
  chain.start(*device);
  EXPECT_EQ(kept(), 0u);
  EXPECT_EQ(kept(), 5u);
  chain.stop();
  EXPECT_EQ(kept(), 0u);  // the first frame creates it again
}

// Whatever changes the list, the objects reported as kept are those of the frame before.
TEST_F(ObjectsTest, WhatIsSaidToBeKeptIsThere) {
  std::mt19937_64 random(1);
  std::vector<objects::Object> before;
  for (int step = 0; step < 400; ++step) {
    for (uint64_t changes = random() % 3; changes > 0; --changes) {
      const size_t size = list.size();
      switch (random() % 8) {
        case 0:
          list.replace(marks(random() % 6).view());
          break;
        case 1:
        case 2:
          list.undo();
          break;
        case 3:
          list.redo();
          break;
        case 4:
          if (size > 0) list.remove(random() % size);
          break;
        case 5:
          list.assign({&table, list.view().data, size - size / 3});
          break;
        default:
          list.add(marks(1 + random() % 3).view());
      }
    }
    const bool fails = random() % 5 == 0;
    chain.selection.set(Assignment{{"teller", "fails"}, fails ? "true" : "false"});
    if (fails) {
      EXPECT_ERROR(ErrorId::kEffectRecord, told());
      continue;
    }
    const size_t same = kept();
    ASSERT_LE(same, before.size());
    for (size_t i = 0; i < same; ++i) ASSERT_EQ(list.object(i), before[i]) << step << " at " << i;
    before.clear();
    for (size_t i = 0; i < list.size(); ++i) before.push_back(list.object(i));
  }
}

TEST_F(ObjectsTest, EffectsWithoutATableSeeNone) {
  const std::vector<gpu::Texture> plain = {makeTexture("plain", gpu::Format::kR32Float)};
  chain.selection = Selection(registry, Keys{"plain"});
  EXPECT_EQ(chain.objects("plain"), nullptr);
  EXPECT_EQ(record(chain, "plain", plain).waiting, 0u);
}

// Points tell of the list as frames do, and count as one: what they have seen is kept.
TEST_F(ObjectsTest, PointsSeeTheListToo) {
  const std::vector<grisaille_point> points(3, {{1, 2, 3}, {0, 1, 0}, 0});
  std::vector<grisaille_drawn> drawn(3);
  const auto draw = [&] {
    chain.drawAt(chain.selection.entries()[0], {.points = points, .drawn = drawn});
    return std::pair(std::lround(100 * drawn[2].colour[0]), std::lround(100 * drawn[2].colour[1]));
  };
  list.add(marks(5).view());
  EXPECT_EQ(draw(), std::pair(5l, 0l));
  EXPECT_EQ(drawn[0].owner, 5u);
  EXPECT_EQ(kept(), 5u);
  list.add(marks(2).view());
  EXPECT_EQ(draw(), std::pair(7l, 5l));
  list.undo();
  list.undo();
  EXPECT_EQ(draw(), std::pair(0l, 0l));
}

TEST_F(ObjectsTest, PointsAreDrawnWithRaysAndWithinTheirRange) {
  struct Rays : RayService {
    void cast(std::span<const grisaille_ray> rays, std::span<grisaille_hit>) override {
      count += rays.size();
    }
    size_t count = 0;
  } rays;
  const std::vector<grisaille_point> points(2, {{1, 2, 3}, {0, 1, 0}, 0});
  std::vector<grisaille_drawn> drawn(2);
  Values& values = chain.selection.values("teller");
  const auto draw = [&](RayService* service) {
    chain.drawAt(chain.selection.entries()[0], {.points = points, .drawn = drawn, .rays = service});
  };
  values.set("casts", "two");
  draw(nullptr);
  EXPECT_EQ(drawn[0].colour[2], 0);
  draw(&rays);
  EXPECT_EQ(drawn[0].colour[2], 1);
  EXPECT_EQ(rays.count, 2u);
  values.set("casts", "none");
  for (const char* wrong : {"alpha", "owner", "colour"}) {
    values.set("draws", wrong);
    EXPECT_ERROR(ErrorId::kEffectRecord, draw(nullptr));
  }
  values.set("draws", "well");
  values.set("fails", "true");
  EXPECT_ERROR(ErrorId::kEffectRecord, draw(nullptr));
  values.set("fails", "false");
  draw(nullptr);
  EXPECT_EQ(drawn[1].alpha, 1);
}

TEST_F(InstanceTest, WhatHasNoDrawAtDrawsNoPoints) {
  Chain plain{Selection(registry, std::vector<std::string>{"copy"})};
  const StartedChain started(plain, *device);
  EXPECT_ERROR(ErrorId::kEffectDrawsNoPoints,
               plain.drawAt(plain.selection.entries()[0], {.points = {}, .drawn = {}}));
}

}  // namespace
}  // namespace grisaille::effect
