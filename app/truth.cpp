// SPDX-License-Identifier: MIT
// grisaille truth: traces the reference that effects are measured against.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "app/command.h"
#include "app/options/option_checks.h"
#include "app/options/output_file.h"
#include "app/options/scene_options.h"
#include "app/services/scene_lengths.h"
#include "app/truth/content_hash.h"
#include "app/truth/occlusion_truth.h"
#include "app/truth/progress.h"
#include "app/truth/refine.h"
#include "core/base/error.h"
#include "core/image/image.h"
#include "core/scene/camera.h"
#include "core/trace/depth_field.h"

namespace grisaille::app {
namespace {

constexpr double kFarthest = 1e6;

struct TruthOptions {
  SceneOptions view;
  std::vector<std::string> writes;
  std::optional<double> radius;
  double error = 0;
  double thickness = 0;  // 0: not given
  uint32_t samples = 1024, seed = truth::kSeed;
  bool noCache = false, progress = false;
};

OutputFile parseWrite(const std::string& text) {
  constexpr std::array kOutputs = {"ao", "ao_error", "ceiling", "ceiling_error", "depth", "normal"};
  OutputFile write = parseOutputFile(text);
  if (std::ranges::find(kOutputs, write.output) == kOutputs.end()) {
    throw Error(ErrorId::kTruthUnknown, "'{}' is not an output of truth", write.output);
  }
  image::checkWritable(write.file);
  return write;
}

void requireLength(const char* option, double metres) {
  if (!(metres > 0 && metres <= kFarthest)) {
    throw Error(ErrorId::kUsage, "{} is {:g}; give a length in metres, over 0 and up to {:g}",
                option, metres, kFarthest);
  }
}

// The parsed command line, checked before any slow work starts.
struct TruthJob {
  std::vector<OutputFile> writes;
  double radius, thickness;
  SceneView view;

  explicit TruthJob(const TruthOptions& options)
      : radius(options.radius.value_or(0)), thickness(options.thickness) {
    for (const std::string& text : options.writes) writes.push_back(parseWrite(text));
    requireDistinct(namedOutputs(writes));
    if (options.radius) requireLength("--radius", *options.radius);
    if (!(options.error >= 0 && std::isfinite(options.error))) {
      throw Error(ErrorId::kUsage, "--error is {:g}; give a finite number of 0 or more",
                  options.error);
    }
    checkUse("--thickness", options.thickness != 0, "ceiling");
    if (options.thickness != 0) requireLength("--thickness", options.thickness);
    view = loadView(options.view);
    if (!options.radius) chooseRadius();
    view.takePose();
    if (thickness == 0) thickness = radius / 5;
  }

  bool wants(std::string_view output) const {
    return std::ranges::any_of(writes, [&](const OutputFile& w) { return w.output == output; });
  }

 private:
  void chooseRadius() {
    radius = suitableRadius(view.scene);
    printChosen({}, radius, "the scene");
  }

  void checkUse(const char* option, bool given, std::string_view output) const {
    if (given && !wants(output) && !wants(fmt::format("{}_error", output))) {
      throw Error(ErrorId::kUsage, "{} is given, but no {} is written", option, output);
    }
  }
};

class Truth {
 public:
  Truth(const TruthOptions& options, const TruthJob& job)
      : options_(options), job_(job), tracer_(job.view.scene, job.view.camera.eye) {
    hits_ = tracer_.castPrimary(job.view.camera, job.view.size.x, job.view.size.y);
  }

  // Does all slow work. No file is written before it ends.
  void trace() {
    if (job_.wants("ao") || job_.wants("ao_error")) {
      ao_ = refine("ao", "", [this](auto hits, uint32_t from, uint32_t to, auto counts) {
        tracer_.addOcclusion(hits, job_.radius, options_.seed, from, to, counts);
      });
    }
    if (job_.wants("ceiling") || job_.wants("ceiling_error")) {
      const trace::DepthField field(hits_, job_.view.camera, job_.view.size.x, job_.view.size.y);
      const std::string more = fmt::format("thickness {}\n", job_.thickness);
      ceiling_ = refine("ceiling", more, [&](auto hits, uint32_t from, uint32_t to, auto counts) {
        field.addOcclusion(hits, job_.radius, job_.thickness, options_.seed, from, to, counts);
      });
    }
  }

  image::Image image(std::string_view output) const {
    const auto [width, height] = std::pair(job_.view.size.x, job_.view.size.y);
    if (output == "depth") return trace::depthImage(hits_, width, height);
    if (output == "normal") return trace::normalImage(hits_, width, height);
    if (output == "ao") return trace::visibilityImage(ao_->values, width, height);
    if (output == "ao_error") return trace::standardErrorImage(ao_->values, width, height);
    if (output == "ceiling") return trace::visibilityImage(ceiling_->values, width, height);
    if (output == "ceiling_error") {
      return trace::standardErrorImage(ceiling_->values, width, height);
    }
    throw Error(ErrorId::kTruthUnknown, "'{}' is not an output of truth", output);
  }

  void summarise() const {
    if (ao_) fmt::print("{}\n", truth::summaryOf("ao", *ao_));
    if (ceiling_) fmt::print("{}\n", truth::summaryOf("ceiling", *ceiling_));
  }

 private:
  truth::Estimate refine(const std::string& name, const std::string& more,
                         const truth::AddRays& addRays) {
    scene::Camera camera = job_.view.camera;
    camera.size = job_.view.size;
    const std::string key =
        truth::keyOf(name, truth::hashOf(job_.view.scene), camera, job_.radius, options_.seed) +
        more;
    truth::Cache cache(options_.noCache ? std::filesystem::path() : truth::cacheFolder(), key);
    return truth::refine(name, hits_, addRays,
                         {.samples = options_.samples, .error = options_.error}, cache,
                         options_.progress ? truth::ProgressStyle::kBar : truth::usualProgress());
  }

  const TruthOptions& options_;
  const TruthJob& job_;
  trace::RayTracer tracer_;
  std::vector<trace::Hit> hits_;
  std::optional<truth::Estimate> ao_, ceiling_;
};

void writeTruth(const TruthOptions& options) {
  const TruthJob job(options);
  Truth truth(options, job);
  truth.trace();
  for (const OutputFile& write : job.writes) {
    const auto transfer =
        write.output == "normal" ? image::Transfer::kSigned : image::Transfer::kData;
    image::write(truth.image(write.output), write.file, {.transfer = transfer});
    fmt::print("wrote {}\n", write.file);
  }
  truth.summarise();
}

void addOutputs(CLI::App& command, TruthOptions& options) {
  command
      .add_option(
          "--write", options.writes,
          "Output and its .exr or .png file. Outputs: ao, ceiling (the best ao that a depth "
          "buffer allows), ao_error and ceiling_error (their standard errors), depth "
          "(metres, 0 = sky), normal (world space)")
      ->type_name("NAME=FILE")
      ->required()
      ->allow_extra_args(false);
  command
      .add_option("--thickness", options.thickness,
                  "Thickness of the visible surface for the ceiling, metres; default: a fifth of "
                  "the radius")
      ->type_name("T");
}

}  // namespace

void addTruth(CLI::App& program) {
  auto options = std::make_shared<TruthOptions>();
  CLI::App* command =
      program.add_subcommand("truth", "Ray trace the reference that effects are measured against");
  options->view.addTo(*command);
  command
      ->add_option("--radius", options->radius,
                   "Length of occlusion rays, metres; default: chosen for the scene")
      ->type_name("R");
  command->add_option("--samples", options->samples, "Largest number of occlusion rays per pixel")
      ->check(wholeNumberFrom(16, trace::kMostOcclusionRays))
      ->capture_default_str();
  command
      ->add_option("--error", options->error,
                   "Stop early when the picture's rms standard error is at most this; 0: never")
      ->type_name("E")
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Seed of the sample points")->capture_default_str();
  addOutputs(*command, *options);
  command->add_flag("--no-cache", options->noCache,
                    "Neither read nor write the cache of traced rays");
  command->add_flag("--progress", options->progress,
                    "Draw the progress bar even if standard error is not a terminal");
  command->callback([options] { writeTruth(*options); });
}

}  // namespace grisaille::app
