// SPDX-License-Identifier: MIT
// Prints cost and error of SSAO as Markdown. Each setting runs right after the tutorial's,
// alternating in one process (A B A C A D ...), so that a slow phase of the machine affects both.
// Costs are medians of the layer's pass times; ratios are taken pair by pair.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <sstream>
#include <thread>

#include "app/settings/presets.h"
#include "backends/backends.h"
#include "core/base/error.h"
#include "core/effect/instance.h"
#include "core/effect/registry.h"
#include "core/effect/values.h"
#include "core/frame/renderer.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "core/trace/ray_tracer.h"
#include "tests/bench/command.h"
#include "tests/bench/subject.h"
#include "tests/bench/tutorial_ssao.h"

namespace grisaille::bench {
namespace {

using Clock = std::chrono::steady_clock;

struct Options : CommonOptions {
  Options() { rounds = 9; }
  uint32_t samples = 256;
  bool larger = false;
  std::string only;
  std::vector<std::string> settings;
};

struct Setting {
  std::string name;
  std::vector<std::pair<std::string, std::string>> values;
};

// Parses "KEY=VALUE KEY=VALUE ..." of the effect's parameters.
Setting parseSetting(const std::string& text) {
  Setting setting = {.name = text, .values = {}};
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const size_t at = word.find('=');
    setting.values.emplace_back(word.substr(0, at),
                                at == std::string::npos ? std::string() : word.substr(at + 1));
  }
  return setting;
}

// The requested settings. Without any: the presets and the classic estimator's settings with `only`
// in their names.
std::vector<Setting> settings(const Options& options, const effect::Effect& effect) {
  std::vector<Setting> all;
  for (const std::string& text : options.settings) all.push_back(parseSetting(text));
  if (!all.empty()) return all;
  for (const app::Preset& preset : app::loadPresets(effect).all) {
    Setting& setting = all.emplace_back(Setting{.name = "**" + preset.name + "**:", .values = {}});
    for (const auto& [key, value] : preset.values) {
      setting.name += " " + key + "=" + value;
      setting.values.emplace_back(key, value);
    }
  }
  const std::string classic = "estimator=classic intensity=2 blur_size=4 ";
  for (const char* taps : {"4", "8", "16", "32", "64", "128", "256"}) {
    all.push_back(parseSetting(classic + "kernel_size=" + taps));
  }
  all.push_back(parseSetting("estimator=classic kernel_size=64 blur_size=4"));
  for (const char* more : {"blur_size=0", "blur=edge_aware", "blur_size=8", "sampling=sphere"}) {
    all.push_back(parseSetting(classic + "kernel_size=64 " + more));
  }
  std::erase_if(all, [&](const Setting& setting) {
    return setting.name.find(options.only) == std::string::npos;
  });
  return all;
}

// Ray-traced truth at every tenth pixel in both directions, for one camera.
struct Truth {
  std::vector<trace::Hit> hits;
  std::vector<trace::Visibility> visibility;
};

Truth traceTruth(const Subject& subject, const scene::Camera& camera, const Options& options) {
  std::vector<glm::uvec2> pixels;
  for (uint32_t y = 5; y < options.height; y += 10) {
    for (uint32_t x = 5; x < options.width; x += 10) pixels.emplace_back(x, y);
  }
  const trace::RayTracer tracer(subject.scene, camera.eye);
  Truth truth;
  truth.hits = tracer.castPrimary(camera, options.width, options.height, pixels);
  truth.visibility = tracer.ambientOcclusion(truth.hits, 0.5, options.samples, 1);
  return truth;
}

double rmse(const image::Image& ao, const Truth& truth) {
  double squares = 0;
  size_t count = 0;
  for (size_t i = 0; i < truth.hits.size(); ++i) {
    if (std::isnan(truth.visibility[i].mean)) continue;
    const double off =
        ao.at(truth.hits[i].pixel.x, truth.hits[i].pixel.y) - truth.visibility[i].mean;
    squares += off * off;
    ++count;
  }
  return std::sqrt(squares / static_cast<double>(count));
}

// One backend's device with all settings to run on it.
class Bench {
 public:
  Bench(const std::string& backend, const Subject& subject, const effect::Registry& registry,
        const Options& options)
      : options_(options), subject_(subject) {
    const auto start = Clock::now();
    device_ = backends::create(backend, {.timed = true});
    tutorial_.emplace(*device_);
    const effect::Selection ssao(registry, std::array<std::string, 1>{"ssao"});
    chain_.selection = ssao;
    chain_.start(*device_);
    renderer_.emplace(*device_, subject.scene);
    for (const Setting& setting : settings(options, registry.find("ssao"))) {
      effect::Values& values = settings_.emplace_back(ssao).values("ssao");
      for (const auto& [key, value] : setting.values) values.set(key, value);
    }
    render(ssao, subject.cameras[0]);
    device_->wait();
    firstFrameSeconds_ = std::chrono::duration<double>(Clock::now() - start).count();
    drawTutorial(subject.cameras[0]);
    device_->wait();
    device_->takeTimes();
  }

  gpu::Device& device() { return *device_; }
  double firstFrameSeconds() const { return firstFrameSeconds_; }

  // Milliseconds of the effect's passes, plus what the effect adds to drawing the scene.
  double timeSetting(size_t setting) {
    render(settings_[setting], subject_.cameras[0]);
    const double guard = frame::guardShare(settings_[setting], options_.width, options_.height);
    return taken([&](const std::string& pass) {
      return pass.starts_with("ssao/") ? 1 : frame::shareForEffects(pass, guard);
    });
  }
  double timeTutorial() {
    drawTutorial(subject_.cameras[0]);
    return taken([](const std::string& pass) { return TutorialSsao::counts(pass) ? 1 : 0; });
  }

  image::Image ao(size_t setting, const scene::Camera& camera) {
    render(settings_[setting], camera);
    return renderer_->read("ao");
  }
  image::Image tutorialAo(const scene::Camera& camera) {
    render(settings_[0], camera);
    drawTutorial(camera);
    return tutorial_->read();
  }

 private:
  void render(const effect::Selection& setting, const scene::Camera& camera) {
    chain_.selection = setting;
    renderer_->render({.camera = camera,
                       .width = options_.width,
                       .height = options_.height,
                       .chain = &chain_,
                       .outputs = outputs_});
  }

  // Draws from the attachments of the last render().
  void drawTutorial(const scene::Camera& camera) {
    tutorial_->draw(*renderer_, camera, {options_.width, options_.height});
  }

  // Milliseconds of the last frame's passes, each weighted by `shareOf` its label.
  template <typename ShareOf>
  double taken(ShareOf&& shareOf) {
    device_->wait();
    double sum = 0;
    const std::vector<gpu::FrameTimes> frames = device_->takeTimes();
    for (const gpu::PassTime& pass : frames.back().passes) {
      sum += shareOf(pass.label) * pass.milliseconds;
    }
    return sum;
  }

  Options options_;
  const Subject& subject_;
  std::unique_ptr<gpu::Device> device_;
  std::optional<TutorialSsao> tutorial_;
  effect::Chain chain_;
  std::optional<frame::Renderer> renderer_;
  std::vector<effect::Selection> settings_;
  std::vector<std::string> outputs_ = {"ao", "depth", "normal"};
  double firstFrameSeconds_ = 0;
};

struct Row {
  std::string name;
  std::vector<double> milliseconds, ratios;
  double error = 0;
};

void printRows(const std::vector<Row>& rows) {
  fmt::print(
      "| setting | ms, median | ms, least to most | cost, tutorial = 1 | RMSE |\n"
      "|---|---|---|---|---|\n");
  for (const Row& row : rows) {
    const auto [least, most] =
        std::minmax_element(row.milliseconds.begin(), row.milliseconds.end());
    fmt::print("| {} | {:.2f} | {:.2f} to {:.2f} | {:.3f} | {:.4f} |\n", row.name,
               median(row.milliseconds), *least, *most, median(row.ratios), row.error);
  }
}

// Largest deviation of the classic estimator's costs from the straight line through 8 and 256 taps.
// In units of the tutorial's cost, which cancels slow phases of the machine.
void printLinearity(const std::vector<Row>& rows) {
  const auto cost = [&](int taps) {
    const std::string end = fmt::format(" kernel_size={}", taps);
    const auto row = std::find_if(rows.begin(), rows.end(),
                                  [&](const Row& one) { return one.name.ends_with(end); });
    return median(row->ratios);
  };
  const double slope = (cost(256) - cost(8)) / (256 - 8);
  double worst = 0;
  for (const int taps : {16, 32, 64, 128}) {
    worst = std::max(worst, std::abs(cost(taps) / (cost(8) + slope * (taps - 8)) - 1));
  }
  fmt::print(
      "\nClassic: a line through 8 and 256 taps misses no cost between by more than {:.0f} %.\n\n",
      worst * 100);
}

void runBackend(const std::string& backend, const Subject& subject,
                const std::vector<Truth>& truths, const effect::Registry& registry,
                const Options& options) {
  Bench bench(backend, subject, registry, options);
  const gpu::DeviceInfo& info = bench.device().info();
  const std::vector<Setting> all = settings(options, registry.find("ssao"));
  std::vector<Row> rows(all.size() + 1);
  rows[0].name = "the tutorial's way, 64 taps";
  for (uint32_t round = 0; round < options.rounds; ++round) {
    fmt::print(stderr, "{}: round {} of {}\n", backend, round + 1, options.rounds);
    for (size_t i = 0; i < all.size(); ++i) {
      const double tutorial = bench.timeTutorial();
      const double setting = bench.timeSetting(i);
      rows[0].milliseconds.push_back(tutorial);
      rows[0].ratios.push_back(1);
      rows[i + 1].name = all[i].name;
      rows[i + 1].milliseconds.push_back(setting);
      rows[i + 1].ratios.push_back(setting / tutorial);
    }
  }
  for (size_t c = 0; c < subject.cameras.size(); ++c) {
    const double share = 1.0 / static_cast<double>(subject.cameras.size());
    rows[0].error += share * rmse(bench.tutorialAo(subject.cameras[c]), truths[c]);
    for (size_t i = 0; i < all.size(); ++i) {
      rows[i + 1].error += share * rmse(bench.ao(i, subject.cameras[c]), truths[c]);
    }
  }
  fmt::print(
      "## {}: {}\n\nDriver: {}{}. Clock: {}. {} rounds. Loading the scene took {:.2f} s, "
      "device and first frame {:.2f} s more.\n\n",
      info.backend, info.name, info.driver, info.software ? " (software)" : "",
      gpu::clockName(info.clock), options.rounds, subject.loadSeconds, bench.firstFrameSeconds());
  printRows(rows);
  if (options.only.empty() && options.settings.empty()) printLinearity(rows);
}

// Cost of a setting at 1.5 times the width and height, alternating with its own size. Printed on
// its own line: only values of one run are comparable.
void runLarger(const std::string& backend, const Subject& subject, const effect::Registry& registry,
               const Options& options) {
  Options larger = options;
  larger.width = options.width * 3 / 2;
  larger.height = options.height * 3 / 2;
  Bench bench(backend, subject, registry, options), large(backend, subject, registry, larger);
  const double pixels = double{1} * larger.width * larger.height / options.width / options.height;
  fmt::print(
      "## {}: {}\n\n{} rounds, in turn. {:.2f} times the pixels.\n\n"
      "| setting | {}x{}, ms | {}x{}, ms | ratio, median | least to most "
      "|\n|---|---|---|---|---|\n",
      backend, bench.device().info().name, options.rounds, pixels, options.width, options.height,
      larger.width, larger.height);
  const std::vector<Setting> all = settings(options, registry.find("ssao"));
  for (size_t i = 0; i < all.size(); ++i) {
    std::vector<double> small, big, ratios;
    for (uint32_t round = 0; round <= options.rounds; ++round) {
      const double a = bench.timeSetting(i), b = large.timeSetting(i);
      if (round == 0) continue;  // creates the pipelines
      small.push_back(a);
      big.push_back(b);
      ratios.push_back(b / a);
    }
    fmt::print("| {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} to {:.2f} |\n", all[i].name, median(small),
               median(big), median(ratios), *std::ranges::min_element(ratios),
               *std::ranges::max_element(ratios));
  }
  fmt::print("\n");
}

// Runs on every available backend, or on the requested one.
template <typename F>
void onBackends(const Options& options, const F& work) {
  for (const backends::Backend& backend : backends::all()) {
    if (!options.backend.empty() && options.backend != backend.name) continue;
    try {
      work(backend.name);
    } catch (const Error& error) {
      if (error.id() != ErrorId::kBackendMissing && error.id() != ErrorId::kNoDevice) throw;
      fmt::print("## {}\n\nNot here: {}\n\n", backend.name, error.detail());
    }
  }
}

void run(const Options& options) {
  const Subject subject = loadSubject();
  effect::Registry registry;
  registry.scan(EFFECTS_FOLDER);
  if (options.larger) {
    fmt::print("# What SSAO costs in larger pictures\n\nOn {}.\n\n", subject.name);
    onBackends(options, [&](const char* name) { runLarger(name, subject, registry, options); });
    return;
  }
  std::vector<Truth> truths;
  for (const scene::Camera& camera : subject.cameras) {
    fmt::print(stderr, "tracing truth {} of {}\n", truths.size() + 1, subject.cameras.size());
    truths.push_back(traceTruth(subject, camera, options));
  }
  fmt::print(
      "# What SSAO costs and how wrong it is\n\nMade by `./dev bench` on {}, {}x{}, radius "
      "0.5 m, {} hardware threads.\n\n",
      subject.name, options.width, options.height, std::thread::hardware_concurrency());
  fmt::print(
      "Cost: the effect's passes on the first camera, and the share of drawing the scene that "
      "goes\n"
      "into a guard band. Tutorial: a fragment shader;\n"
      "view-space positions and normals in 16-bit float textures; 64 samples from a uniform "
      "array,\n"
      "each a full matrix product and a fetch; smooth range check; 4x4 box blur in a second pass.\n"
      "Error: root mean square against ray-traced visibility ({} cosine-weighted rays a pixel, "
      "every\n"
      "tenth pixel both ways), averaged over {} cameras.\n\n",
      options.samples, subject.cameras.size());
  onBackends(options,
             [&](const char* name) { runBackend(name, subject, truths, registry, options); });
}

}  // namespace
}  // namespace grisaille::bench

int main(int argc, char** argv) {
  grisaille::bench::Options options;
  CLI::App program("What SSAO costs and how wrong it is, as Markdown");
  program.add_option("--samples", options.samples, "Rays a pixel of the truth")
      ->check(CLI::Range(1u, 65536u));
  program.add_option("--setting", options.settings, "Measure these: \"KEY=VALUE KEY=VALUE\", ...");
  program.add_flag("--larger", options.larger,
                   "Costs alone, each in turn with 1.5 times the width and height");
  program.add_option("--only", options.only, "Settings whose name holds this");
  return grisaille::bench::runCommand(program, options, argc, argv,
                                      [&] { grisaille::bench::run(options); });
}
