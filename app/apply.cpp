// SPDX-License-Identifier: MIT
// grisaille apply: runs effects on pictures of another renderer, one frame or a numbered sequence.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include "app/apply/channels.h"
#include "app/apply/normal_checks.h"
#include "app/apply/picture_checks.h"
#include "app/command.h"
#include "app/options/camera_option.h"
#include "app/options/driver_messages.h"
#include "app/options/effect_options.h"
#include "app/options/option_checks.h"
#include "app/options/output_file.h"
#include "app/options/sequence.h"
#include "app/options/start_device.h"
#include "app/services/scene_lengths.h"
#include "app/truth/progress.h"
#include "core/base/error.h"
#include "core/frame/picture_attachments.h"
#include "core/frame/picture_depth.h"
#include "core/scene/camera_matrices.h"

namespace grisaille::app {
namespace {

struct ApplyOptions : EffectOptions {
  std::string depth, normal, baseColour, thickness, camera, frames;
  std::string depthKind = "view", depthChannel, normalChannels, normalSpace = "world",
              normalEncoding = "signed";
  // Metres. A near plane of 0 stands for the camera's.
  double near = 0, far = std::numeric_limits<double>::infinity();
};

frame::DepthKind kindOf(const std::string& name) {
  if (name == "clip") return frame::DepthKind::kClip;
  if (name == "clip-reversed") return frame::DepthKind::kClipReversed;
  return name == "distance" ? frame::DepthKind::kDistance : frame::DepthKind::kView;
}

// The parsed command line, checked before any slow work starts.
struct ApplyJob : ChosenEffects {
  const ApplyOptions& options;
  FileName depth, normal, baseColour, thickness, camera;
  std::vector<OutputFiles> outputs;
  std::vector<int> frames;  // frame numbers; {0} if the file names are not numbered

  explicit ApplyJob(const ApplyOptions& given)
      : ChosenEffects(given),
        options(given),
        depth(given.depth),
        normal(given.normal),
        baseColour(given.baseColour),
        thickness(given.thickness),
        camera(isInlineCamera(given.camera) ? "" : given.camera) {
    const auto writes = parseOutputFiles(options.writes);
    for (const OutputFile& write : writes) outputs.push_back({write.output, FileName(write.file)});
    if (!(options.far > std::max(options.near, 0.0))) {
      throw Error(ErrorId::kUsage, "--far {} is not greater than --near {}", options.far,
                  options.near);
    }
    for (const OutputFiles& output : outputs) {
      frame::checkOutput(output.output, chain.selection.effects());
    }
    findFrames();
    requireDistinctOutputs();
  }

  scene::Camera cameraOf(int number, const image::Picture& depthPicture, Warnings& warnings) const;

 private:
  void findFrames();
  void requireDistinctOutputs() const;
};

// Compares the output files of all frames.
void ApplyJob::requireDistinctOutputs() const {
  std::vector<NamedOutput> all;
  for (const int number : frames) {
    for (const OutputFiles& output : outputs) {
      const std::string file = output.file.at(number);
      all.push_back({fmt::format("--write {}={}", output.output, file), file});
    }
  }
  requireDistinct(all);
}

// Lists the frames, and checks that every file of every frame exists before work starts.
void ApplyJob::findFrames() {
  const bool sequence = depth.numbered();
  for (const OutputFiles& output : outputs) {
    if (output.file.numbered() != sequence) {
      throw Error(ErrorId::kSequence, "'{}' {}", output.file.at(0),
                  sequence ? "has no frame number, but --depth is a numbered sequence"
                           : "has a frame number, but --depth is a single file");
    }
  }
  if (!sequence && !options.frames.empty()) {
    throw Error(ErrorId::kSequence, "--frames needs a numbered --depth, but '{}' is a single file",
                options.depth);
  }
  frames = !sequence                ? std::vector<int>{0}
           : options.frames.empty() ? depth.numbers()
                                    : parseFrames(options.frames);
  for (const FileName* file : {&depth, &normal, &baseColour, &thickness, &camera}) {
    if (file->numbered() && !sequence) {
      throw Error(ErrorId::kSequence, "'{}' has a frame number, but --depth is a single file",
                  file->at(frames[0]));
    }
    for (const int number : frames) {
      const std::string path = file->at(number);
      std::error_code failed;
      if (!file->numbered() || std::filesystem::exists(path, failed)) continue;
      throw Error(ErrorId::kSequence, "frame {} lacks the file '{}'", number, path);
    }
  }
}

// The camera of --camera or, without that option, of the matrices in the depth's file.
scene::Camera ApplyJob::cameraOf(int number, const image::Picture& picture,
                                 Warnings& warnings) const {
  scene::Camera result;
  if (isInlineCamera(options.camera)) {
    result = scene::parseCamera(options.camera, "--camera");
  } else if (!options.camera.empty()) {
    result = scene::loadCamera(camera.at(number));
  } else if (picture.matrices) {
    result = scene::cameraOf(*picture.matrices, picture.image.width, picture.image.height,
                             depth.at(number));
  } else {
    throw Error(ErrorId::kPictureCamera, "{}: the file holds no camera, and --camera is not given",
                depth.at(number));
  }
  const bool buffer = options.depthKind.starts_with("clip");
  if (buffer && options.near <= 0 && options.camera.empty()) {
    throw Error(ErrorId::kUsage, "--depth-kind {} needs a near plane; pass --near or --camera",
                options.depthKind);
  }
  if (options.near > 0) result.nearPlane = options.near;
  if (result.orthographicHeight > 0) {
    if (buffer && std::isinf(options.far) && options.camera.empty()) {
      throw Error(ErrorId::kUsage,
                  "--depth-kind {} needs a far plane for an orthographic camera; pass --far or "
                  "--camera",
                  options.depthKind);
    }
    if (buffer && !std::isinf(options.far)) result.farPlane = options.far;
    if (!(result.farPlane > result.nearPlane)) {
      throw Error(ErrorId::kUsage, "the near plane is at {} m, beyond the far plane at {} m",
                  result.nearPlane, result.farPlane);
    }
  }
  if (!options.camera.empty()) checkCamera(result, picture, depth.at(number), warnings);
  return result;
}

struct LoadedFrame {
  scene::Camera camera;
  frame::Pictures pictures;
};

// Moves the planes of an orthographic camera so that all surfaces lie between them: depth pictures
// in metres have no planes, and surfaces beyond the planes would be sky.
void includeSurfaces(scene::Camera& camera, const image::Image& viewDepth) {
  if (!(camera.orthographicHeight > 0)) return;
  for (const float depth : viewDepth.pixels) {
    if (!(depth > 0)) continue;
    camera.nearPlane = std::min(camera.nearPlane, double{depth} / 2);
    camera.farPlane = std::max(camera.farPlane, double{depth} * 2);
  }
}

LoadedFrame load(const ApplyJob& job, int number, Warnings& warnings) {
  const ApplyOptions& options = job.options;
  const std::string depthFile = job.depth.at(number), normalFile = job.normal.at(number);
  const image::Picture depth = image::readPicture(depthFile);
  LoadedFrame loaded{.camera = job.cameraOf(number, depth, warnings), .pictures = {}};
  const image::Image stored = depthChannel(depth, options.depthChannel, depthFile);
  const DepthSource source{
      .stored = stored, .integers = depth.integers, .kind = options.depthKind, .file = depthFile};
  frame::Pictures& pictures = loaded.pictures;
  checkStoredDepth(source);
  const bool planes = options.depthKind.starts_with("clip") && loaded.camera.orthographicHeight > 0;
  pictures.viewDepth = frame::viewDepthOf(stored,
                                          {.kind = kindOf(options.depthKind),
                                           .near = loaded.camera.nearPlane,
                                           .far = planes ? loaded.camera.farPlane : options.far},
                                          loaded.camera, depthFile);
  if (!planes) includeSurfaces(loaded.camera, pictures.viewDepth);
  if (!options.normal.empty()) {
    pictures.normal =
        normalChannels(image::readPicture(normalFile), options.normalChannels, normalFile);
  }
  if (!options.baseColour.empty()) {
    const std::string file = job.baseColour.at(number);
    pictures.baseColour = colourChannels(image::readPicture(file), file);
    checkBaseColour(pictures.baseColour, file, warnings);
  }
  if (!options.thickness.empty()) {
    const std::string file = job.thickness.at(number);
    pictures.thickness = thicknessChannel(image::readPicture(file), file);
  }
  frame::checkPictures(pictures);
  const Surfaces surfaces{.viewDepth = pictures.viewDepth, .camera = loaded.camera};
  checkViewDepth(source, surfaces, warnings);
  if (options.normal.empty()) return loaded;
  takeNormals(pictures.normal,
              {.view = options.normalSpace == "view",
               .unsignedCodes = options.normalEncoding == "unsigned"},
              surfaces, normalFile, warnings);
  return loaded;
}

void writeOutputs(const ApplyJob& job, int number, const scene::Camera& camera,
                  frame::Renderer& renderer) {
  for (const OutputFiles& output : job.outputs) {
    const image::Image picture = renderer.read(output.output);
    writeOutput(picture, {.output = output.output, .file = output.file.at(number)},
                {.transfer = frame::transferOf(output.output),
                 .matrices = scene::matricesOf(camera, picture.width, picture.height)});
  }
}

void applyFrames(ApplyJob& job, LoadedFrame loaded, Warnings& warnings, gpu::Device& device) {
  const effect::StartedChain started(job.chain, device);
  std::vector<std::string> names;
  for (const OutputFiles& output : job.outputs) names.push_back(output.output);
  frame::PictureAttachments source(&device);
  frame::Renderer renderer(device, source);
  {
    truth::Progress progress(
        "apply", job.frames.size() > 1 ? truth::usualProgress() : truth::ProgressStyle::kNone);
    size_t done = 0;
    for (const int number : job.frames) {
      progress.show({.done = static_cast<double>(done++),
                     .total = static_cast<double>(job.frames.size()),
                     .text = fmt::format("frame {}, {} of {}", number, done, job.frames.size())});
      if (done > 1) loaded = load(job, number, warnings);
      source.show(std::move(loaded.pictures));
      renderer.render({.camera = loaded.camera,
                       .width = source.width(),
                       .height = source.height(),
                       .surface = job.surface,
                       .background = job.background,
                       .chain = &job.chain,
                       .outputs = names});
      if (!renderer.leftOut().empty()) throw Error(renderer.leftOut().front().lacks);
      writeOutputs(job, number, loaded.camera, renderer);
    }
  }
  for (const OutputFiles& output : job.outputs) {
    const std::string first = output.file.at(job.frames.front());
    if (job.frames.size() == 1) {
      fmt::print("wrote {}\n", first);
    } else {
      fmt::print("wrote {} to {}\n", first, output.file.at(job.frames.back()));
    }
  }
}

void apply(const ApplyOptions& options) {
  ApplyJob job(options);
  Warnings warnings;
  LoadedFrame first = load(job, job.frames.front(), warnings);  // fails before the device starts
  fitToDepth(job.chain.selection, first.pictures.viewDepth, first.camera);
  DriverMessages messages;
  {
    const auto device =
        startDevice(options.backend,
                    {.device = options.device, .check = options.check, .message = messages.sink()});
    printDevice(device->info());
    applyFrames(job, std::move(first), warnings, *device);
  }
  if (options.check) messages.throwIfAny();
}

void addPictures(CLI::App& command, ApplyOptions& options) {
  command
      .add_option("--depth", options.depth,
                  "Depth picture, .exr; %04d or #### in a file name stands for the frame number")
      ->required()
      ->type_name("FILE");
  command
      .add_option("--normal", options.normal,
                  "Normals; default: the normals of the facets that the depth shows")
      ->type_name("FILE");
  command
      .add_option("--base-colour", options.baseColour,
                  "Base colours, linear, 0 to 1, for --surface base")
      ->type_name("FILE");
  command
      .add_option("--thickness", options.thickness,
                  "How thick the matter behind each surface is on average, metres: 0 for sheets, "
                  "below 0 where it is unknown")
      ->type_name("FILE");
  command
      .add_option("--camera", options.camera,
                  "A camera file, which may be numbered, or its JSON; default: worldToCamera and "
                  "worldToNDC of the depth's file")
      ->type_name("FILE|{...}");
  command
      .add_option("--frames", options.frames,
                  "Frames of the sequence; default: all frames that exist")
      ->type_name("FIRST-LAST[xSTEP]");
  command
      .add_option("--depth-kind", options.depthKind,
                  "Meaning of the depth. view: metres along the view direction; distance: metres "
                  "from the eye; clip: a depth buffer, 0 at the near plane; clip-reversed: a depth "
                  "buffer, 1 at the near plane")
      ->check(CLI::IsMember({"view", "distance", "clip", "clip-reversed"}))
      ->capture_default_str();
  command.add_option("--near", options.near, "Near plane, metres; default: near plane of --camera")
      ->check(positiveNumber());
  command
      .add_option("--far", options.far,
                  "Far plane, metres; depths in metres of at least this are sky; default: inf")
      ->check(positiveNumber(Infinite::kTaken));
  command.add_option("--normal-space", options.normalSpace, "Space of the normals")
      ->check(CLI::IsMember({"world", "view"}))
      ->capture_default_str();
  command
      .add_option("--normal-encoding", options.normalEncoding,
                  "How normals are stored. signed: from -1 to 1; unsigned: (n + 1) / 2, from 0 to "
                  "1, as in files of integers")
      ->check(CLI::IsMember({"signed", "unsigned"}))
      ->capture_default_str();
  command
      .add_option("--depth-channel", options.depthChannel,
                  "Channel that holds the depth; default: the only channel, else Z, else the "
                  "only channel with \"depth\" in its name")
      ->type_name("NAME");
  command
      .add_option("--normal-channels", options.normalChannels,
                  "Channels that hold the normal; default: X, Y and Z of the layer N or of a layer "
                  "with \"normal\" in its name, else the first three")
      ->type_name("X,Y,Z");
}

}  // namespace

void addApply(CLI::App& program) {
  auto options = std::make_shared<ApplyOptions>();
  CLI::App* command =
      program.add_subcommand("apply", "Run effects on depth pictures of another renderer");
  addPictures(*command, *options);
  options->addTo(*command, "Output and its file, as for `grisaille render`; numbered if --depth is")
      ->required();
  command->callback([options] { apply(*options); });
}

}  // namespace grisaille::app
