// SPDX-License-Identifier: MIT
// Chains of effects: selection, objects and instances.
#include "core/effect/chain.h"

#include <unistd.h>

#include <filesystem>

#include "tests/core/effect/instance_fixture.h"
#include "tests/core/effect/plugins/mark.h"
#include "tests/support/expect_error.h"
#include "tests/support/selections.h"

namespace grisaille::effect {
namespace {

namespace fs = std::filesystem;
using Keys = std::vector<std::string>;
using Lines = std::vector<std::string>;

struct ChainTest : InstanceTest {
  const std::vector<gpu::Texture> outputs = {makeTexture("told", gpu::Format::kR32Float)};

  objects::Object mark(double x) const {
    const objects::Table& table = *registry.find("teller").objects();
    objects::Object made(table);
    made.at(table, "position").numbers = {x, 0, 0};
    made.at(table, "note").text = fmt::format("number {}", x);
    return made;
  }
  // Index of the instance's frame, counted from 0.
  float frameOf(Chain& chain) {
    record(chain, "teller", outputs);
    return texelsOf(outputs[0])[11];
  }
};

TEST_F(ChainTest, ObjectsAreThereWhetherTheEffectIsOnOrOff) {
  Chain chain{Selection(registry)};
  objects::ObjectList* list = chain.objects("teller");
  ASSERT_NE(list, nullptr);
  list->add(mark(1));
  chain.selection.find("teller")->on = true;
  EXPECT_EQ(chain.objects("teller"), list);
  chain.selection.move(0, 2);
  EXPECT_EQ(chain.objects("teller"), list);
  EXPECT_EQ(list->size(), 1u);
  EXPECT_EQ(chain.objects("plain"), nullptr);  // its table declares no objects
  EXPECT_EQ(chain.objects("nothing"), nullptr);
  EXPECT_EQ(chain.objectLists().size(), 1u);
}

TEST_F(ChainTest, AnExchangedSelectionFindsObjectsAndInstancesAgain) {
  Chain chain{Selection(registry, Keys{"teller"})};
  chain.objects("teller")->add(mark(1));
  const StartedChain started(chain, *device);
  EXPECT_EQ(frameOf(chain), 0);
  chain.selection = Selection(registry, Keys{"plain"});
  EXPECT_EQ(chain.objects("teller"), nullptr);
  chain.selection = Selection(registry, Keys{"plain", "teller"});
  ASSERT_NE(chain.objects("teller"), nullptr);
  EXPECT_EQ(chain.objects("teller")->size(), 1u);
  EXPECT_EQ(frameOf(chain), 1);
  EXPECT_EQ(texelsOf(outputs[0])[1], 1);
}

TEST_F(ChainTest, EveryChangeOfAListChangesTheRevision) {
  Chain chain{Selection(registry)};
  EXPECT_EQ(chain.objectsRevision(), 0u);
  objects::ObjectList& list = *chain.objects("teller");
  uint64_t before = chain.objectsRevision();
  EXPECT_EQ(before, 0u);
  const auto grown = [&] { return std::exchange(before, chain.objectsRevision()) < before; };
  list.add(mark(1));
  EXPECT_TRUE(grown());
  list.undo();
  EXPECT_TRUE(grown());
  list.redo();
  EXPECT_TRUE(grown());
  chain.selection.find("teller")->on = true;
  EXPECT_FALSE(grown());
}

// --- With a device

TEST_F(ChainTest, TheEffectsThatAreOnAreCreatedOnce) {
  Chain chain{Selection(registry)};
  const StartedChain started(chain, *device);
  chain.selection.find("throws_in_create")->on = true;
  EXPECT_ERROR(ErrorId::kEffectCreate, chain.create());
  chain.selection.find("throws_in_create")->on = false;
  chain.selection.find("teller")->on = true;
  chain.create();
  chain.create();
  EXPECT_EQ(frameOf(chain), 0);
  EXPECT_EQ(frameOf(chain), 1);
  chain.start(*device);
  EXPECT_EQ(frameOf(chain), 0);
}

TEST_F(ChainTest, EffectsTurnedOnLaterAreCreatedThen) {
  Chain chain{Selection(registry)};
  const StartedChain started(chain, *device);
  chain.selection.find("teller")->on = true;
  EXPECT_EQ(frameOf(chain), 0);
  chain.selection.find("throws_in_create")->on = true;
  EXPECT_ERROR(ErrorId::kEffectCreate, chain.create());
  EXPECT_ERROR(ErrorId::kEffectCreate, chain.create());
  chain.selection.find("throws_in_create")->on = false;
  EXPECT_EQ(frameOf(chain), 1);
}

// The checking device reports leaked resources when it is destroyed.
TEST_F(ChainTest, StoppingEndsAllInstances) {
  Chain chain{Selection(registry, Keys{"plain", "copy", "teller"})};
  {
    const StartedChain started(chain, *device);
    chain.create();
  }
  chain.start(*device);
  chain.create();
  chain.end();
  chain.stop();
}

TEST_F(ChainTest, ValuesAndWhatWaitsCrossTheChain) {
  Chain chain{Selection(registry, Keys{"teller"})};
  const StartedChain started(chain, *device);
  EXPECT_EQ(record(chain, "teller", outputs).waiting, 0u);
  chain.selection.set(Assignment{{"teller", "waits"}, "12"});
  EXPECT_EQ(record(chain, "teller", outputs).waiting, 12u);
}

// --- Reloaded plugins

// A copy of a plugin; the loader treats it as a different library.
struct Copied {
  Copied(const char* from, const char* name) {
    fs::create_directory(folder);
    fs::copy_file(fs::path(PLUGIN_DIR) / from, folder / name, fs::copy_options::overwrite_existing);
    registry.scan(folder);
    registry.scan(PLUGIN_DIR "/sound");
  }
  ~Copied() { fs::remove_all(folder); }

  fs::path folder = fs::temp_directory_path() / fmt::format("grisaille_chain_{}", getpid());
  Registry registry;
};

TEST_F(ChainTest, TheSameTableKeepsObjectsAndSteps) {
  Chain chain{Selection(registry, Keys{"copy", "teller"})};
  chain.selection.set(Assignment{{"copy", "entry"}, "7"});
  objects::ObjectList& list = *chain.objects("teller");
  list.add(mark(1));
  list.add(mark(2));
  list.undo();
  Copied fresh("objects/teller.so", "again.so");
  {
    const StartedChain started(chain, *device);
    EXPECT_EQ(frameOf(chain), 0);
    EXPECT_EQ(chain.rebind(fresh.registry), Lines());
    EXPECT_EQ(frameOf(chain), 0);  // a new instance, from the reloaded plugin
    EXPECT_EQ(texelsOf(outputs[0])[0], 1);
    EXPECT_EQ(texelsOf(outputs[0])[1], 0);
  }
  const auto on = chain.selection.effects();
  ASSERT_EQ(on.size(), 2u);
  EXPECT_EQ(on[0]->key(), "copy");
  EXPECT_EQ(on[1]->key(), "teller");
  EXPECT_EQ(chain.selection.values("copy").get("entry"), 7);
  objects::ObjectList& kept = *chain.objects("teller");
  EXPECT_EQ(&kept.table(), fresh.registry.find("teller").objects());
  EXPECT_NE(&kept.table(), registry.find("teller").objects());
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_EQ(kept.object(0), mark(1));
  kept.redo();
  ASSERT_EQ(kept.size(), 2u);
  EXPECT_EQ(kept.object(1), mark(2));
}

TEST_F(ChainTest, AnotherTableKeepsTheFieldsAndObjectsThatFit) {
  Chain chain{Selection(registry, Keys{"teller"})};
  objects::ObjectList& list = *chain.objects("teller");
  objects::Object large = mark(2);
  large.at(list.table(), "size").numbers[0] = 50;  // above the later version's limit
  for (const objects::Object& one : {mark(1), large, mark(3)}) list.add(one);
  const uint64_t revision = chain.objectsRevision();
  Copied fresh("objects_later/teller_later.so", "later.so");
  const Lines dropped = chain.rebind(fresh.registry);
  ASSERT_EQ(dropped.size(), 3u);
  EXPECT_NE(dropped[0].find("marks.colour"), std::string::npos) << dropped[0];
  EXPECT_NE(dropped[1].find("marks.note"), std::string::npos) << dropped[1];
  EXPECT_NE(dropped[2].find("marks[1].size"), std::string::npos) << dropped[2];
  EXPECT_GT(chain.objectsRevision(), revision);

  objects::ObjectList& kept = *chain.objects("teller");
  const objects::Table& table = kept.table();
  ASSERT_EQ(kept.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    objects::Object expected(table);  // `colour` and `weight` have their defaults
    expected.at(table, "position").numbers = {static_cast<double>(2 * i + 1), 0, 0};
    EXPECT_EQ(kept.object(i), expected) << i;
  }
  EXPECT_FALSE(kept.canUndo());
}

TEST_F(ChainTest, WhatThereIsNoMoreIsNamed) {
  Chain chain{Selection(registry, Keys{"teller", "plain"})};
  chain.objects("teller")->add(mark(1));
  const uint64_t revision = chain.objectsRevision();
  Registry fresh;
  fresh.scan(PLUGIN_DIR "/sound");
  const Lines dropped = chain.rebind(fresh);
  ASSERT_EQ(dropped.size(), 2u);
  EXPECT_NE(dropped[0].find("effect teller"), std::string::npos) << dropped[0];
  EXPECT_NE(dropped[1].find("marks of teller"), std::string::npos) << dropped[1];
  EXPECT_EQ(chain.objects("teller"), nullptr);
  EXPECT_TRUE(chain.objectLists().empty());
  EXPECT_GT(chain.objectsRevision(), revision);
  ASSERT_EQ(chain.selection.effects().size(), 1u);
}

// A plugin that is broken for a while, twice over.
TEST_F(ChainTest, WhatWasAbsentComesBackAsItWas) {
  Chain chain{Selection(registry)};
  std::ranges::reverse(chain.selection.entries());
  for (const char* key : {"copy", "teller"}) chain.selection.find(key)->on = true;
  chain.selection.set(Assignment{{"copy", "entry"}, "7"});
  chain.objects("teller")->add(mark(1));
  chain.objects("teller")->add(mark(2));
  chain.objects("teller")->undo();
  const Selection::State before = chain.state();
  EXPECT_EQ(before, chain.selection.state());
  uint64_t revision = chain.objectsRevision();
  for (int round = 0; round < 2; ++round) {
    Registry without;
    without.scan(PLUGIN_DIR "/sound");
    EXPECT_EQ(chain.rebind(without).back(), "marks of teller");
    EXPECT_EQ(chain.rebind(without), Lines());  // told once
    EXPECT_EQ(chain.objects("teller"), nullptr);
    EXPECT_TRUE(chain.objectLists().empty());
    EXPECT_EQ(chain.state(), before);
    EXPECT_EQ(chain.restore(before), Lines());
    EXPECT_EQ(chain.state(), before);
    // The steps of an absent list.
    ASSERT_NE(chain.objectsEvenIfAbsent("teller"), nullptr);
    chain.objectsEvenIfAbsent("teller")->redo();
    EXPECT_EQ(chain.objectsEvenIfAbsent("teller")->size(), 2u);
    chain.objectsEvenIfAbsent("teller")->undo();
    EXPECT_EQ(chain.rebind(registry), Lines());
    EXPECT_EQ(chain.state(), before);
    EXPECT_EQ(chain.selection.state(), before);
    ASSERT_NE(chain.objects("teller"), nullptr);
    EXPECT_EQ(chain.objectsEvenIfAbsent("teller"), chain.objects("teller"));
    EXPECT_EQ(&chain.objects("teller")->table(), registry.find("teller").objects());
    ASSERT_EQ(chain.objects("teller")->size(), 1u);
    EXPECT_EQ(chain.objects("teller")->object(0), mark(1));
    chain.objects("teller")->redo();
    EXPECT_EQ(chain.objects("teller")->size(), 2u);
    chain.objects("teller")->undo();
    EXPECT_GT(chain.objectsRevision(), revision);
    revision = chain.objectsRevision();
  }
}

TEST_F(ChainTest, AnEmptyListGoesWithoutAWord) {
  Chain chain{Selection(registry)};
  chain.objects("teller");
  Registry fresh;
  fresh.scan(PLUGIN_DIR "/sound");
  for (const std::string& line : chain.rebind(fresh)) {
    EXPECT_EQ(line.find("marks"), std::string::npos) << line;
  }
}

// Parameters and values of random selections.
TEST(Rebinding, ALaterVersionOfAPluginKeepsWhatStillFits) {
  const tests::Tables now, later("later");
  std::mt19937_64 random(2);
  for (int i = 0; i < 300; ++i) {
    Chain chain{Selection(now.registry)};
    tests::randomise(random, chain.selection);
    const Selection old = chain.selection;
    const Lines dropped = chain.rebind(later.registry);
    ASSERT_EQ(chain.selection.entries().size(), 2u);
    size_t expected = 1;  // 1 for the missing gamma
    size_t place = 0;
    for (const Selection::Entry& entry : old.entries()) {
      if (std::string_view(entry.key()) == "gamma") continue;
      const Selection::Entry& kept = chain.selection.entries()[place++];
      EXPECT_STREQ(kept.key(), entry.key());
      EXPECT_EQ(kept.on, entry.on);
      EXPECT_EQ(kept.values.get("count"), entry.values.get("count"));
      const bool inside = std::abs(entry.values.get("amount")) <= 10;
      EXPECT_EQ(kept.values.get("amount"), inside ? entry.values.get("amount") : 0.5);
      const std::string kind = entry.values.text("kind");
      const bool there = kind == "first" || kind == "1e5";
      EXPECT_EQ(kept.values.text("kind"), there ? kind : "1e5");
      expected += 1u + (inside ? 0u : 1u) + (there ? 0u : 1u);  // 1 for the missing `hard`
    }
    EXPECT_EQ(dropped.size(), expected);
    EXPECT_EQ(chain.rebind(now.registry).size(), 2u);  // `soft` in two effects
  }
}

TEST_F(ChainTest, TheGuardBandIsAShareOfTheHeight) {
  grisaille_effect_desc desc = *registry.find("plain").desc;
  EXPECT_EQ(guardBand(Values(Effect{&desc, "memory"}), 100), 0u);
  desc.guard_band = [](const double*) { return 0.101; };
  EXPECT_EQ(guardBand(Values(Effect{&desc, "memory"}), 100), 11u);
  desc.guard_band = [](const double*) { return 1.5; };
  EXPECT_EQ(guardBand(Values(Effect{&desc, "memory"}), 100), 0u);
}

}  // namespace
}  // namespace grisaille::effect
