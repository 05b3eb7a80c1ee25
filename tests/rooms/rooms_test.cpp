// SPDX-License-Identifier: MIT
// Dependencies between the rooms (folders) run one way: lab -> app -> core <- backends, effects ->
// the installed header. Reads every #include of the tree and fails on any that the room's list does
// not allow.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

struct Room {
  const char* folder;
  const char* sees;  // visible folders (without subfolders) and single headers
};

// A file also sees its own folder. Every room but effects and installed headers sees core/base.
constexpr Room kRooms[] = {
    {"core/base", ""},
    {"core/gpu", "grisaille/shader.h"},
    {"core/objects", "grisaille"},
    {"core/effect", "core/gpu core/objects grisaille"},
    {"core/effect/include/grisaille", "grisaille"},
    {"core/image", ""},
    {"core/scene", "core/image"},
    {"core/scene/built_in", "core/image core/scene"},
    {"core/trace", "core/image core/scene grisaille"},
    {"core/frame",
     "core/effect core/gpu core/image core/scene core/trace/scene_matter.h grisaille shaders"},
    {"backends", "backends/opengl/opengl.h backends/vulkan/vulkan.h core/gpu"},
    {"backends/glfw", "backends/window.h"},
    {"backends/opengl", "backends/window.h core/gpu"},
    {"backends/vulkan", "backends/window.h core/gpu"},
    {"effects/ssao", "grisaille shaders"},
    {"effects/sspm", "grisaille shaders"},
    {"host",
     "backends/opengl/opengl.h backends/vulkan/vulkan.h core/effect core/gpu "
     "core/frame/view_block.h core/objects core/scene/view.h grisaille shaders"},
    {"host/include/grisaille", "grisaille"},
    // The program's commands, then the shared folders, each after the folders that it sees.
    {"app",
     "app/apply app/options app/process app/report app/services app/settings app/study app/truth "
     "app/verify app/viewer/viewer.h backends/backends.h core/effect core/frame core/gpu "
     "core/image core/objects core/scene core/trace grisaille"},
    {"app/apply", "core/image core/scene"},
    {"app/settings", "core/effect core/frame core/gpu"},
    {"app/services", "core/effect core/image core/objects core/scene core/trace grisaille"},
    {"app/report",
     "app/services/scene_services.h app/settings core/effect core/gpu core/image core/objects "
     "core/scene grisaille"},
    {"app/truth", "core/effect core/image core/scene core/trace"},
    {"app/process", "app/truth/interruption.h core/effect"},
    {"app/verify",
     "app/process/child.h app/services backends/backends.h core/effect core/frame core/gpu "
     "core/objects"},
    {"app/study",
     "app/services app/settings app/truth core/effect core/frame core/gpu core/image core/objects "
     "core/scene core/trace grisaille"},
    {"app/options",
     "app/services app/settings app/study/measurer.h app/study/sweep.h app/truth "
     "backends/backends.h core/effect "
     "core/frame core/gpu core/image core/objects core/scene core/trace"},
    {"app/viewer",
     "app/options/camera_option.h app/options/object_options.h app/options/pose_options.h "
     "app/process/child.h app/report app/services app/settings app/truth backends/backends.h "
     "backends/glfw/window.h core/effect core/frame core/gpu core/image core/objects core/scene "
     "grisaille shaders"},
    {"lab",
     "app/options app/process/program.h app/report/machine.h app/settings app/truth "
     "backends/backends.h core/image lab/claims lab/paint lab/soak lab/stability"},
    {"lab/paint", "core/effect core/objects core/trace"},
    {"lab/oracle", "core/image core/scene lab/paint"},
    {"lab/soak",
     "app/services app/settings app/truth core/effect core/frame core/gpu core/objects core/scene "
     "lab/paint"},
    {"lab/stability",
     "app/services app/truth core/effect core/frame core/gpu core/image core/scene core/trace "
     "lab/oracle lab/paint"},
    {"lab/claims",
     "app/services app/settings app/study app/truth core/effect core/frame core/gpu core/image "
     "core/objects core/scene core/trace lab/paint"},
};

// Headers of graphics APIs, which only backends may include.
const std::regex& apiHeader() {
  static const std::regex kHeader("^(epoxy|GL|GLES[0-9]*|EGL|KHR|vulkan)/.*|^volk\\.h");
  return kHeader;
}

bool startsWith(const std::string& text, const std::string& prefix) {
  return text.rfind(prefix, 0) == 0;
}

std::string folderOf(const std::string& file) {
  return fs::path(file).parent_path();
}

const Room* roomOf(const std::string& folder) {
  const Room* room = std::ranges::find(kRooms, folder, &Room::folder);
  return room == std::end(kRooms) ? nullptr : room;
}

// GLFW's main header exposes no graphics API; its header of native handles does.
bool mayOpenWindows(const std::string& folder, const std::string& header) {
  return startsWith(folder, "backends") || (folder == "app/viewer" && header == "GLFW/glfw3.h");
}

bool allowed(const std::string& folder, const std::string& header, bool quoted) {
  if (startsWith(header, "GLFW/")) return mayOpenWindows(folder, header);
  if (std::regex_match(header, apiHeader())) return startsWith(folder, "backends/");
  // A library's header, or a header beside the file.
  if (!quoted || header.find('/') == std::string::npos) return true;
  if (folderOf(header) == "core/base") {
    return !startsWith(folder, "effects") && folder.find("include/grisaille") == std::string::npos;
  }
  if (folderOf(header) == folder) return true;
  const Room* room = roomOf(folder);
  if (!room) return false;
  std::istringstream seen(room->sees);
  for (std::string name; seen >> name;) {
    if (name == header || name == folderOf(header)) return true;
  }
  return false;
}

TEST(Rooms, ArrowsRunOneWay) {
  const std::regex include("^\\s*#\\s*include\\s*([<\"])([^>\"]+)[>\"].*");
  size_t read = 0;
  for (const char* top : {"core", "backends", "effects", "host", "app", "lab"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(SOURCE_FOLDER) / top)) {
      const std::string ending = entry.path().extension();
      if (ending != ".h" && ending != ".hpp" && ending != ".cpp" && ending != ".c") continue;
      const std::string file = fs::relative(entry.path(), SOURCE_FOLDER);
      const std::string folder = folderOf(file);
      EXPECT_TRUE(roomOf(folder)) << file << " is in no room";
      std::ifstream text(entry.path());
      for (std::string line; std::getline(text, line);) {
        std::smatch match;
        if (!std::regex_match(line, match, include)) continue;
        ++read;
        EXPECT_TRUE(allowed(folder, match[2], match[1] == "\"")) << file << " sees " << match[2];
      }
    }
  }
  EXPECT_GT(read, 300u);
}

// Examples are built against the installed package: they see its headers and files beside them.
TEST(Rooms, ExamplesSeeInstalledHeadersAlone) {
  const std::regex include("^\\s*#\\s*include\\s*([<\"])([^>\"]+)[>\"].*");
  std::set<std::string> seen;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(SOURCE_FOLDER) / "examples")) {
    const std::string ending = entry.path().extension();
    if (ending != ".h" && ending != ".cpp") continue;
    const fs::path beside = entry.path().parent_path();
    std::ifstream text(entry.path());
    for (std::string line; std::getline(text, line);) {
      std::smatch match;
      if (!std::regex_match(line, match, include)) continue;
      const std::string header = match[2];
      if (startsWith(header, "grisaille/")) {
        seen.insert(header);
      } else if (match[1] == "\"") {
        // The example's own build generates the headers of its shaders.
        EXPECT_TRUE(header.ends_with(".inc") || startsWith(header, "shaders/") ||
                    fs::exists(beside / header) || fs::exists(beside / "../common" / header))
            << entry.path() << " sees " << header;
      } else {
        for (const char* room : {"core/", "backends/", "host/", "app/", "lab/", "shaders/"}) {
          EXPECT_FALSE(startsWith(header, room)) << entry.path() << " sees " << header;
        }
      }
    }
  }
  EXPECT_EQ(seen, (std::set<std::string>{"grisaille/effect.hpp", "grisaille/host.h",
                                         "grisaille/host.hpp"}));
}

// --- Names of effects

// Allows a line of text to name an effect, or a concept of an effect, as an example.
struct Example {
  const char* file;
  const char* text;  // part of the line
};

constexpr Example kExamples[] = {
    {"core/frame/frame_plan.cpp", "\"ssao.ao\" the output"},
    {"core/effect/include/grisaille/effect.h", "\"ssao.ao\": an output of another effect"},
    {"host/include/grisaille/host.h", "\"ssao.ao\" for another effect's output"},
    {"host/include/grisaille/host.hpp", "\"ssao.ao\" for another effect's output"},
    {"core/effect/parameter_name.h", "in reports: \"ssao.radius\"."},
    {"core/effect/parameter_name.h", "// \"ssao.radius=0.5\""},
    {"core/effect/include/grisaille/effect.h", "a key: \"ssao\""},
    {"core/effect/include/grisaille/effect.hpp", "a key: \"ssao\""},
    {"app/report/timings.h", "A pass labelled \"ssao/blur\" has the"},
    {"app/report/timings.h", "effect \"ssao\" and the pass"},
    {"app/study/gallery.h", "//   set = [\"ssao.radius=0.3\"]"},
    {"app/study/sweep.h", "Parses \"ssao.kernel_size=4,8,16\""},
    {"app/viewer/history.h", "`what` names the step: \"ssao.radius\""},
    {"app/settings/settings.h", "//   effects = [\"ssao\"]"},
    {"app/settings/settings.h", "//   [ssao]"},
    {"app/new_effect/README.md.in", "grisaille render --effects ssao,@KEY@"},
    {"host/include/grisaille/host.h", "the effect's key: \"ssao\""},
    {"host/include/grisaille/host.hpp", "the effect's key: \"ssao\""},
};

const std::regex& effectWord() {
  static const std::regex kWord("paint|shot|muzzle|splat|sspm|ssao", std::regex::icase);
  return kWord;
}

const Example* exampleOf(const std::string& file, const std::string& line) {
  const auto found = std::ranges::find_if(kExamples, [&](const Example& example) {
    return file == example.file && line.find(example.text) != std::string::npos;
  });
  return found == std::end(kExamples) ? nullptr : found;
}

// Core, app, host and backends know no effect by name; the effects' tables describe them.
TEST(Rooms, NoRoomButTheEffectsOwnKnowsWhatAnEffectMakes) {
  std::set<const Example*> used;
  size_t read = 0;
  for (const char* top : {"core", "backends", "host", "app"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(SOURCE_FOLDER) / top)) {
      if (!entry.is_regular_file()) continue;
      const std::string file = fs::relative(entry.path(), SOURCE_FOLDER);
      EXPECT_FALSE(std::regex_search(file, effectWord())) << file;
      std::ifstream text(entry.path());
      size_t number = 0;
      for (std::string line; std::getline(text, line); ++read) {
        ++number;
        std::smatch match;
        if (!std::regex_search(line, match, effectWord())) continue;
        const Example* example = exampleOf(file, line);
        used.insert(example);
        EXPECT_NE(example, nullptr) << file << ":" << number << ": " << match[0] << ": " << line;
      }
    }
  }
  EXPECT_GT(read, 10000u);
  for (const Example& example : kExamples) {
    EXPECT_TRUE(used.contains(&example)) << example.file << " has no " << example.text;
  }
}

TEST(Rooms, WordsAreSeenInsideOfWords) {
  for (const char* line : {"kShotLimit", "repaint(", "SSAO", "Muzzles", "--screenshot", "a.sspm"}) {
    EXPECT_TRUE(std::regex_search(line, effectWord())) << line;
  }
  for (const char* line : {"objects", "overlay", "colour", "capture", "s ao"}) {
    EXPECT_FALSE(std::regex_search(line, effectWord())) << line;
  }
}

TEST(Rooms, ForbiddenArrowsAreSeen) {
  EXPECT_FALSE(allowed("core/frame", "backends/backends.h", true));
  EXPECT_FALSE(allowed("core/gpu", "core/frame/renderer.h", true));
  EXPECT_FALSE(allowed("core/scene", "core/gpu/device.h", true));
  EXPECT_FALSE(allowed("core/gpu", "vulkan/vulkan.h", false));
  EXPECT_FALSE(allowed("app", "volk.h", false));
  EXPECT_FALSE(allowed("app", "backends/vulkan/vulkan.h", true));
  EXPECT_FALSE(allowed("backends/opengl", "backends/vulkan/vulkan.h", true));
  EXPECT_FALSE(allowed("lab/oracle", "effects/ssao/kernel.h", true));
  EXPECT_FALSE(allowed("lab/oracle", "core/frame/renderer.h", true));
  EXPECT_FALSE(allowed("effects/ssao", "core/base/error.h", true));
  EXPECT_FALSE(allowed("effects/ssao", "effects/sspm/sspm.h", true));
  EXPECT_FALSE(allowed("core/gpu", "GLFW/glfw3.h", false));
  EXPECT_FALSE(allowed("host", "core/frame/renderer.h", true));
  EXPECT_FALSE(allowed("host", "volk.h", false));
  EXPECT_FALSE(allowed("host", "app/command.h", true));
  EXPECT_FALSE(allowed("host/include/grisaille", "core/base/error.h", true));
  EXPECT_FALSE(allowed("app", "host/effect.h", true));
  EXPECT_FALSE(allowed("effects/ssao", "GLFW/glfw3.h", false));
  EXPECT_FALSE(allowed("app/viewer", "GLFW/glfw3native.h", false));
  EXPECT_FALSE(allowed("app/study", "GLFW/glfw3.h", false));
  EXPECT_FALSE(allowed("app", "lab/command.h", true));
  EXPECT_FALSE(allowed("app/study", "lab/claims/metrics.h", true));
  EXPECT_FALSE(allowed("core/scene", "lab/oracle/view.h", true));
  EXPECT_FALSE(allowed("lab", "app/command.h", true));
  EXPECT_FALSE(allowed("lab", "app/viewer/viewer.h", true));
  EXPECT_FALSE(allowed("lab/claims", "lab/stability/runner.h", true));
  EXPECT_FALSE(allowed("lab/oracle", "app/truth/cache.h", true));
  EXPECT_FALSE(allowed("app/study", "app/viewer/command_line.h", true));
  EXPECT_FALSE(allowed("app/viewer", "app/study/measurer.h", true));
  EXPECT_FALSE(allowed("app/verify", "app/viewer/stage.h", true));
  EXPECT_FALSE(allowed("app/viewer", "app/verify/verify.h", true));
  EXPECT_FALSE(allowed("app/verify", "app/study/study.h", true));
  EXPECT_FALSE(allowed("app/settings", "app/options/size.h", true));
  EXPECT_FALSE(allowed("app/viewer", "app/command.h", true));
  EXPECT_FALSE(allowed("app/unlisted", "core/image/image.h", true));
  EXPECT_TRUE(allowed("lab", "lab/claims/report.h", true));
  EXPECT_TRUE(allowed("lab/stability", "lab/oracle/view.h", true));
  EXPECT_TRUE(allowed("app/viewer", "GLFW/glfw3.h", false));
  EXPECT_TRUE(allowed("backends/opengl", "GLFW/glfw3native.h", false));
  EXPECT_TRUE(allowed("effects/ssao", "grisaille/effect.hpp", true));
  EXPECT_TRUE(allowed("backends/vulkan", "volk.h", false));
}

}  // namespace
}  // namespace grisaille::tests
