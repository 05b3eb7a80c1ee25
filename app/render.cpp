// SPDX-License-Identifier: MIT
// grisaille render: renders a scene from one camera and writes pictures to files.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>

#include "app/command.h"
#include "app/options/driver_messages.h"
#include "app/options/effect_options.h"
#include "app/options/object_options.h"
#include "app/options/option_checks.h"
#include "app/options/output_file.h"
#include "app/options/scene_options.h"
#include "app/options/start_device.h"
#include "app/report/coverage.h"
#include "app/report/timings.h"
#include "app/services/scene_lengths.h"
#include "app/services/scene_services.h"
#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/image/image.h"
#include "core/scene/camera_matrices.h"

namespace grisaille::app {
namespace {

struct RenderOptions : EffectOptions {
  SceneOptions view;
  std::string timings, coverage;
  ObjectOptions objects;
  uint32_t frames = 1;
};

// The parsed command line, checked before any slow work starts.
struct RenderJob : ChosenEffects {
  std::vector<OutputFile> writes;
  SceneView view;

  // Outputs that --coverage reads; none without --coverage.
  std::optional<Owned> owned;

  explicit RenderJob(const RenderOptions& options)
      : ChosenEffects(options), writes(parseOutputFiles(options.writes)) {
    if (options.timings == "-" && options.coverage == "-") {
      throw Error(ErrorId::kUsage, "--timings and --coverage cannot both be standard output");
    }
    if (writes.empty()) writes.push_back({.output = "color", .file = "grisaille.png"});
    requireDistinctOutputs(options);
    for (const std::string& file : {options.timings, options.coverage}) {
      if (!file.empty() && file != "-") requireWritable(file);
    }
    for (const OutputFile& write : writes)
      frame::checkOutput(write.output, chain.selection.effects());
    options.objects.check(chain);
    view = loadView(options.view);
    fitToScene(chain.selection, view.scene);
    if (options.coverage.empty()) return;
    owned = findOwned(chain.selection.effects());
    if (!owned) {
      throw Error(ErrorId::kEffectTakesNoObjects,
                  "--coverage needs an active effect with an overlay, an owner output and objects "
                  "with a colour");
    }
  }

 private:
  void requireDistinctOutputs(const RenderOptions& options) const;
};

void RenderJob::requireDistinctOutputs(const RenderOptions& options) const {
  std::vector<NamedOutput> outputs = namedOutputs(writes);
  const std::vector<NamedOutput> saves = options.objects.outputs();
  outputs.insert(outputs.end(), saves.begin(), saves.end());
  if (options.timings != "-") outputs.push_back({"--timings " + options.timings, options.timings});
  const std::string& coverage = options.coverage;
  if (coverage != "-") outputs.push_back({"--coverage " + coverage, coverage});
  requireDistinct(outputs);
}

// Messages go to standard error when a table goes to standard output.
std::FILE* notesOf(const RenderOptions& options) {
  return options.timings == "-" || options.coverage == "-" ? stderr : stdout;
}

void writeText(const std::string& file, const std::string& text) {
  if (file == "-") {
    std::fputs(text.c_str(), stdout);
  } else {
    writeFileAtomically(file, text);
  }
}

void writeTimings(const RenderOptions& options, gpu::Device& device) {
  device.wait();
  const std::vector<gpu::FrameTimes> frames = device.takeTimes();
  writeText(options.timings, timingsCsv(frames, device.info().clock));
  const std::string doubt = timingsDoubt(frames);
  if (!doubt.empty()) fmt::print(stderr, "warning: {}\n", doubt);
}

void writeCoverage(const RenderOptions& options, RenderJob& job, frame::Renderer& renderer) {
  const auto shares =
      colorShares(renderer.read(job.owned->owner), renderer.read(job.owned->overlay),
                  renderer.read("depth"), renderer.read("facet_normal"), job.view.camera,
                  job.chain.objects(job.owned->effect)->view(), *job.owned->colour);
  writeText(options.coverage, coverageCsv(shares));
}

void writeOutputs(const RenderOptions& options, const RenderJob& job, frame::Renderer& renderer) {
  for (const OutputFile& write : job.writes) {
    writeOutput(renderer.read(write.output), write,
                {.transfer = frame::transferOf(write.output),
                 .matrices = scene::matricesOf(job.view.camera, job.view.size.x, job.view.size.y)});
    fmt::print(notesOf(options), "wrote {}\n", write.file);
  }
}

void renderFrames(const RenderOptions& options, RenderJob& job, gpu::Device& device) {
  SceneServices services(job.view.scene);
  options.objects.apply(job.chain, job.view.camera, job.view.size, services.rays());
  const effect::StartedChain started(job.chain, device);
  std::vector<std::string> outputs;
  for (const OutputFile& write : job.writes) outputs.push_back(write.output);
  if (job.owned) {
    outputs.insert(outputs.end(), {job.owned->owner, job.owned->overlay, "depth", "facet_normal"});
  }
  frame::Renderer renderer(device, job.view.scene);
  for (uint32_t i = 0; i < options.frames; ++i) {
    renderer.render({.camera = job.view.camera,
                     .width = job.view.size.x,
                     .height = job.view.size.y,
                     .surface = job.surface,
                     .background = job.background,
                     .chain = &job.chain,
                     .outputs = outputs,
                     .services = services.all()});
  }
  writeOutputs(options, job, renderer);
  if (job.owned) writeCoverage(options, job, renderer);
  options.objects.save(job.chain);
  if (renderer.waiting() > 0) {
    fmt::print(stderr, "warning: {} objects are not drawn: the rays that they need were not cast\n",
               renderer.waiting());
  }
}

void render(const RenderOptions& options) {
  RenderJob job(options);
  DriverMessages messages;
  {
    const auto device = startDevice(options.backend, {.device = options.device,
                                                      .check = options.check,
                                                      .timed = !options.timings.empty(),
                                                      .message = messages.sink()});
    printDevice(device->info(), notesOf(options));
    renderFrames(options, job, *device);
    if (!options.timings.empty()) writeTimings(options, *device);
  }
  if (options.check) messages.throwIfAny();
}

}  // namespace

void addRender(CLI::App& program) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = program.add_subcommand("render", "Render a scene to files");
  options->view.addTo(*command);
  options->addTo(
      *command,
      "Output and its .exr or .png file. Outputs: color, depth and back_depth (metres, 0 = sky), "
      "normal and facet_normal (world space), base_colour, and those of the effects; default: "
      "color=grisaille.png");
  command
      ->add_option("--frames", options->frames,
                   "Number of frames to render; the last one is written")
      ->check(wholeNumberFrom(1, 1000000))
      ->capture_default_str();
  command
      ->add_option("--timings", options->timings,
                   "Write the time of every pass as CSV; -: to standard output")
      ->type_name("FILE.csv|-");
  options->objects.addTo(*command);
  command
      ->add_option(
          "--coverage", options->coverage,
          "Write as CSV which share of the visible surface the objects of each colour cover; -: to "
          "standard output")
      ->type_name("FILE.csv|-");
  command->callback([options] { render(*options); });
}

}  // namespace grisaille::app
