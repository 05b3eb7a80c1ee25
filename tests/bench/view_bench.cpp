// SPDX-License-Identifier: MIT
// Measures what the viewer costs besides the scene: CPU time of its panel, of an idle window, and
// the time from the program's start to the first picture, on a display (Xvfb) that the benchmark
// starts.
#include <fcntl.h>
#include <fmt/format.h>
#include <imgui/imgui.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "app/viewer/input.h"
#include "app/viewer/interface.h"
#include "app/viewer/panel.h"
#include "core/gpu/null_device.h"
#include "tests/bench/command.h"
#include "tests/program/run.h"
#include "tests/support/display.h"

namespace grisaille::bench {
namespace {

namespace viewer = app::viewer;

constexpr glm::uvec2 kWindow(1600, 1400);
constexpr glm::uvec2 kFirstSize(1280, 900);
constexpr int kFramesARound = 300;
constexpr int kIdleSeconds = 10;

double cpuMilliseconds() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

// The panel with both effects and the help, and as many passes as a real frame.
struct Subject {
  viewer::Session session;
  viewer::ViewerState state;
  viewer::Bookmarks bookmarks{"/nonexistent"};
  viewer::InterfaceContext context;
  viewer::Panel panel{session, state, bookmarks};
  viewer::Status status;

  static viewer::SessionOptions options() {
    viewer::SessionOptions options;
    options.effects = {"ssao", "sspm"};
    options.effectsGiven = true;
    options.pluginPaths = {EFFECTS_FOLDER};
    return options;
  }

  Subject() : session(options()) {
    context.setScale(1);
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = ImVec2(static_cast<float>(kWindow.x), static_cast<float>(kWindow.y));
    io.DeltaTime = 1.0f / 60;
    viewer::prepareInput();
    for (int i = 0; i < 8; ++i) {
      status.passes.push_back(
          {fmt::format("effect/pass {}", i), std::vector<float>(240, 1.0f), 1, 1});
    }
    status.whole = status.passes[0];
    panel.help = true;
  }

  void build() {
    ImGui::NewFrame();
    panel.draw(status, glm::vec2(kWindow));
    ImGui::Render();
  }
};

void printRow(const char* what, std::vector<double> times) {
  std::ranges::sort(times);
  fmt::print("| {} | {:.3f} | {:.3f} |\n", what, times[times.size() / 2],
             times[times.size() * 95 / 100]);
}

void panelCost(uint32_t rounds) {
  Subject subject;
  const auto device = gpu::makeNullDevice();
  viewer::InterfaceRenderer renderer(*device);
  const gpu::Texture window = device->createTexture({.label = "window",
                                                     .format = gpu::Format::kRgba8Unorm,
                                                     .width = kWindow.x,
                                                     .height = kWindow.y,
                                                     .usage = gpu::TextureUsage::kTarget});
  std::vector<double> building, recording;
  for (uint32_t i = 0; i < rounds * kFramesARound; ++i) {
    const double start = cpuMilliseconds();
    subject.build();
    const double built = cpuMilliseconds();
    gpu::Commands& commands = device->begin();
    commands.beginPass("interface");
    renderer.draw(commands, *ImGui::GetDrawData(), window, kWindow.x, kWindow.y);
    commands.endPass();
    device->submit();
    const double end = cpuMilliseconds();
    if (i < 10) continue;  // fonts and first layouts
    building.push_back(built - start);
    recording.push_back(end - built);
  }
  device->destroy(window);
  fmt::print("| part of the panel's frame | CPU, ms, median | 95th percentile |\n|---|---|---|\n");
  printRow("building it", building);
  printRow("recording it", recording);
  std::vector<double> sums;
  for (size_t i = 0; i < building.size(); ++i) sums.push_back(building[i] + recording[i]);
  printRow("both", sums);
}

// Clock ticks that a process has used.
double ticksOf(pid_t process) {
  std::ifstream file(fmt::format("/proc/{}/stat", process));
  std::string text((std::istreambuf_iterator<char>(file)), {});
  std::istringstream fields(text.substr(text.rfind(')') + 2));
  std::string skipped;
  for (int i = 0; i < 11; ++i) fields >> skipped;
  double user = 0, kernel = 0;
  fields >> user >> kernel;
  return user + kernel;
}

void idleCost(const std::string& backend) {
  const tests::Display display(1600, 1000);
  const pid_t child = fork();
  if (child == 0) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, 1);
    execl(PROGRAM, "grisaille", "view", "--backend", backend.c_str(), "--size", "1280x900",
          nullptr);
    _exit(127);
  }
  std::this_thread::sleep_for(std::chrono::seconds(8));
  const double before = ticksOf(child);
  std::this_thread::sleep_for(std::chrono::seconds(kIdleSeconds));
  const double used = (ticksOf(child) - before) / static_cast<double>(sysconf(_SC_CLK_TCK));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  fmt::print("| {} | {:.2f} % |\n", backend, 100 * used / kIdleSeconds);
}

struct ViewOptions : CommonOptions {
  std::string scene = tests::sponza();
};

// Whether the right half of the window shows a scene: it is of one colour before.
bool showsScene(const tests::Display& display) {
  std::set<uint32_t> colours;
  for (const uint32_t y : {kFirstSize.y / 8, kFirstSize.y / 5, kFirstSize.y * 7 / 8}) {
    const auto row = display.pixels(kFirstSize.x / 2, y, kFirstSize.x / 2, 1);
    colours.insert(row.begin(), row.end());
  }
  return colours.size() > 40;
}

// Seconds from the start of the program to the first picture, without a last session.
double firstPicture(const std::string& backend, const std::string& scene,
                    const std::string& folder) {
  const tests::Display display(kFirstSize.x, kFirstSize.y);
  const auto start = std::chrono::steady_clock::now();
  const std::chrono::duration<double> most(60);
  const pid_t child = fork();
  if (child == 0) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, 1);
    setenv("XDG_STATE_HOME", folder.c_str(), 1);
    setenv("DBUS_SESSION_BUS_ADDRESS", "", 1);
    const std::string size = fmt::format("{}x{}", kFirstSize.x, kFirstSize.y);
    execl(PROGRAM, "grisaille", "view", scene.c_str(), "--fresh", "--backend", backend.c_str(),
          "--size", size.c_str(), nullptr);
    _exit(127);
  }
  std::chrono::duration<double> took(0);
  while (took < most && !showsScene(display)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
    took = std::chrono::steady_clock::now() - start;
  }
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  return took.count();
}

void firstPictures(const ViewOptions& options) {
  const tests::TemporaryFolder folder;
  fmt::print(
      "\nFrom the start to the first picture, {}x{}, {}; {} runs a row after one that "
      "compiles the shaders:\n\n",
      kFirstSize.x, kFirstSize.y,
      options.scene.empty() ? "the atrium"
                            : std::filesystem::path(options.scene).filename().string(),
      options.rounds);
  fmt::print(
      "| backend | median, s | least | most | load of the machine before, after |\n"
      "|---|---|---|---|---|\n");
  for (const std::string backend : {"opengl", "vulkan"}) {
    if (!options.backend.empty() && options.backend != backend) continue;
    firstPicture(backend, options.scene, folder.path());
    double before = 0, after = 0;
    getloadavg(&before, 1);
    std::vector<double> times;
    for (uint32_t i = 0; i < options.rounds; ++i) {
      times.push_back(firstPicture(backend, options.scene, folder.path()));
    }
    getloadavg(&after, 1);
    std::ranges::sort(times);
    fmt::print("| {} | {:.2f} | {:.2f} | {:.2f} | {:.1f}, {:.1f} |\n", backend,
               times[times.size() / 2], times.front(), times.back(), before, after);
  }
}

void run(const ViewOptions& options) {
  fmt::print("The panel at {}x{}, both effects unfolded, with the help; no device.\n\n", kWindow.x,
             kWindow.y);
  panelCost(options.rounds);
  fmt::print("\nA window in which nothing happens, {} s, share of one core:\n\n", kIdleSeconds);
  fmt::print("| backend | CPU |\n|---|---|\n");
  for (const char* backend : {"opengl", "vulkan"}) {
    if (options.backend.empty() || options.backend == backend) idleCost(backend);
  }
  firstPictures(options);
}

}  // namespace
}  // namespace grisaille::bench

int main(int argc, char** argv) {
  grisaille::bench::ViewOptions options;
  options.rounds = 5;
  CLI::App program("What the viewer costs besides the scene, as Markdown");
  program.add_option("--scene", options.scene, "Scene of the first picture; default: Sponza");
  return grisaille::bench::runCommand(program, options, argc, argv,
                                      [&] { grisaille::bench::run(options); });
}
