// SPDX-License-Identifier: MIT
#include "app/settings/settings.h"
#include "app/settings/background.h"
#include "app/settings/chosen_effects.h"

#include <algorithm>
#include <tuple>

#include "tests/support/expect_error.h"
#include "tests/support/folder_test.h"
#include "tests/support/selections.h"

namespace grisaille::app {
namespace {

using tests::Tables;

class SettingsFile : public tests::FolderTest {
 protected:
  Settings back(const Settings& settings) const {
    writeSettings(settings, file("a.toml"));
    return readSettings(file("a.toml"));
  }
};

// TOML tables are unordered.
std::vector<std::tuple<std::string, std::string, std::string>> sorted(const Settings& settings) {
  std::vector<std::tuple<std::string, std::string, std::string>> all;
  for (const Settings::Value& v : settings.values)
    all.emplace_back(v.name.effect, v.name.key, v.text);
  std::ranges::sort(all);
  return all;
}

TEST_F(SettingsFile, BringsBackEveryBitOfEveryValue) {
  const Tables tables;
  std::mt19937_64 random(5);
  for (int i = 0; i < 500; ++i) {
    effect::Selection list(tables.registry);
    tests::randomise(random, list);
    const Settings settings = settingsOf(list);
    const Settings read = back(settings);
    EXPECT_EQ(read.effects, settings.effects);
    ASSERT_EQ(sorted(read), sorted(settings)) << contentOf(file("a.toml"));
    const effect::Selection fresh = chosenEffects(tables.registry, *read.effects, {}, read);
    for (const effect::Selection::Entry& entry : list.entries()) {
      if (entry.on) {
        ASSERT_TRUE(tests::same(*fresh.find(entry.key()), entry));
      }
    }
  }
}

TEST_F(SettingsFile, BringsBackAnyTextAndName) {
  const std::string texts[] = {"",
                               " ",
                               "0",
                               "-0",
                               "0.0",
                               "007",
                               "1e5",
                               "1e+05",
                               "1e+5",
                               "+1",
                               ".5",
                               "5.",
                               "0x10",
                               "inf",
                               "-inf",
                               "nan",
                               "true",
                               "True",
                               "\"",
                               "'",
                               "\\",
                               "\n",
                               "a\tb",
                               "'''",
                               "#",
                               "\x7f",
                               "\x01",
                               "1_000",
                               "1e999",
                               "ä€𝄞",
                               "\"\"\"",
                               "9223372036854775807",
                               "9223372036854775808",
                               "-9223372036854775808",
                               "100000000000000000000",
                               "1979-05-27"};
  Settings settings;
  settings.effects.emplace();
  size_t count = 0;
  for (const std::string& text : texts) {
    settings.effects->push_back(text);
    settings.values.push_back({.name = {.effect = "ssao", .key = "k" + std::to_string(count++)},
                               .text = text,
                               .place = {}});
    settings.values.push_back(
        {.name = {.effect = text + "x", .key = text}, .text = text, .place = {}});
  }
  const Settings read = back(settings);
  EXPECT_EQ(read.effects, settings.effects);
  EXPECT_EQ(sorted(read), sorted(settings));
}

TEST_F(SettingsFile, WhatIsNotGivenIsNotThere) {
  EXPECT_EQ(settingsToml({}), "");
  EXPECT_FALSE(back({}).effects);
  EXPECT_FALSE(back({}).surface);
  EXPECT_FALSE(back({}).background);
  const Settings none{.effects = std::vector<std::string>(), .surface = "base", .values = {}};
  EXPECT_EQ(back(none).effects, none.effects);
  EXPECT_EQ(back(none).surface, "base");
}

TEST_F(SettingsFile, ReadsAsAPersonWouldWriteIt) {
  const Settings settings{
      .effects = {{"ssao", "sspm"}},
      .surface = "white",
      .background = "#a0a0ff",
      .values = {{.name = {.effect = "ssao", .key = "radius"}, .text = "0.5", .place = {}},
                 {.name = {.effect = "sspm", .key = "mode"}, .text = "surface", .place = {}},
                 {.name = {.effect = "ssao", .key = "blur"}, .text = "box", .place = {}},
                 {.name = {.effect = "ssao", .key = "radius"}, .text = "2", .place = {}},
                 {.name = {.effect = "ssao", .key = "noise"}, .text = "true", .place = {}}}};
  EXPECT_EQ(settingsToml(settings),
            "effects = [\"ssao\", \"sspm\"]\n"
            "surface = \"white\"\n"
            "background = \"#a0a0ff\"\n"
            "\n"
            "[ssao]\n"
            "radius = 2\n"
            "blur = \"box\"\n"
            "noise = true\n"
            "\n"
            "[sspm]\n"
            "mode = \"surface\"\n");
}

TEST_F(SettingsFile, TheBackgroundIsAColourOrTransparent) {
  for (const char* text : {"#000000", "#ffffff", "#12ab9f", "transparent"}) {
    Settings settings;
    settings.background = text;
    EXPECT_EQ(back(settings).background, text);
    ASSERT_TRUE(backgroundOf(text));
    EXPECT_EQ(textOf(*backgroundOf(text)), text);
  }
  EXPECT_EQ(textOf(frame::kGrey), "#808080");
  EXPECT_EQ(backgroundOf("transparent"), frame::kTransparent);
}

TEST_F(SettingsFile, RefusesWhatItCannotHold) {
  for (const char* key : {"effects", "surface", "background"}) {
    const Settings settings{
        .effects = {},
        .surface = {},
        .values = {{.name = {.effect = key, .key = "k"}, .text = "1", .place = {}}}};
    EXPECT_ERROR(ErrorId::kSettingsInvalid, settingsToml(settings));
  }
  EXPECT_ERROR(ErrorId::kFileUnwritable, writeSettings({}, file("missing/a.toml")));
  for (const char* text : {"surface = \"black\"", "surface = 1", "[surface]\na = 1",
                           "background = \"grey\"", "background = \"#12345\"", "background = 0"}) {
    EXPECT_ERROR(ErrorId::kSettingsInvalid, readSettings(fileOf("bad.toml", text)));
  }
}

TEST_F(SettingsFile, WhatNeverEndsOrNestsDeepIsRefused) {
  EXPECT_ERROR(ErrorId::kSettingsUnreadable, readSettings("/dev/zero"));
  EXPECT_ERROR(ErrorId::kSettingsUnreadable, readSettings(file("")));
  const auto dotted = [](size_t parts) {
    std::string key = "a";
    for (size_t i = 1; i < parts; ++i) key += i % 2 == 0 ? " . 'a.b'" : ".a";
    return key;
  };
  for (const std::string& text :
       {dotted(100000) + " = 1", "[" + dotted(100000) + "]", "x = [1.5, {" + dotted(17) + " = 1}]",
        "x = {a = \"\"\"\"\"\"\"\", " + dotted(17) + " = 1}"}) {
    EXPECT_ERROR(ErrorId::kSettingsUnreadable, readSettings(fileOf("deep.toml", text)));
  }
}

TEST_F(SettingsFile, DotsOfNumbersTextsAndCommentsAreNoPartsOfKeys) {
  std::string text = "# " + std::string(100, '.') + "\n[a]\nx = [";
  for (int i = 0; i < 100; ++i) text += "1.5, ";
  EXPECT_ERROR(ErrorId::kSettingsInvalid, readSettings(fileOf("x.toml", text + "]")));
  const std::string dots(100, '.');
  text = "# it's\n[a]\nb = \"\\\"" + dots + "\"\nc = '''\n'" + dots + "''' # \"\nd = '\\'\n";
  EXPECT_EQ(readSettings(fileOf("x.toml", text)).values.size(), 3u);
}

}  // namespace
}  // namespace grisaille::app
