// SPDX-License-Identifier: MIT
#include "app/viewer/state_file.h"

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/support/expect_error.h"
#include "tests/support/folder_test.h"

namespace grisaille::app::viewer {
namespace {

namespace fs = std::filesystem;

using StateFile = tests::FolderTest;

ViewerState some() {
  ViewerState state;
  for (const char* path : {"/a.glb", "/b c.gltf", "/ä/\"'.glb"}) state.noteRecent(path);
  state.width = 1920;
  state.height = 1080;
  state.layout.textScale = 1.0 / 3 + 1;
  state.layout.light = true;
  state.layout.panelWidth = 31.25;
  state.layout.sections = {{"Cost", true}, {"View", false}};
  return state;
}

ViewerState load(const fs::path& file) {
  std::string message;
  ViewerState state = loadState(file, message);
  EXPECT_EQ(message, "");
  return state;
}

TEST_F(StateFile, ComesBackAsItWasSaved) {
  const fs::path path = folder_ / "not yet/there/viewer.json";
  EXPECT_EQ(load(path), ViewerState());
  for (const ViewerState& state : {ViewerState(), some()}) {
    saveState(state, path);
    EXPECT_EQ(load(path), state);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(path.parent_path()), {}), 1);
}

TEST_F(StateFile, ADamagedFileIsKeptAndTold) {
  const std::string good = nlohmann::json({{"width", 800}}).dump();
  const std::string contents[] = {"",
                                  "{",
                                  "[]",
                                  "\xff\xfe",
                                  good.substr(0, good.size() - 1),
                                  R"({"width": 0})",
                                  R"({"width": -5})",
                                  R"({"width": "wide"})",
                                  R"({"height": 1e9})",
                                  R"({"text_scale": 0})",
                                  R"({"text_scale": 1e999})",
                                  R"({"recent": "one"})",
                                  R"({"recent": [1]})",
                                  R"({"panel_width": 0})",
                                  R"({"sections": ["Cost"]})",
                                  R"({"sections": {"Cost": 1}})",
                                  std::string(100000, '['),
                                  std::string(2 << 20, ' ')};
  for (const std::string& content : contents) {
    SCOPED_TRACE(content.substr(0, 40));
    const std::string path = fileOf("viewer.json", content);
    std::string message = "old";
    EXPECT_EQ(loadState(path, message), ViewerState());
    EXPECT_EQ(message.rfind("error E5105: ", 0), 0u) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
    EXPECT_FALSE(fs::exists(path));
    EXPECT_EQ(contentOf(path + ".damaged"), content);
    saveState(some(), path);
    EXPECT_EQ(load(path), some());
    EXPECT_EQ(contentOf(path + ".damaged"), content);
  }
}

TEST_F(StateFile, ReadsWhatItKnowsOfALaterVersion) {
  const ViewerState state =
      load(fileOf("viewer.json", R"({"width": 640, "unheard_of": {"a": [1]}})"));
  EXPECT_EQ(state.width, 640u);
  EXPECT_EQ(state.height, 900u);
}

TEST_F(StateFile, AFolderInItsPlaceStopsNothing) {
  fs::create_directories(folder_ / "viewer.json");
  std::string message;
  EXPECT_EQ(loadState(folder_ / "viewer.json", message), ViewerState());
  EXPECT_NE(message, "");
  fileOf("file", "");
  EXPECT_ERROR(ErrorId::kFileUnwritable, saveState({}, folder_ / "file/viewer.json"));
}

TEST_F(StateFile, NewestComesFirstOnceAndTwelveStay) {
  ViewerState state;
  for (int i = 0; i < 20; ++i) state.noteRecent("/scenes/" + std::to_string(i));
  ASSERT_EQ(state.recent.size(), 12u);
  EXPECT_EQ(state.recent.front(), "/scenes/19");
  EXPECT_EQ(state.recent.back(), "/scenes/8");
  state.noteRecent("/scenes/x/../12");
  EXPECT_EQ(state.recent.size(), 12u);
  EXPECT_EQ(state.recent.front(), "/scenes/12");
  EXPECT_EQ(std::ranges::count(state.recent, "/scenes/12"), 1);
  for (const char* builtIn : {"", "atrium", "leaves"}) state.noteRecent(builtIn);
  EXPECT_EQ(state.recent.front(), "/scenes/12");
  state.noteRecent("a.glb");
  EXPECT_EQ(state.recent.front(), (fs::current_path() / "a.glb").string());
}

TEST_F(StateFile, APathThatIsNoTextIsLeftOut) {
  ViewerState state = some();
  state.noteRecent("/\xff.glb");
  saveState(state, folder_ / "viewer.json");
  EXPECT_EQ(load(folder_ / "viewer.json"), some());
}

// Sets an environment variable and restores it.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    const char* old = std::getenv(name);
    if (old != nullptr) old_ = old;
    set(value);
  }
  ~Variable() { set(old_ ? old_->c_str() : nullptr); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

  void set(const char* value) const {
    if (value != nullptr) {
      setenv(name_, value, 1);
    } else {
      unsetenv(name_);
    }
  }

 private:
  const char* name_;
  std::optional<std::string> old_;
};

TEST(Folders, AreWhereTheStandardSays) {
  const Variable home("HOME", "/home/someone"), state("XDG_STATE_HOME", nullptr),
      config("XDG_CONFIG_HOME", nullptr);
  EXPECT_EQ(stateFolder(), "/home/someone/.local/state/grisaille");
  EXPECT_EQ(configFolder(), "/home/someone/.config/grisaille");
  for (const char* ignored : {"", "relative"}) {
    state.set(ignored);
    EXPECT_EQ(stateFolder(), "/home/someone/.local/state/grisaille");
  }
  state.set("/s");
  config.set("/c");
  EXPECT_EQ(stateFolder(), "/s/grisaille");
  EXPECT_EQ(configFolder(), "/c/grisaille");
  config.set(nullptr);
  home.set(nullptr);
  EXPECT_TRUE(configFolder().is_absolute());
}

TEST_F(StateFile, SavedSettingsAreTheFilesOfTheirFolder) {
  EXPECT_TRUE(savedSettings(folder_).empty());
  for (const char* name : {"soft.toml", "a b.toml", "readme.md", "x.toml.bak"}) {
    fileOf(std::string("settings/") + name, "");
  }
  const std::vector<SavedSettings> all = savedSettings(folder_);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].name, "a b");
  EXPECT_EQ(all[0].path, folder_ / "settings/a b.toml");
  EXPECT_EQ(all[1].name, "soft");
}

}  // namespace
}  // namespace grisaille::app::viewer
