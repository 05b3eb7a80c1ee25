// SPDX-License-Identifier: MIT
// The installed libgrisaille: what it links and exports, and hosts that are built with CMake and
// with pkg-config, in C and C++, against the shared and the static library.
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <iterator>
#include <set>
#include <sstream>
#include <thread>

#include "core/image/image.h"
#include "tests/build/installation.h"
#include "tests/build/session.h"

namespace grisaille::tests {
namespace {

std::set<std::string> wordsOf(const std::string& text) {
  std::istringstream words(text);
  return {std::istream_iterator<std::string>(words), {}};
}

class Library : public Installed {
 protected:
  void SetUp() override {
    Installed::SetUp();
    for (const char* tool : {"readelf", "pkg-config"}) {
      if (runShell(std::string("command -v ") + tool, ".").status != 0) {
        GTEST_SKIP() << tool << " is not installed";
      }
    }
  }

  // Runs a script with the prefix as `$prefix` and pkg-config's files of it.
  static Outcome shell(const std::string& name, const std::string& script) {
    return session(name, "set -e\nprefix=\"" + prefix().string() +
                             "\"\nexport PKG_CONFIG_PATH=\"$prefix/lib/pkgconfig\" "
                             "LD_LIBRARY_PATH=\"$prefix/lib\"\n" +
                             script);
  }
  static std::string run(const std::string& name, const std::string& script) {
    const Outcome outcome = shell(name, script);
    EXPECT_EQ(outcome.status, 0) << script << "\n" << outcome.out << outcome.err;
    return outcome.out;
  }
  static void writeHosts(const std::string& name) {
    const fs::path sources = fs::path(SOURCE_FOLDER) / "tests/build/host";
    fs::create_directories(workOf(name));
    fs::copy(sources, workOf(name),
             fs::copy_options::overwrite_existing | fs::copy_options::recursive);
  }
};

// The functions that docs/abi.txt lists.
std::set<std::string> publicFunctions() {
  std::set<std::string> functions;
  std::istringstream table(readFile(fs::path(SOURCE_FOLDER) / "docs/abi.txt"));
  for (std::string line; std::getline(table, line);) {
    const std::string name = line.substr(0, line.find(':'));
    const bool function = name.starts_with("grisaille_host_") && line.ends_with(")") &&
                          name.find('.') == std::string::npos;
    if (function) functions.insert(name);
  }
  return functions;
}

TEST_F(Library, LinksWhatHostsHave) {
  const std::set<std::string> needed = wordsOf(run(
      "links",
      "readelf -d \"$prefix/lib/libgrisaille.so\" | sed -n 's/.*NEEDED.*\\[\\(.*\\)\\]/\\1/p'"));
  EXPECT_TRUE(needed.contains("libstdc++.so.6"));
  for (const std::string& library : needed) {
    const bool usual = library.starts_with("ld-linux");
    EXPECT_TRUE(usual || std::set<std::string>({"libepoxy.so.0", "libstdc++.so.6", "libm.so.6",
                                                "libgcc_s.so.1", "libc.so.6"})
                             .contains(library))
        << library;
  }
  // Not even libraries of libraries bring these.
  const std::string loaded = run("links", "ldd \"$prefix/lib/libgrisaille.so\"");
  for (const char* library : {"glfw", "X11", "xcb", "wayland", "fmt", "imgui", "spirv", "vulkan"}) {
    EXPECT_EQ(loaded.find(library), std::string::npos) << loaded;
  }
}

TEST_F(Library, ExportsTheFunctionsOfTheHeaderAlone) {
  const std::set<std::string> functions = publicFunctions();
  EXPECT_GT(functions.size(), 20u);
  EXPECT_EQ(wordsOf(run("exports",
                        "nm -D --defined-only --format=just-symbols "
                        "\"$prefix/lib/libgrisaille.so\"")),
            functions);
  const std::string archive =
      run("exports", "nm -g --defined-only --format=just-symbols \"$prefix/lib/libgrisaille.a\"");
  std::set<std::string> symbols = wordsOf(archive);
  std::erase_if(symbols, [](const std::string& word) { return word.ends_with(".o:"); });
  EXPECT_EQ(symbols, functions);
}

// Files for CMake and pkg-config name no library that a host has to install beside epoxy.
TEST_F(Library, AsksHostsForEpoxyAtMost) {
  std::string files = run("names",
                          "cat \"$prefix\"/lib/pkgconfig/*.pc "
                          "\"$prefix\"/lib/cmake/Grisaille/Grisaille*Targets*.cmake");
  EXPECT_NE(files.find("-lepoxy"), std::string::npos);
  for (const char* library : {"glfw", "X11", "fmt", "imgui", "nlohmann", "glm", "volk"}) {
    EXPECT_EQ(files.find(library), std::string::npos) << library;
  }
  EXPECT_EQ(wordsOf(run("names", "pkg-config --libs-only-l grisaille")),
            (std::set<std::string>{"-lgrisaille"}));
  EXPECT_EQ(wordsOf(run("names", "pkg-config --static --libs-only-l grisaille")),
            (std::set<std::string>{"-lgrisaille", "-lepoxy", "-lstdc++", "-lm", "-ldl"}));
}

// The shared library finds the effects beside itself; a host that contains the static one passes
// their folder. The wall is open, the slit is occluded.
constexpr const char* kRunHosts =
    "for host in ./host './host_static'; do\n"
    "  folder=-; [[ $host == ./host ]] || folder=$effects\n"
    "  $host \"$folder\" | tee -a results\n"
    "done\n"
    "! readelf -d host_static | grep libgrisaille\n"
    "readelf -d host | grep libgrisaille\n";

void expectResults(const std::string& results) {
  std::istringstream lines(results);
  int hosts = 0;
  for (std::string line; std::getline(lines, line); ++hosts) {
    unsigned version = 0;
    float wall = 0, slit = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "version %u, wall %f, slit %f", &version, &wall, &slit), 3)
        << line;
    EXPECT_GT(wall, 0.95f);
    EXPECT_LT(slit, 0.75f);
    EXPECT_GT(slit, 0.1f);
  }
  EXPECT_EQ(hosts, 2) << results;
}

class LibraryByCMake : public Library, public ::testing::WithParamInterface<const char*> {};
INSTANTIATE_TEST_SUITE_P(, LibraryByCMake, ::testing::Values("C", "CXX"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(LibraryByCMake, HostsRun) {
  const std::string name = std::string("by_cmake_") + GetParam();
  writeHosts(name);
  run(name, std::string("cmake -S . -B build -DCMAKE_PREFIX_PATH=\"$prefix\" -DLANGUAGE=") +
                GetParam() + " && cmake --build build && cd build && effects=$(cat effects)\n" +
                kRunHosts +
                (GetParam() == std::string("CXX") ? "./names && ./names_static\n" : ""));
  expectResults(readFile(workOf(name) / "build/results"));
}

TEST_F(Library, HostsRunByPkgConfig) {
  writeHosts("by_pkg_config");
  run("by_pkg_config",
      "eval \"effects=$(pkg-config --variable=effectsdir grisaille)\"\n"
      "eval \"cc -std=c99 host.c $(pkg-config --cflags --libs grisaille) -lEGL -o host\"\n"
      "eval \"cc -std=c99 host.c $(pkg-config --cflags --libs grisaille-static) -lEGL -o "
      "host_static\"\n"
      "eval \"c++ -std=c++20 names.cpp $(pkg-config --cflags --libs grisaille) -o names \"&& "
      "./names\n"
      "eval \"c++ -std=c++20 names.cpp $(pkg-config --cflags --libs grisaille-static) -o "
      "names_static\"\n"
      "./names_static\n" +
          std::string(kRunHosts));
  expectResults(readFile(workOf("by_pkg_config") / "results"));
}

// find_package with a component in `script`, which sees what it has found.
Outcome findPackage(const std::function<Outcome(const std::string&)>& shell,
                    const std::string& components, const std::string& then) {
  return shell(
      "rm -rf project && mkdir project && cd project\n"
      "cat > CMakeLists.txt <<'END'\ncmake_minimum_required(VERSION 3.25)\n"
      "project(Any LANGUAGES C CXX)\nfind_package(Grisaille " +
      components + ")\n" + then + "END\ncmake -S . -B build -DCMAKE_PREFIX_PATH=\"$prefix\"");
}

TEST_F(Library, ComponentsBringWhatTheirNamesSay) {
  const auto find = [](const std::string& components, const std::string& then) {
    return findPackage([](const std::string& script) { return shell("components", script); },
                       components, then);
  };
  const auto expectMet = [&](const std::string& components, const std::string& conditions) {
    const Outcome outcome = find(
        components, "if(NOT (" + conditions + "))\nmessage(FATAL_ERROR \"not met\")\nendif()\n");
    EXPECT_EQ(outcome.status, 0) << components << ": " << outcome.err;
  };
  const std::string host = "TARGET Grisaille::grisaille AND TARGET Grisaille::abi";
  expectMet("REQUIRED COMPONENTS host",
            host + " AND NOT COMMAND grisaille_add_effect AND NOT TARGET Grisaille::program");
  expectMet("REQUIRED COMPONENTS effect",
            "COMMAND grisaille_add_effect AND TARGET Grisaille::abi AND NOT TARGET "
            "Grisaille::grisaille");
  expectMet("REQUIRED COMPONENTS program",
            "TARGET Grisaille::program AND NOT TARGET Grisaille::grisaille");
  expectMet("REQUIRED", host + " AND COMMAND grisaille_add_effect AND TARGET Grisaille::program");
  expectMet("COMPONENTS host OPTIONAL_COMPONENTS vulkan",
            "Grisaille_FOUND AND Grisaille_host_FOUND AND NOT Grisaille_vulkan_FOUND");
  expectMet("COMPONENTS vulkan", "NOT Grisaille_FOUND");
  const Outcome unknown = find("REQUIRED COMPONENTS host vulkan", "");
  EXPECT_NE(unknown.status, 0);
  EXPECT_NE(unknown.err.find("no component 'vulkan'"), std::string::npos) << unknown.err;
  EXPECT_NE(unknown.err.find("components are host, effect"), std::string::npos) << unknown.err;
}

// Shares of dark and of bright pixels among those that are not black.
struct Tones {
  double dark = 0, bright = 0;
  size_t count = 0;
};
Tones tonesOf(const std::vector<uint32_t>& pixels, uint32_t dark, uint32_t bright) {
  Tones tones;
  for (const uint32_t pixel : pixels) {
    const uint32_t green = pixel >> 8 & 0xff;
    if (green == 0) continue;
    ++tones.count;
    tones.dark += green < dark ? 1 : 0;
    tones.bright += green > bright ? 1 : 0;
  }
  tones.dark /= static_cast<double>(std::max(tones.count, size_t{1}));
  tones.bright /= static_cast<double>(std::max(tones.count, size_t{1}));
  return tones;
}

// Follows the page from the first block to the last in an empty folder: an OpenGL program shows
// ambient occlusion in its window, a Vulkan program in a picture.
TEST_F(Library, EmbedLeadsToAWindowAndAPicture) {
  const std::string page = sessionOf(fs::path(SOURCE_FOLDER) / "docs/manual/embed.md");
  const Outcome followed = session("embed", page);
  ASSERT_EQ(followed.status, 0) << followed.out << followed.err;
  const fs::path work = workOf("embed");

  const image::Image lit = image::read(work / "vulkan.ppm");
  EXPECT_EQ(lit.width * lit.height, 320u * 180);
  // The blocks and walls are lit evenly, but for the corners.
  const float brightest = std::ranges::max(lit.pixels);
  const auto corners = static_cast<size_t>(
      std::ranges::count_if(lit.pixels, [&](float v) { return v < 0.8f * brightest; }));
  EXPECT_GT(corners, lit.pixels.size() / 100);
  EXPECT_LT(corners, lit.pixels.size() / 2);

  // Without a number of frames, the window stays open.
  ASSERT_EQ(session("embed", "build/first > shown 2>&1 & echo $! > pid").status, 0);
  Tones tones;
  for (int i = 0; i < 300 && tones.count < 640 * 360 * 9 / 10; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    tones = tonesOf(display().pixels(0, 0, 640, 360), 150, 230);
  }
  kill(std::stoi(readFile(work / "pid")), SIGTERM);
  EXPECT_GT(tones.count, 640u * 360 * 9 / 10) << readFile(work / "shown");
  EXPECT_GT(tones.bright, 0.3);
  EXPECT_GT(tones.dark, 0.003);
  EXPECT_LT(tones.dark, 0.3);
}

TEST_F(Library, DocumentsComeWithThePackage) {
  for (const char* file :
       {"README.md", "docs/manual/embed.md", "docs/manual/write_an_effect.md", "docs/abi.txt",
        "docs/pictures/first_run.png", "examples/vulkan/main.cpp", "copyright"}) {
    EXPECT_TRUE(fs::exists(prefix() / "share/doc/grisaille" / file)) << file;
  }
  if (runShell("command -v doxygen", ".").status != 0) return;
  EXPECT_NE(readFile(prefix() / "share/doc/grisaille/docs/api/index.html").find("host.hpp"),
            std::string::npos);
}

}  // namespace
}  // namespace grisaille::tests
