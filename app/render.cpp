// SPDX-License-Identifier: MIT
// grisaille render: renders a scene from one camera, at one time or at many, and writes pictures to
// files.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>

#include "app/command.h"
#include "app/options/driver_messages.h"
#include "app/options/effect_options.h"
#include "app/options/object_options.h"
#include "app/options/option_checks.h"
#include "app/options/output_file.h"
#include "app/options/scene_options.h"
#include "app/options/sequence.h"
#include "app/options/start_device.h"
#include "app/report/coverage.h"
#include "app/report/timings.h"
#include "app/services/scene_lengths.h"
#include "app/services/scene_services.h"
#include "app/truth/interruption.h"
#include "app/truth/progress.h"
#include "app/video.h"
#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/image/image.h"
#include "core/scene/camera_matrices.h"
#include "core/scene/camera_path.h"

namespace grisaille::app {
namespace {

struct RenderOptions : EffectOptions {
  SceneOptions view;
  std::string timings, coverage, times, path, video;
  double coverageSlope = 180;  // degrees
  ObjectOptions objects;
  uint32_t frames = 1;
  bool json = false;

  bool isSequence() const { return !times.empty() || !path.empty(); }
};

// One frame of a sequence.
struct SequenceFrame {
  scene::Camera camera;
  std::optional<double> seconds;  // of the animation; none: the scene keeps its pose
};

// The parsed command line, checked before any slow work starts.
struct RenderJob : ChosenEffects {
  std::vector<OutputFiles> outputs;
  std::vector<SequenceFrame> sequence;  // empty: one picture, of view.pose
  double rate = 24;                     // frames of the sequence a second
  SceneView view;

  std::optional<Owned> owned;  // what --coverage measures; none without --coverage

  explicit RenderJob(const RenderOptions& options) : ChosenEffects(options) {
    std::vector<double> times;
    if (!options.times.empty()) times = parseTimes(options.times);
    scene::CameraPath path;
    if (!options.path.empty()) path = scene::loadCameraPath(options.path);
    findOutputs(options);
    if (options.timings == "-" && options.coverage == "-") {
      throw Error(ErrorId::kUsage, "--timings and --coverage cannot both be standard output");
    }
    const size_t alongPath = path.keys.empty() ? 0 : path.frames;
    requireDistinctOutputs(options, times.empty() ? alongPath : times.size());
    for (const std::string& file : {options.timings, options.coverage}) {
      if (!file.empty() && file != "-") requireWritable(file);
    }
    if (!options.video.empty()) {
      if (!outputs.front().file.at(0).ends_with(".png")) {
        throw Error(ErrorId::kUsage, "--video needs .png files of the first output");
      }
      requireVideo(options.video);
      requireWritable(options.video);
    }
    for (const OutputFiles& output : outputs) {
      frame::checkOutput(output.output, chain.selection.effects());
    }
    options.objects.check(chain);
    SceneOptions first = options.view;
    if (!times.empty()) first.pose.time = times.front();
    if (!path.keys.empty()) first.camera = scene::cameraJson(path.keys.front());
    view = loadView(first);
    if (!times.empty()) requireWithin(view.scene, *view.pose.animation, times.back());
    setSequence(times, path);
    fitToScene(chain.selection, view.scene);
    view.takePose();
    if (options.coverage.empty()) return;
    owned = findOwned(chain.selection.effects());
    if (!owned) {
      throw Error(ErrorId::kEffectTakesNoObjects,
                  "--coverage needs an active effect whose objects have a colour and that draws on "
                  "surfaces");
    }
  }

 private:
  void findOutputs(const RenderOptions& options);
  void requireDistinctOutputs(const RenderOptions& options, size_t frames) const;
  void setSequence(const std::vector<double>& times, scene::CameraPath path);
};

// Along a path, the camera takes as many steps as there are times.
void RenderJob::setSequence(const std::vector<double>& times, scene::CameraPath path) {
  for (const double seconds : times) sequence.push_back({view.camera, seconds});
  if (times.size() > 1) {
    rate = static_cast<double>(times.size() - 1) / (times.back() - times.front());
  }
  if (path.keys.empty()) return;
  if (!times.empty()) path.frames = static_cast<uint32_t>(times.size());
  const std::vector<scene::Camera> cameras = scene::camerasOf(path);
  sequence.resize(cameras.size());
  for (size_t i = 0; i < cameras.size(); ++i) sequence[i].camera = cameras[i];
}

void RenderJob::findOutputs(const RenderOptions& options) {
  for (const OutputFile& write : parseOutputFiles(options.writes)) {
    outputs.push_back({write.output, FileName(write.file)});
    if (outputs.back().file.numbered() == options.isSequence()) continue;
    throw Error(ErrorId::kSequence, "'{}' {}", write.file,
                options.isSequence()
                    ? "has no frame number, but --times or --path writes a sequence"
                    : "has a frame number, but neither --times nor --path is given");
  }
  if (!outputs.empty()) return;
  const char* name = options.isSequence() ? "grisaille.####.png" : "grisaille.png";
  outputs.push_back({"color", FileName(name)});
}

// Compares the output files of all frames.
void RenderJob::requireDistinctOutputs(const RenderOptions& options, size_t frames) const {
  std::vector<NamedOutput> files = options.objects.outputs();
  if (options.timings != "-") files.push_back({"--timings " + options.timings, options.timings});
  if (!options.video.empty()) files.push_back({"--video " + options.video, options.video});
  const std::string& coverage = options.coverage;
  if (coverage != "-") files.push_back({"--coverage " + coverage, coverage});
  for (int i = 0; i < static_cast<int>(std::max(frames, size_t{1})); ++i) {
    for (const OutputFiles& output : outputs) {
      const std::string file = output.file.at(i);
      files.push_back({fmt::format("--write {}={}", output.output, file), file});
    }
  }
  requireDistinct(files);
}

// Messages go to standard error when a table goes to standard output.
std::FILE* notesOf(const RenderOptions& options) {
  return options.timings == "-" || options.coverage == "-" || options.json ? stderr : stdout;
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

void writeCoverage(const RenderOptions& options, RenderJob& job, SceneRays& rays) {
  const Coverage coverage =
      coverageOf(job.chain, *job.owned, rays, {.steepest = glm::radians(options.coverageSlope)});
  writeText(options.coverage, coverageCsv(coverage.shares));
  fmt::print(notesOf(options), "coverage of {:.6g} m2, at {} points\n", coverage.area,
             coverage.points);
}

// `number`: of the frame, for numbered files.
void writeOutputs(const RenderJob& job, int number, frame::Renderer& renderer) {
  for (const OutputFiles& output : job.outputs) {
    writeOutput(renderer.read(output.output),
                {.output = output.output, .file = output.file.at(number)},
                {.transfer = frame::transferOf(output.output),
                 .matrices = scene::matricesOf(job.view.camera, job.view.size.x, job.view.size.y)});
  }
}

// `frames`: number of frames that are written.
void printWritten(const RenderOptions& options, const RenderJob& job, int frames) {
  for (const OutputFiles& output : job.outputs) {
    const std::string first = output.file.at(0);
    const std::string last = frames > 1 ? " to " + output.file.at(frames - 1) : "";
    if (frames > 0) fmt::print(notesOf(options), "wrote {}{}\n", first, last);
  }
  const bool all = frames == static_cast<int>(job.sequence.size());
  if (!options.video.empty() && all) fmt::print(notesOf(options), "wrote {}\n", options.video);
}

bool hasObjects(const effect::Chain& chain) {
  return std::ranges::any_of(chain.objectLists(),
                             [](const auto& list) { return list.second.size() > 0; });
}

// Throws what an effect lacks that is on but cannot run.
void requireAll(const frame::Renderer& renderer) {
  if (!renderer.leftOut().empty()) throw Error(renderer.leftOut().front().lacks);
}

// Renders and writes one frame after another with one renderer, so that effects with a history find
// their frame before. A signal ends the sequence between two frames.
void renderSequence(const RenderOptions& options, RenderJob& job, frame::FrameDesc desc,
                    frame::Renderer& renderer) {
  const truth::Interruption interruption;
  const auto frames = static_cast<int>(job.sequence.size());
  int done = 0;
  {
    truth::Progress progress("render",
                             options.json ? truth::ProgressStyle::kJson : truth::usualProgress());
    for (; done < frames && !truth::Interruption::asked(); ++done) {
      const auto& [camera, seconds] = job.sequence[static_cast<size_t>(done)];
      const std::string at = seconds ? fmt::format(", {:.3f} s", *seconds) : "";
      progress.show({.done = static_cast<double>(done),
                     .total = static_cast<double>(frames),
                     .text = fmt::format("frame {} of {}{}", done + 1, frames, at)});
      if (seconds) {
        scene::pose(job.view.scene, {.animation = job.view.pose.animation, .seconds = *seconds});
      }
      job.view.camera = desc.camera = camera;
      renderer.render(desc);
      requireAll(renderer);
      writeOutputs(job, done, renderer);
    }
    if (done == frames && !options.video.empty()) {
      progress.show({.done = static_cast<double>(done),
                     .total = static_cast<double>(frames),
                     .text = "video by ffmpeg"});
      writeVideo({.files = job.outputs.front().file, .count = frames, .rate = job.rate},
                 options.video);
    }
  }
  printWritten(options, job, done);
  if (done == frames) return;
  fmt::print(stderr, "note: interrupted after {} of {} frames\n", done, frames);
  throw truth::Interrupted();
}

// Lets effects work on the objects that wait, and shows the progress. Frames of another size leave
// the histories of effects as they are.
void settleObjects(const frame::FrameDesc& desc, frame::Renderer& renderer) {
  if (!hasObjects(*desc.chain)) return;
  frame::FrameDesc small = desc;
  small.width = small.height = 16;
  small.patience = 0.5;
  truth::Progress progress("objects", truth::usualProgress());
  uint64_t most = 0, before = std::numeric_limits<uint64_t>::max();
  for (;;) {
    renderer.render(small);
    const uint64_t waiting = renderer.report().waiting;
    // Without rays, none of them ever gets its place.
    if (waiting == 0 || waiting >= before) return;
    before = waiting;
    most = std::max(most, waiting);
    progress.show({.done = static_cast<double>(most - waiting),
                   .total = static_cast<double>(most),
                   .text = fmt::format("{} wait", waiting)});
  }
}

void renderFrames(const RenderOptions& options, RenderJob& job, gpu::Device& device) {
  SceneServices services(job.view.scene);
  options.objects.apply(job.chain, job.view.camera, job.view.size, services.rays());
  const effect::StartedChain started(job.chain, device);
  std::vector<std::string> outputs;
  for (const OutputFiles& output : job.outputs) outputs.push_back(output.output);
  frame::Renderer renderer(device, job.view.scene);
  const frame::FrameDesc desc = {.camera = job.view.camera,
                                 .width = job.view.size.x,
                                 .height = job.view.size.y,
                                 .surface = job.surface,
                                 .background = job.background,
                                 .chain = &job.chain,
                                 .outputs = outputs,
                                 .services = services.all()};
  if (!job.sequence.empty()) {
    renderSequence(options, job, desc, renderer);
  } else {
    settleObjects(desc, renderer);
    if (!options.timings.empty()) device.takeTimes();  // those of its frames
    for (uint32_t i = 0; i < options.frames; ++i) renderer.render(desc);
    requireAll(renderer);
    writeOutputs(job, 0, renderer);
    printWritten(options, job, 1);
  }
  if (job.owned) writeCoverage(options, job, services.rays());
  options.objects.save(job.chain);
  // Without objects, effects wait for more frames, which a history improves.
  if (hasObjects(job.chain) && renderer.report().waiting > 0) {
    fmt::print(stderr, "warning: {} objects are not drawn: the rays that they need were not cast\n",
               renderer.report().waiting);
  }
  if (renderer.report().givenUp > 0) {
    fmt::print(stderr,
               "warning: the {} oldest objects are not drawn: the memory that their effect may use "
               "leaves no room for them; raise that limit, a parameter of the effect\n",
               renderer.report().givenUp);
  }
  if (renderer.report().coarser > 0) {
    fmt::print(stderr,
               "warning: {} old objects are drawn with coarser edges: the memory that their effect "
               "may use is nearly full; raise that limit, a parameter of the effect\n",
               renderer.report().coarser);
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
  options->addTo(*command,
                 "Output and its .exr or .png file. Outputs: color; depth, back_depth and "
                 "next_depth (metres, 0 = sky or none), thickness (metres, below 0 = unknown), "
                 "normal and facet_normal (world space), base_colour, motion (pixels since the "
                 "previous frame), and those of the effects; default: color=grisaille.png");
  CLI::Option* times =
      command
          ->add_option("--times", options->times,
                       "Render the animation at these times, LAST included; #### in a file name "
                       "stands for the frame number, from 0. STEP may be a fraction: 0:4:1/24")
          ->type_name("FIRST:LAST:STEP")
          ->excludes("--time");
  CLI::Option* path =
      command
          ->add_option("--path", options->path,
                       "Render along a camera path: JSON with \"cameras\" and \"frames\"; with "
                       "--times, as many frames as there are times")
          ->type_name("FILE")
          ->excludes("--camera");
  command
      ->add_option("--frames", options->frames,
                   "Number of frames to render; the last one is written")
      ->check(wholeNumberFrom(1, 1000000))
      ->excludes(times)
      ->excludes(path)
      ->capture_default_str();
  command
      ->add_option("--timings", options->timings,
                   "Write the time of every pass as CSV; -: to standard output")
      ->type_name("FILE.csv|-");
  options->objects.addTo(*command);
  command
      ->add_option(
          "--coverage", options->coverage,
          "Write as CSV which share of the scene's surface the objects of each colour cover; -: to "
          "standard output")
      ->type_name("FILE.csv|-")
      ->excludes(times)
      ->excludes(path);
  command
      ->add_option("--coverage-slope", options->coverageSlope,
                   "Only surfaces at most so many degrees from level count for --coverage: 45 for "
                   "floors and ramps, 180 for all")
      ->check(numberFrom(0, 180))
      ->needs("--coverage")
      ->capture_default_str();
  command
      ->add_option("--video", options->video,
                   "After a sequence, make a video of the .png files of the first output: runs "
                   "ffmpeg, which chooses the format by the ending; at the rate of --times, else "
                   "24 frames a second")
      ->type_name("FILE.mp4");
  command->add_flag("--json", options->json,
                    "Print the progress of a sequence as lines of JSON on standard output");
  command->callback([options] {
    if (!options->video.empty() && !options->isSequence()) {
      throw Error(ErrorId::kUsage, "--video needs --times or --path");
    }
    render(*options);
  });
}

}  // namespace grisaille::app
