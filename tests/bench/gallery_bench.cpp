// SPDX-License-Identifier: MIT
// Writes a page about the presets of ambient occlusion on a gallery of scenes: the error of each
// preset at each camera, its cost beside the tutorial's way on the same frame, and a picture of
// each scene beside its truth. The settings of a round run one after the other, so that a slow
// phase of the machine affects all; ratios are taken within a round.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>

#include "app/options/subject_options.h"
#include "app/settings/load_effects.h"
#include "app/settings/presets.h"
#include "app/study/gallery.h"
#include "app/study/measurer.h"
#include "app/truth/error_map.h"
#include "backends/backends.h"
#include "core/base/atomic_file.h"
#include "tests/bench/command.h"
#include "tests/bench/subject.h"
#include "tests/bench/tutorial_ssao.h"

namespace grisaille::bench {
namespace {

namespace fs = std::filesystem;
namespace study = app::study;

struct Options : CommonOptions {
  Options() { rounds = 3; }
  std::string gallery = SOURCE_FOLDER "/studies/gallery.toml";
  std::string scenes = SOURCE_FOLDER "/../shared/scenes";
  std::string out = "build/gallery";
  uint32_t samples = 128;
  bool pictures = true;
};

struct NamedSetting {
  std::string name;
  study::Setting values;
};

std::vector<NamedSetting> presetsOf(const effect::Effect& effect) {
  std::vector<NamedSetting> all;
  for (const app::Preset& preset : app::loadPresets(effect).all) {
    NamedSetting& setting = all.emplace_back(NamedSetting{.name = preset.name, .values = {}});
    effect::Values values(effect);
    for (const auto& [key, text] : preset.values) {
      values.set(key, text);
      effect::ParameterValue& one = setting.values.emplace_back();
      one.name.effect = effect.key();
      one.name.key = key;
      one.value = values.get(key);
    }
  }
  return all;
}

// The measurements of one setting at one camera.
struct Cell {
  double rmse = 0;
  std::vector<double> milliseconds, ratios;  // one per round; ratios: the tutorial's way = 1
};

// By setting ("tutorial" first), then by camera.
using Cells = std::vector<std::vector<Cell>>;

// The tutorial's way in one scene.
class Tutorial {
 public:
  Tutorial(const study::Subject& subject, gpu::Device& device, double radius)
      : subject_(subject),
        device_(device),
        radius_(radius),
        renderer_(device, *subject.scene),
        tutorial_(device) {}

  double cost(const scene::Camera& camera) {
    device_.wait();
    device_.takeTimes();
    draw(camera);
    device_.wait();
    double sum = 0;
    const std::vector<gpu::FrameTimes> frames = device_.takeTimes();
    for (const gpu::PassTime& pass : frames.back().passes) {
      if (TutorialSsao::counts(pass.label)) sum += pass.milliseconds;
    }
    return sum;
  }

  image::Image ao(const scene::Camera& camera) {
    draw(camera);
    return tutorial_.read();
  }

 private:
  void draw(const scene::Camera& camera) {
    const glm::uvec2 size = subject_.size;
    const std::vector<std::string> outputs = {"depth", "normal"};
    renderer_.render({.camera = camera, .width = size.x, .height = size.y, .outputs = outputs});
    tutorial_.draw(renderer_, camera, size, radius_);
  }

  const study::Subject& subject_;
  gpu::Device& device_;
  double radius_;
  frame::Renderer renderer_;
  TutorialSsao tutorial_;
};

// Grey or coloured, at half the size. Pixels that are not finite (sky) become white.
void paste(const image::Image& from, uint32_t left, image::Image& onto) {
  for (uint32_t y = 0; y < onto.height; ++y) {
    for (uint32_t x = 0; x < from.width / 2; ++x) {
      for (uint32_t c = 0; c < 3; ++c) {
        float sum = 0;
        for (uint32_t k = 0; k < 4; ++k) {
          const float value = from.at(2 * x + k % 2, 2 * y + k / 2, std::min(c, from.channels - 1));
          sum += std::isfinite(value) ? value : 1;
        }
        onto.pixels[(size_t{y} * onto.width + left + x) * 3 + c] = sum / 4;
      }
    }
  }
}

// The truth, the picture and the error, side by side at half size.
image::Image besideTruth(const image::Image& shown, const image::Image& truth) {
  const uint32_t width = shown.width / 2, height = shown.height / 2;
  image::Image all{width * 3, height, 3, std::vector<float>(size_t{width} * height * 9)};
  paste(truth, 0, all);
  paste(shown, width, all);
  paste(app::truth::errorMap(app::truth::errorsOf(shown, truth)), width * 2, all);
  return all;
}

double rmseOf(const image::Image& shown, const study::View& view) {
  const double rmse = image::compare(shown, view.truth).rmse;
  return std::sqrt(std::max(rmse * rmse - view.noise * view.noise, 0.0));
}

// Measures one scene on one device; writes the picture of `balanced` at its first camera.
Cells measureScene(const study::Subject& subject, double radius,
                   const std::vector<NamedSetting>& settings, gpu::Device& device, uint32_t rounds,
                   const std::string& picture) {
  Tutorial tutorial(subject, device, radius);
  study::Measurer measurer(subject, device);
  Cells cells(settings.size() + 1, std::vector<Cell>(subject.views.size()));
  const auto chain = measurer.start(settings[0].values);
  const auto seen = [&](const study::View& view, const image::Image& shown) {
    if (&view != &subject.views.front()) return;
    const std::vector<std::byte> jpeg = image::encodeJpeg(besideTruth(shown, view.truth), 85);
    writeFileAtomically(picture, {reinterpret_cast<const char*>(jpeg.data()), jpeg.size()});
  };
  for (size_t v = 0; v < subject.views.size(); ++v) {
    cells[0][v].rmse = rmseOf(tutorial.ao(subject.views[v].camera), subject.views[v]);
  }
  for (size_t s = 0; s < settings.size(); ++s) {
    measurer.apply(settings[s].values, *chain);
    const bool shows = settings[s].name == "balanced" && !picture.empty();
    const auto errors = measurer.errors(*chain, shows ? seen : study::Measurer::Seen());
    for (size_t v = 0; v < errors.size(); ++v) cells[s + 1][v].rmse = errors[v].rmse;
  }
  for (uint32_t round = 0; round < rounds; ++round) {
    for (size_t v = 0; v < subject.views.size(); ++v) {
      cells[0][v].milliseconds.push_back(tutorial.cost(subject.views[v].camera));
      cells[0][v].ratios.push_back(1);
    }
    for (size_t s = 0; s < settings.size(); ++s) {
      measurer.apply(settings[s].values, *chain);
      const std::vector<double> costs = measurer.costs(*chain);
      for (size_t v = 0; v < costs.size(); ++v) {
        cells[s + 1][v].milliseconds.push_back(costs[v]);
        cells[s + 1][v].ratios.push_back(costs[v] / cells[0][v].milliseconds.back());
      }
    }
  }
  return cells;
}

// One camera's measurements.
struct Row {
  std::string scene, camera;
  std::vector<Cell> cells;  // by setting, "tutorial" first
};

double costOf(const Cell& cell) {
  return median(cell.milliseconds);
}

double ratioOf(const Cell& cell) {
  return median(cell.ratios);
}

double errorOf(const Cell& cell) {
  return cell.rmse;
}

// A line per camera, and the mean of all, with `valueOf` of each setting from `first` on.
std::string tableOf(const std::vector<Row>& rows, const std::vector<std::string>& names,
                    size_t first, int digits, double (*valueOf)(const Cell&)) {
  std::string text = "| scene | camera |", line = "\n|---|---|";
  std::vector<double> sums(names.size());
  for (size_t s = first; s < names.size(); ++s) {
    text += " " + names[s] + " |";
    line += "---|";
  }
  text += line + "\n";
  for (const Row& row : rows) {
    text += fmt::format("| {} | {} |", row.scene, row.camera);
    for (size_t s = first; s < names.size(); ++s) {
      const double value = valueOf(row.cells[s]);
      sums[s] += value;
      text += fmt::format(" {:.{}f} |", value, digits);
    }
    text += "\n";
  }
  text += "| **mean** | |";
  for (size_t s = first; s < names.size(); ++s) {
    text += fmt::format(" {:.{}f} |", sums[s] / static_cast<double>(rows.size()), digits);
  }
  return text + "\n";
}

// The largest amount by which a dearer preset errs more than a cheaper one at a camera, and where.
std::string worstOf(const std::vector<Row>& rows, const std::vector<std::string>& names) {
  double worst = -1;
  std::string where;
  for (const Row& row : rows) {
    for (size_t dear = 2; dear < row.cells.size() && names[dear] != "classic"; ++dear) {
      for (size_t cheap = 1; cheap < dear; ++cheap) {
        const double loss = row.cells[dear].rmse - row.cells[cheap].rmse;
        if (loss <= worst) continue;
        worst = loss;
        where = fmt::format("`{}` against `{}` at {}", names[dear], names[cheap], row.camera);
      }
    }
  }
  return fmt::format("The most that a dearer preset errs above a cheaper one: {:.4f} ({}).\n",
                     worst, where);
}

class Page {
 public:
  explicit Page(const Options& options) : options_(options) {
    const std::shared_ptr<const effect::Registry> registry = app::loadEffects({});
    settings_ = presetsOf(registry->find("ssao"));
    names_ = {"tutorial"};
    for (const NamedSetting& setting : settings_) names_.push_back(setting.name);
    for (study::GalleryScene& scene : study::loadGallery(options.gallery, options.scenes)) {
      const app::SubjectOptions own{.scene = scene.scene,
                                    .size = fmt::format("{}x{}", options.width, options.height),
                                    .output = "ssao.ao",
                                    .name = scene.name,
                                    .config = {},
                                    .presets = {},
                                    .cameras = scene.cameras,
                                    .references = {},
                                    .loads = {},
                                    .sets = scene.sets,
                                    .effects = {"ssao"},
                                    .pluginPaths = {},
                                    .pose = {},
                                    .radius = scene.radius,
                                    .samples = options.samples};
      subjects_.push_back(std::make_unique<app::LoadedSubject>(
          own, registry, std::vector<effect::ParameterName>{}));
    }
  }

  void write() {
    for (const auto& subject : subjects_) {
      subject->loadScene();
      subject->trace();
    }
    const fs::path out = options_.out;
    fs::create_directories(options_.pictures ? out / "pictures/gallery" : out);
    std::string text = introduction();
    for (const char* backend : {"opengl", "vulkan"}) {
      if (options_.backend.empty() || options_.backend == backend) text += sectionOf(backend);
    }
    writeFileAtomically(out / "gallery.md", text + pictures_);
  }

 private:
  std::string introduction() const {
    return fmt::format(
        "# The presets on a gallery of scenes\n\n"
        "`./dev bench gallery --out docs` wrote this page: {}x{} pixels, the scenes of "
        "[studies/gallery.toml](../studies/gallery.toml), each at its own radius; {} rays a pixel; "
        "{} rounds.\n\n"
        "Error: RMSE against ray-traced visibility, without the truth's noise. Cost: the effect's "
        "passes and its share of drawing the scene. Tutorial: SSAO as tutorials teach it, with 64 "
        "taps and a 4x4 blur, at the scene's radius. [Studies](../studies/README.md) tells how the "
        "presets were chosen.\n\n",
        options_.width, options_.height, options_.samples, options_.rounds);
  }

  std::string sectionOf(const std::string& backend) {
    const auto device = backends::create(backend, {.timed = true});
    std::vector<Row> rows;
    const bool first = options_.pictures && pictures_.empty();
    for (const auto& loaded : subjects_) {
      const study::Subject& subject = loaded->subject();
      const std::string scene = subject.views.front().scene;
      const std::string picture = "pictures/gallery/" + scene + ".jpg";
      fmt::print(stderr, "{}: {}\n", backend, scene);
      Cells cells = measureScene(subject, loaded->radius(), settings_, *device, options_.rounds,
                                 first ? (fs::path(options_.out) / picture).string() : "");
      for (size_t v = 0; v < subject.views.size(); ++v) {
        Row& row = rows.emplace_back(Row{scene, subject.views[v].name, {}});
        for (const std::vector<Cell>& setting : cells) row.cells.push_back(setting[v]);
      }
      if (!first) continue;
      pictures_ += fmt::format("## {}, radius {} m\n\n![{}: rays, balanced, difference]({})\n\n",
                               scene, loaded->radius(), subject.views.front().name, picture);
    }
    if (first) {
      pictures_ =
          "# Pictures\n\nRays, the preset `balanced`, and the difference (blue: too dark, orange: "
          "too "
          "bright, full colour at 0.25), at each scene's first camera, at half the size.\n\n" +
          pictures_;
    }
    const gpu::DeviceInfo& info = device->info();
    return fmt::format(
        "# {}: {}\n\nDriver: {}. Clock: {}.\n\n## Error\n\n{}\n{}\n## Cost, the tutorial's way on "
        "the same "
        "frame = 1\n\n{}\n## Cost, milliseconds\n\n{}\n",
        info.backend, info.name, info.driver, gpu::clockName(info.clock),
        tableOf(rows, names_, 0, 4, errorOf), worstOf(rows, names_),
        tableOf(rows, names_, 1, 3, ratioOf), tableOf(rows, names_, 0, 1, costOf));
  }

  const Options& options_;
  std::vector<NamedSetting> settings_;
  std::vector<std::string> names_;
  std::vector<std::unique_ptr<app::LoadedSubject>> subjects_;
  std::string pictures_;  // the page's last part
};

}  // namespace
}  // namespace grisaille::bench

int main(int argc, char** argv) {
  grisaille::bench::Options options;
  CLI::App program("The presets of ambient occlusion on a gallery of scenes, as a page");
  program.add_option("--gallery", options.gallery, "A gallery file, see `grisaille measure`");
  program.add_option("--scenes", options.scenes, "Folder of scenes beside the gallery's own");
  program.add_option("--out", options.out, "Folder of gallery.md and its pictures");
  program.add_flag("!--no-pictures", options.pictures, "Tables alone");
  program.add_option("--samples", options.samples, "Rays a pixel of the truth")
      ->check(CLI::Range(16u, 65536u));
  return grisaille::bench::runCommand(program, options, argc, argv,
                                      [&] { grisaille::bench::Page(options).write(); });
}
