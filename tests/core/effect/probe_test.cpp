// SPDX-License-Identifier: MIT
// Foreign plugins that end the process that loads them are refused, and this process continues.
#include "core/effect/probe.h"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "core/effect/registry.h"
#include "tests/support/expect_error.h"

namespace grisaille::effect {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(PLUGIN_DIR) / "crash";

// A temporary folder with links to these plugins.
struct TemporaryLinks {
  explicit TemporaryLinks(std::initializer_list<const char*> plugins) {
    fs::create_directory(folder);
    for (const char* plugin : plugins) {
      fs::create_symlink(fs::path(PLUGIN_DIR) / plugin, folder / fs::path(plugin).filename());
    }
  }
  ~TemporaryLinks() { fs::remove_all(folder); }

  fs::path folder = fs::temp_directory_path() / fmt::format("grisaille_probe_{}", getpid());
};

// The error's message. The default limit of one minute is enough on a busy machine.
std::string words(const char* name, std::chrono::milliseconds limit = std::chrono::minutes(1)) {
  try {
    probe(kFolder / (std::string("crash_") + name + ".so"), limit);
  } catch (const Error& error) {
    EXPECT_EQ(error.id(), ErrorId::kPluginCrashes);
    return error.detail();
  }
  return "none";
}

TEST(Probe, NamesWhatEndedTheProcess) {
  EXPECT_EQ(words("load"), "loading it ends the process: Aborted");
  EXPECT_EQ(words("unload"), "loading it ends the process: Aborted");
  // Invalid address: reported as a signal or, under sanitizers, as their exit status.
  EXPECT_EQ(words("table").rfind("loading it ends the process", 0), 0u);
  EXPECT_EQ(words("exit"), "loading it ends the process with exit status 0");
  EXPECT_EQ(words("hang", std::chrono::milliseconds(300)), "loading it does not end within 300 ms");
}

TEST(Probe, RefusesInTheRegistrysWords) {
  probe(fs::path(PLUGIN_DIR) / "sound" / "copy.so");
  EXPECT_ERROR(ErrorId::kPluginAbi, probe(fs::path(PLUGIN_DIR) / "faulty" / "magic.so"));
  EXPECT_ERROR(ErrorId::kPluginUnloadable, probe("/dev/null"));
  EXPECT_ERROR(ErrorId::kPluginUnloadable, probe("/nothing/there.so"));
  try {
    probe("/dev/null");
  } catch (const Error& error) {
    EXPECT_EQ(error.detail(), "it is a device; only regular files are read");
  }
}

TEST(Probe, TheRegistryAsksItForForeignPluginsAlone) {
  const TemporaryLinks links(
      {"crash/crash_load.so", "crash/crash_exit.so", "sound/plain.so", "faulty/range.so"});
  Registry registry;
  registry.scan(links.folder, Origin::kForeign);
  ASSERT_EQ(registry.effects().size(), 1u);
  ASSERT_EQ(registry.refused().size(), 3u);
  EXPECT_EQ(registry.refused()[0].reason.id(), ErrorId::kPluginCrashes);
  EXPECT_EQ(registry.refused()[1].reason.id(), ErrorId::kPluginCrashes);
  EXPECT_NE(registry.refused()[1].reason.detail().find("crash_load.so"), std::string::npos);
  EXPECT_EQ(registry.refused()[2].reason.id(), ErrorId::kPluginTable);
  EXPECT_ERROR(ErrorId::kPluginCrashes,
               registry.load(kFolder / "crash_table.so", Origin::kForeign));
  EXPECT_EXIT(Registry().load(kFolder / "crash_load.so"), testing::KilledBySignal(SIGABRT), "");
}

// For a death test: loads a plugin that starts a thread and is refused, then stays alive for a
// while.
[[noreturn]] void outliveRefusal(const fs::path& plugin, Origin origin, ErrorId expected) {
  constexpr int kOther = 1;
  try {
    Registry().load(plugin, origin);
  } catch (const Error& error) {
    usleep(100'000);
    _exit(error.id() == expected ? 0 : kOther);
  }
  _exit(kOther);
}

TEST(Probe, ARefusedPluginKeepsTheCodeOfItsThreads) {
  for (const Origin origin : {Origin::kOwn, Origin::kForeign}) {
    const fs::path folder = fs::path(PLUGIN_DIR) / "threaded";
    EXPECT_EXIT(outliveRefusal(folder / "threaded_major.so", origin, ErrorId::kPluginAbi),
                testing::ExitedWithCode(0), "");
    EXPECT_EXIT(outliveRefusal(folder / "threaded_range.so", origin, ErrorId::kPluginTable),
                testing::ExitedWithCode(0), "");
  }
}

// This process runs code of a foreign plugin only after accepting it.
TEST(Probe, WhatItRefusesIsNotLoadedHere) {
  const std::string plugin = fs::path(PLUGIN_DIR) / "threaded" / "threaded_range.so";
  try {
    Registry().load(plugin, Origin::kForeign);
    ADD_FAILURE() << "no error was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.id(), ErrorId::kPluginTable);
    EXPECT_EQ(error.detail().rfind(plugin + ": effects[0].", 0), 0u) << error.detail();
  }
  EXPECT_EQ(dlopen(plugin.c_str(), RTLD_LAZY | RTLD_NOLOAD), nullptr);
}

}  // namespace
}  // namespace grisaille::effect
