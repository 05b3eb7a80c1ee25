// SPDX-License-Identifier: MIT
// Arrows between the rooms run one way: app -> core <- backends, effects -> the installed header.
// Reads every #include of the tree and fails on one that runs elsewhere.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

struct Room {
  std::string folder;             // longest match wins
  std::vector<std::string> sees;  // prefixes of the project's own headers
};

// A file always sees the headers of its own folder, and core/base.
const std::vector<Room>& rooms() {
  static const std::vector<Room> kRooms = {
      {"core", {}},
      {"core/image", {}},
      {"core/scene", {"core/image/"}},
      {"core/shots", {"core/image/", "grisaille/"}},
      {"core/gpu", {"grisaille/shader.h"}},
      {"core/trace", {"core/scene/", "core/image/", "grisaille/"}},
      {"core/effect", {"core/gpu/", "grisaille/"}},
      {"core/effect/include/grisaille", {"grisaille/"}},
      {"core/frame",
       {"core/effect/", "core/gpu/", "core/image/", "core/scene/", "grisaille/", "shaders/"}},
      {"backends", {"backends/opengl/opengl.h", "backends/vulkan/vulkan.h", "core/gpu/"}},
      {"backends/glfw", {"backends/window.h"}},
      {"backends/opengl", {"backends/window.h", "core/gpu/"}},
      {"backends/vulkan", {"backends/window.h", "core/gpu/"}},
      {"host",
       {"backends/opengl/opengl.h", "backends/vulkan/vulkan.h", "core/effect/", "core/gpu/",
        "core/frame/view_block.h", "core/scene/camera.h", "core/shots/shot.h", "grisaille/",
        "host/", "shaders/"}},
      {"host/include/grisaille", {"grisaille/"}},
      {"effects", {"grisaille/", "shaders/"}},
      {"app", {"backends/backends.h", "core/", "grisaille/", "app/"}},
      {"app/truth", {"core/"}},
      {"app/stability", {"core/", "grisaille/", "app/"}},
      {"app/stability/oracle", {"core/image/", "core/scene/", "grisaille/"}},
      {"app/study", {"core/", "grisaille/", "app/", "backends/backends.h"}},
      {"app/viewer",
       {"backends/backends.h", "backends/glfw/window.h", "core/", "grisaille/", "app/",
        "shaders/"}},
  };
  return kRooms;
}

// Headers of a graphics API, which backends alone see.
const std::regex& apiHeader() {
  static const std::regex kHeader("^(epoxy|GL|GLES[0-9]*|EGL|KHR|vulkan)/.*|^volk\\.h");
  return kHeader;
}

bool startsWith(const std::string& text, const std::string& prefix) {
  return text.rfind(prefix, 0) == 0;
}

// GLFW's own header shows no API; its header of native handles does.
bool mayOpenWindows(const std::string& folder, const std::string& header) {
  const bool backend = folder == "backends" || startsWith(folder, "backends/");
  const bool app = folder == "app" || startsWith(folder, "app/");
  return backend || (app && header == "GLFW/glfw3.h");
}

const Room* roomOf(const std::string& folder) {
  const Room* found = nullptr;
  for (const Room& room : rooms()) {
    const bool inside = folder == room.folder || startsWith(folder, room.folder + "/");
    if (inside && (!found || room.folder.size() > found->folder.size())) found = &room;
  }
  return found;
}

bool allowed(const std::string& folder, const std::string& header, bool quoted) {
  if (startsWith(header, "GLFW/")) return mayOpenWindows(folder, header);
  if (std::regex_match(header, apiHeader())) return startsWith(folder, "backends/");
  // A library's header, or one that lies beside the file.
  if (!quoted || header.find('/') == std::string::npos) return true;
  if (startsWith(header, "core/base/")) {
    return !startsWith(folder, "effects") && folder.find("include/grisaille") == std::string::npos;
  }
  // An effect's own folder is the second level: one effect never sees another.
  if (startsWith(header, folder + "/")) return true;
  const Room* room = roomOf(folder);
  if (!room) return false;
  for (const std::string& prefix : room->sees) {
    if (startsWith(header, prefix)) return true;
  }
  return false;
}

TEST(Rooms, ArrowsRunOneWay) {
  const std::regex include("^\\s*#\\s*include\\s*([<\"])([^>\"]+)[>\"].*");
  size_t read = 0;
  for (const char* top : {"core", "backends", "effects", "host", "app"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(SOURCE_FOLDER) / top)) {
      const std::string ending = entry.path().extension();
      if (ending != ".h" && ending != ".hpp" && ending != ".cpp" && ending != ".c") continue;
      const std::string file = fs::relative(entry.path(), SOURCE_FOLDER);
      const std::string folder = fs::path(file).parent_path();
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

// The example hosts have of the project what is installed for them, and no more.
TEST(Rooms, ExamplesSeeTheHostHeadersAlone) {
  const std::regex include("^\\s*#\\s*include\\s*([<\"])([^>\"]+)[>\"].*");
  std::set<std::string> seen;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(SOURCE_FOLDER) / "examples")) {
    const std::string ending = entry.path().extension();
    if (ending != ".h" && ending != ".cpp") continue;
    std::ifstream text(entry.path());
    for (std::string line; std::getline(text, line);) {
      std::smatch match;
      if (!std::regex_match(line, match, include)) continue;
      const std::string header = match[2];
      if (match[1] == "\"") {
        const fs::path beside = entry.path().parent_path();
        EXPECT_TRUE(header.ends_with(".inc") || fs::exists(beside / header) ||
                    fs::exists(beside / "../common" / header))
            << entry.path() << " sees " << header;
      } else if (startsWith(header, "grisaille/")) {
        seen.insert(header);
      } else {
        for (const char* room : {"core/", "backends/", "host/", "app/", "shaders/"}) {
          EXPECT_FALSE(startsWith(header, room)) << entry.path() << " sees " << header;
        }
      }
    }
  }
  EXPECT_EQ(seen, (std::set<std::string>{"grisaille/host.h", "grisaille/host.hpp"}));
}

TEST(Rooms, ForbiddenArrowsAreSeen) {
  EXPECT_FALSE(allowed("core/frame", "backends/backends.h", true));
  EXPECT_FALSE(allowed("core/gpu", "core/frame/renderer.h", true));
  EXPECT_FALSE(allowed("core/scene", "core/gpu/device.h", true));
  EXPECT_FALSE(allowed("core/gpu", "vulkan/vulkan.h", false));
  EXPECT_FALSE(allowed("app", "volk.h", false));
  EXPECT_FALSE(allowed("app", "backends/vulkan/vulkan.h", true));
  EXPECT_FALSE(allowed("backends/opengl", "backends/vulkan/vulkan.h", true));
  EXPECT_FALSE(allowed("app/stability/oracle", "effects/ssao/kernel.h", true));
  EXPECT_FALSE(allowed("app/stability/oracle", "core/frame/renderer.h", true));
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
  EXPECT_TRUE(allowed("app/viewer", "GLFW/glfw3.h", false));
  EXPECT_TRUE(allowed("backends/opengl", "GLFW/glfw3native.h", false));
  EXPECT_TRUE(allowed("effects/ssao", "grisaille/effect.hpp", true));
  EXPECT_TRUE(allowed("backends/vulkan", "volk.h", false));
}

}  // namespace
}  // namespace grisaille::tests
