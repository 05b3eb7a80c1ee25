// SPDX-License-Identifier: MIT
#include "core/effect/registry.h"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>

#include "tests/support/expect_error.h"

namespace grisaille::effect {
namespace {

namespace fs = std::filesystem;

const fs::path kPlugins = PLUGIN_DIR;

struct RegistryTest : testing::Test {
  fs::path folder = fs::temp_directory_path() / fmt::format("grisaille_registry_{}", getpid());

  void SetUp() override { fs::create_directory(folder); }
  void TearDown() override { fs::remove_all(folder); }

  std::string file(const std::string& name, const std::string& content) {
    std::ofstream(folder / name, std::ios::binary) << content;
    return folder / name;
  }
};

std::string contentOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> keysOf(const Registry& registry) {
  std::vector<std::string> keys;
  for (const Effect& effect : registry.effects()) keys.emplace_back(effect.desc->key);
  return keys;
}

bool isLoaded(const fs::path& path) {
  void* library = dlopen(path.c_str(), RTLD_LAZY | RTLD_NOLOAD);
  if (library != nullptr) dlclose(library);
  return library != nullptr;
}

TEST_F(RegistryTest, FindsSoundPluginsByKey) {
  Registry registry;
  registry.scan(kPlugins / "sound");
  EXPECT_EQ(keysOf(registry), (std::vector<std::string>{"copy", "plain"}));
  EXPECT_TRUE(registry.refused().empty());

  const Effect& copy = registry.find("copy");
  EXPECT_STREQ(copy.desc->version, "1.2.3");
  EXPECT_EQ(fs::path(copy.path).filename(), "copy.so");
  ASSERT_EQ(copy.params().size(), 4u);
  EXPECT_STREQ(copy.params()[1].key, "entry");
  ASSERT_EQ(copy.outputs().size(), 2u);
  EXPECT_EQ(copy.reads(std::array{1.0, 0.0, 0.0, 0.0}.data(), 1),
            GRISAILLE_READS(GRISAILLE_VIEW_DEPTH));
  EXPECT_EQ(copy.reads(std::array{1.0, 0.0, 1.0, 0.0}.data(), 1), 0u);
}

TEST_F(RegistryTest, FaultyOnesAreRefusedByReasonAndTheRestGoesOn) {
  const std::map<std::string, ErrorId> expected = {
      {"symbol", ErrorId::kPluginSymbol},     {"magic", ErrorId::kPluginAbi},
      {"major", ErrorId::kPluginAbi},         {"old_major", ErrorId::kPluginAbi},
      {"minor", ErrorId::kPluginAbi},         {"size", ErrorId::kPluginTable},
      {"effect_size", ErrorId::kPluginTable}, {"range", ErrorId::kPluginTable},
      {"tooltip", ErrorId::kPluginTable},     {"null_key", ErrorId::kPluginTable},
      {"no_record", ErrorId::kPluginTable},   {"directory", ErrorId::kPluginUnloadable},
      {"text", ErrorId::kPluginUnloadable},
  };
  for (const auto& entry : fs::directory_iterator(kPlugins / "faulty")) {
    fs::create_symlink(entry.path(), folder / entry.path().filename());
  }
  fs::create_symlink(kPlugins / "sound" / "plain.so", folder / "plain.so");
  fs::create_directory(folder / "directory.so");
  file("text.so", "not a library\n");
  file("readme.txt", "passed over");

  Registry registry;
  registry.scan(folder);
  EXPECT_EQ(keysOf(registry), std::vector<std::string>{"plain"});
  ASSERT_EQ(registry.refused().size(), expected.size());
  EXPECT_TRUE(std::ranges::is_sorted(registry.refused(), {}, &Refused::path));
  for (const Refused& refused : registry.refused()) {
    const std::string name = fs::path(refused.path).stem();
    ASSERT_TRUE(expected.contains(name)) << name;
    EXPECT_EQ(refused.reason.id(), expected.at(name)) << refused.reason.what();
    EXPECT_NE(refused.reason.detail().find(refused.path), std::string::npos);
    EXPECT_ERROR(expected.at(name), Registry().load(refused.path));
  }
  registry.scan(folder);  // scanning again adds nothing
  EXPECT_EQ(registry.refused().size(), expected.size());
}

TEST_F(RegistryTest, VersionsAndFieldsAreNamed) {
  const auto words = [](const char* name) {
    try {
      Registry().load(kPlugins / "faulty" / name);
    } catch (const Error& error) {
      return error.detail();
    }
    return std::string();
  };
  const uint32_t major = GRISAILLE_ABI_MAJOR, minor = GRISAILLE_ABI_MINOR;
  const auto names = [&](const char* plugin, uint32_t itsMajor, uint32_t itsMinor) {
    return words(plugin).find(fmt::format("version {}.{}, but this program has {}.{}", itsMajor,
                                          itsMinor, major, minor)) != std::string::npos;
  };
  EXPECT_TRUE(names("major.so", major + 1, minor));
  EXPECT_TRUE(names("old_major.so", major - 1, minor));
  EXPECT_TRUE(names("minor.so", major, minor + 1));
  EXPECT_NE(words("range.so").find("effects[0].params[0].hard_max is 0.5, under soft_max 1"),
            std::string::npos);
  EXPECT_NE(words("tooltip.so").find("effects[0].outputs[0].tooltip"), std::string::npos);
}

TEST_F(RegistryTest, MarkedEffectsOfTheProgramItselfAreTheDefaults) {
  Registry own, foreign;
  own.scan(kPlugins / "marked");
  own.scan(kPlugins / "sound");
  EXPECT_EQ(own.defaults(), std::vector<std::string>{"marked"});
  foreign.scan(kPlugins / "sound");
  EXPECT_TRUE(foreign.defaults().empty());
  foreign.scan(kPlugins / "marked", Origin::kForeign);
  EXPECT_EQ(keysOf(foreign), (std::vector<std::string>{"copy", "marked", "plain"}));
  EXPECT_TRUE(foreign.defaults().empty());
}

TEST_F(RegistryTest, TablesOfObjectsAreFound) {
  Registry registry;
  registry.scan(kPlugins / "sound");
  registry.scan(kPlugins / "objects");
  EXPECT_EQ(registry.find("copy").objects(), nullptr);
  const grisaille_object_desc* objects = registry.find("teller").objects();
  ASSERT_NE(objects, nullptr);
  EXPECT_STREQ(objects->key, "marks");
  EXPECT_EQ(objects->field_count, 6u);
}

TEST_F(RegistryTest, WhatIsNoLibraryIsUnloadable) {
  for (const std::string& content : {std::string(), std::string("x"), std::string("#!/bin/sh\n"),
                                     std::string("\x7f"
                                                 "ELF"),
                                     std::string(5000, '\0'),
                                     "\x7f"
                                     "ELF" +
                                         std::string(5000, '\xff')}) {
    EXPECT_ERROR(ErrorId::kPluginUnloadable, Registry().load(file("x.so", content)));
  }
  EXPECT_ERROR(ErrorId::kPluginUnloadable, Registry().load(folder / "missing.so"));
  EXPECT_ERROR(ErrorId::kPluginUnloadable, Registry().load(""));
  EXPECT_ERROR(ErrorId::kPluginUnloadable, Registry().load("/dev/null"));
  EXPECT_ERROR(ErrorId::kPluginUnloadable, Registry().load(folder));
  ASSERT_EQ(mkfifo((folder / "pipe.so").c_str(), 0600), 0);
  EXPECT_ERROR(ErrorId::kPluginUnloadable, Registry().load(folder / "pipe.so"));
  fs::create_symlink(folder / "nowhere.so", folder / "dangling.so");
  EXPECT_ERROR(ErrorId::kPluginUnloadable, Registry().load(folder / "dangling.so"));
}

// A truncated library is refused, unless only bytes are missing that the loader does not map.
TEST_F(RegistryTest, CutLibrariesNeverCrash) {
  const std::string whole = contentOf(kPlugins / "sound" / "plain.so");
  ASSERT_GT(whole.size(), 4096u);
  size_t refused = 0;
  for (size_t length = 0; length < whole.size(); length += whole.size() / 61) {
    const std::string path = file(fmt::format("cut_{}.so", length), whole.substr(0, length));
    try {
      Registry().load(path);
    } catch (const Error& error) {
      EXPECT_EQ(error.id(), ErrorId::kPluginUnloadable) << length << ": " << error.what();
      ++refused;
    }
  }
  EXPECT_GT(refused, 10u);
}

TEST_F(RegistryTest, TheSameFileByAnotherPathIsPassedOver) {
  fs::create_symlink(kPlugins / "sound" / "copy.so", folder / "copy.so");
  fs::create_symlink(kPlugins / "sound" / "copy.so", folder / "other.so");
  Registry registry;
  registry.scan(kPlugins / "sound");
  registry.scan(folder);
  registry.load(kPlugins / "sound" / ".." / "sound" / "copy.so");
  EXPECT_EQ(registry.effects().size(), 2u);
  EXPECT_TRUE(registry.refused().empty());
}

TEST_F(RegistryTest, AnotherFileWithTheSameKeyIsADuplicate) {
  Registry registry;
  registry.scan(kPlugins / "sound");
  const std::string twin = kPlugins / "twin" / "twin.so";
  EXPECT_ERROR(ErrorId::kPluginDuplicate, registry.load(twin));
  registry.scan(kPlugins / "twin");
  ASSERT_EQ(registry.refused().size(), 1u);
  const std::string& words = registry.refused()[0].reason.detail();
  EXPECT_NE(words.find(twin), std::string::npos) << words;
  EXPECT_NE(words.find(registry.find("copy").path), std::string::npos) << words;
  EXPECT_STREQ(registry.find("copy").desc->version, "1.2.3");
}

TEST_F(RegistryTest, UnknownEffectsNameTheNearestOrTheRefusal) {
  fs::create_symlink(kPlugins / "faulty" / "range.so", folder / "range.so");
  Registry registry;
  EXPECT_ERROR(ErrorId::kEffectUnknown, registry.find("copy"));
  registry.scan(kPlugins / "sound");
  registry.scan(folder);
  const auto words = [&](const char* key) {
    try {
      registry.find(key);
    } catch (const Error& error) {
      EXPECT_EQ(error.id(), ErrorId::kEffectUnknown);
      return error.detail();
    }
    return std::string();
  };
  EXPECT_NE(words("cpoy").find("nearest is copy"), std::string::npos);
  EXPECT_EQ(words("something").find("nearest"), std::string::npos);
  EXPECT_NE(words("range").find("hard_max"), std::string::npos);
}

TEST_F(RegistryTest, FoldersThatCannotBeReadAreErrors) {
  Registry registry;
  EXPECT_ERROR(ErrorId::kPluginPath, registry.scan(folder / "missing"));
  EXPECT_ERROR(ErrorId::kPluginPath, registry.scan(file("file", "")));
  EXPECT_ERROR(ErrorId::kPluginPath, registry.scan(""));
  registry.scan(folder);
  EXPECT_TRUE(registry.effects().empty());
}

// Resources of the process: bytes of its heap, mapped ranges, open files.
struct Holdings {
  size_t heap = mallinfo2().uordblks;
  size_t maps = static_cast<size_t>(std::ranges::count(contentOf("/proc/self/maps"), '\n'));
  size_t files = static_cast<size_t>(
      std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator()));
};

TEST_F(RegistryTest, LoadingAndUnloadingAThousandTimesLeaksNothing) {
  const auto load = [&] {
    Registry registry;
    registry.scan(kPlugins / "sound");
    registry.scan(kPlugins / "faulty");
    ASSERT_EQ(registry.effects().size(), 2u);
    ASSERT_TRUE(isLoaded(kPlugins / "sound" / "copy.so"));
  };
  // The loader grows tables that it never shrinks, at loads that depend on the length of the
  // plugins' paths. A leak grows in each of the rounds: by 16 bytes or more in each load, malloc's
  // smallest step.
  constexpr size_t kLoads = 250;
  for (size_t i = 0; i < kLoads; ++i) load();
  const Holdings before;
  size_t least = std::numeric_limits<size_t>::max();
  for (int round = 0; round < 4; ++round) {
    const size_t heap = Holdings().heap;
    for (size_t i = 0; i < kLoads; ++i) load();
    const size_t now = Holdings().heap;
    least = std::min(least, now - std::min(now, heap));
  }
  const Holdings after;
  EXPECT_LT(least, 16 * kLoads);
#ifndef __SANITIZE_ADDRESS__  // ASan maps memory of its own
  EXPECT_EQ(after.maps, before.maps);
#endif
  EXPECT_EQ(after.files, before.files);
  for (const char* name : {"sound/copy.so", "sound/plain.so"}) {
    EXPECT_FALSE(isLoaded(kPlugins / name)) << name;
  }
  // A refused plugin stays loaded, once: its threads may still run.
  EXPECT_TRUE(isLoaded(kPlugins / "faulty/range.so"));
}

}  // namespace
}  // namespace grisaille::effect
