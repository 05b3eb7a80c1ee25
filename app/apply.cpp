// SPDX-License-Identifier: MIT
// grisaille apply: effects on pictures made elsewhere, one or a numbered sequence.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include "app/apply/channels.h"
#include "app/apply/sequence.h"
#include "app/command.h"
#include "app/options/camera_option.h"
#include "app/options/driver_messages.h"
#include "app/options/effect_options.h"
#include "app/options/option_checks.h"
#include "app/options/output_file.h"
#include "app/options/start_device.h"
#include "app/truth/progress.h"
#include "core/base/error.h"
#include "core/frame/picture_attachments.h"
#include "core/frame/picture_depth.h"
#include "core/scene/camera_matrices.h"

namespace grisaille::app {
namespace {

struct ApplyOptions : EffectOptions {
  std::string depth, normal, baseColour, camera, frames;
  std::string depthKind = "view", depthChannel, normalChannels, normalSpace = "world";
  double near = 0, far = std::numeric_limits<double>::infinity();  // metres; near 0: the camera's
};

frame::DepthKind kindOf(const std::string& name) {
  if (name == "clip") return frame::DepthKind::kClip;
  if (name == "clip-reversed") return frame::DepthKind::kClipReversed;
  return name == "distance" ? frame::DepthKind::kDistance : frame::DepthKind::kView;
}

struct Output {
  std::string name;
  FileName file;
};

// What the command line asks for, checked before anything slow is done.
struct ApplyJob : ChosenEffects {
  const ApplyOptions& options;
  FileName depth, normal, baseColour, camera;
  std::vector<Output> outputs;
  std::vector<int> frames;  // one that means nothing where nothing is numbered

  explicit ApplyJob(const ApplyOptions& given)
      : ChosenEffects(given),
        options(given),
        depth(given.depth),
        normal(given.normal),
        baseColour(given.baseColour),
        camera(isInlineCamera(given.camera) ? "" : given.camera) {
    const auto writes = parseOutputFiles(options.writes);
    for (const OutputFile& write : writes) outputs.push_back({write.output, FileName(write.file)});
    if (!(options.far > std::max(options.near, 0.0))) {
      throw Error(ErrorId::kUsage, "--far {} is no farther than --near {}", options.far,
                  options.near);
    }
    for (const Output& output : outputs) frame::checkOutput(output.name, chain.selection.effects());
    findFrames();
    requireDistinctOutputs();
  }

  scene::Camera cameraOf(int number, const image::Picture& depthPicture) const;

 private:
  void findFrames();
  void requireDistinctOutputs() const;
};

// Of all frames.
void ApplyJob::requireDistinctOutputs() const {
  std::vector<NamedOutput> all;
  for (const int number : frames) {
    for (const Output& output : outputs) {
      const std::string file = output.file.at(number);
      all.push_back({fmt::format("--write {}={}", output.name, file), file});
    }
  }
  requireDistinct(all);
}

// Every file of every frame is there before the first is worked on.
void ApplyJob::findFrames() {
  const bool sequence = depth.numbered();
  for (const Output& output : outputs) {
    if (output.file.numbered() != sequence) {
      throw Error(ErrorId::kSequence, "'{}' {}", output.file.at(0),
                  sequence ? "has no place for the frame's number, the depth has"
                           : "has a place for a number, the depth has none");
    }
  }
  if (!sequence && !options.frames.empty()) {
    throw Error(ErrorId::kSequence, "--frames is given, and '{}' has no place for a number",
                options.depth);
  }
  frames = !sequence                ? std::vector<int>{0}
           : options.frames.empty() ? depth.numbers()
                                    : parseFrames(options.frames);
  for (const FileName* file : {&depth, &normal, &baseColour, &camera}) {
    if (file->numbered() && !sequence) {
      throw Error(ErrorId::kSequence, "'{}' is numbered, the depth is not", file->at(frames[0]));
    }
    for (const int number : frames) {
      const std::string path = file->at(number);
      std::error_code failed;
      if (!file->numbered() || std::filesystem::exists(path, failed)) continue;
      throw Error(ErrorId::kSequence, "frame {} has no '{}'", number, path);
    }
  }
}

// From --camera or, without it, the matrices of the depth's file.
scene::Camera ApplyJob::cameraOf(int number, const image::Picture& picture) const {
  scene::Camera result;
  if (isInlineCamera(options.camera)) {
    result = scene::parseCamera(options.camera, "--camera");
  } else if (!options.camera.empty()) {
    result = scene::loadCamera(camera.at(number));
  } else if (picture.matrices) {
    result = scene::cameraOf(*picture.matrices, picture.image.width, picture.image.height,
                             depth.at(number));
  } else {
    throw Error(ErrorId::kPictureCamera, "{}: nothing tells where it was seen from",
                depth.at(number));
  }
  const bool buffer = options.depthKind.starts_with("clip");
  if (buffer && options.near <= 0 && options.camera.empty()) {
    throw Error(ErrorId::kUsage, "--depth-kind {} needs the near plane: give --near",
                options.depthKind);
  }
  if (options.near > 0) result.nearPlane = options.near;
  return result;
}

void toWorld(image::Image& normals, const scene::Camera& camera) {
  const glm::mat3 rotation(scene::worldFromView(camera));
  for (size_t i = 0; i < normals.pixels.size(); i += 3) {
    const glm::vec3 world =
        rotation * glm::vec3(normals.pixels[i], normals.pixels[i + 1], normals.pixels[i + 2]);
    for (int c = 0; c < 3; ++c) normals.pixels[i + static_cast<size_t>(c)] = world[c];
  }
}

struct LoadedFrame {
  scene::Camera camera;
  frame::Pictures pictures;
};

LoadedFrame load(const ApplyJob& job, int number) {
  const ApplyOptions& options = job.options;
  const std::string depthFile = job.depth.at(number);
  const image::Picture depth = image::readPicture(depthFile);
  LoadedFrame loaded{.camera = job.cameraOf(number, depth), .pictures = {}};
  frame::Pictures& pictures = loaded.pictures;
  pictures.viewDepth = frame::viewDepthOf(
      depthChannel(depth, options.depthChannel, depthFile),
      {.kind = kindOf(options.depthKind), .near = loaded.camera.nearPlane, .far = options.far},
      loaded.camera, depthFile);
  if (!options.normal.empty()) {
    const std::string file = job.normal.at(number);
    pictures.normal = normalChannels(image::readPicture(file), options.normalChannels, file);
    if (options.normalSpace == "view") toWorld(pictures.normal, loaded.camera);
  }
  if (!options.baseColour.empty()) {
    const std::string file = job.baseColour.at(number);
    pictures.baseColour = colourChannels(image::readPicture(file), file);
  }
  return loaded;
}

void writeOutputs(const ApplyJob& job, int number, const scene::Camera& camera,
                  frame::Renderer& renderer) {
  for (const Output& output : job.outputs) {
    const image::Image picture = renderer.read(output.name);
    writeOutput(picture, {.output = output.name, .file = output.file.at(number)},
                {.transfer = frame::transferOf(output.name),
                 .matrices = scene::matricesOf(camera, picture.width, picture.height)});
  }
}

void applyFrames(ApplyJob& job, LoadedFrame loaded, gpu::Device& device) {
  const effect::StartedChain started(job.chain, device);
  std::vector<std::string> names;
  for (const Output& output : job.outputs) names.push_back(output.name);
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
      if (done > 1) loaded = load(job, number);
      source.show(std::move(loaded.pictures));
      renderer.render({.camera = loaded.camera,
                       .width = source.width(),
                       .height = source.height(),
                       .surface = job.surface,
                       .chain = &job.chain,
                       .outputs = names});
      writeOutputs(job, number, loaded.camera, renderer);
    }
  }
  for (const Output& output : job.outputs) {
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
  LoadedFrame first = load(job, job.frames.front());  // what does not fit is known before the rest
  DriverMessages messages;
  {
    const auto device =
        startDevice(options.backend,
                    {.device = options.device, .check = options.check, .message = messages.sink()});
    printDevice(device->info());
    applyFrames(job, std::move(first), *device);
  }
  if (options.check) messages.throwIfAny();
}

void addPictures(CLI::App& command, ApplyOptions& options) {
  command
      .add_option("--depth", options.depth,
                  "Depth, as .exr; %04d or #### in this and other names: a numbered sequence")
      ->required()
      ->type_name("FILE");
  command.add_option("--normal", options.normal, "Normals; without, those of the depth's facets")
      ->type_name("FILE");
  command.add_option("--base-colour", options.baseColour, "Linear colour, for --surface base")
      ->type_name("FILE");
  command
      .add_option(
          "--camera", options.camera,
          "A camera file, also numbered, or its JSON; default: the depth's own worldToCamera "
          "and worldToNDC")
      ->type_name("FILE|{...}");
  command.add_option("--frames", options.frames, "Of a sequence; default: those that are there")
      ->type_name("FIRST-LAST[xSTEP]");
  command
      .add_option("--depth-kind", options.depthKind,
                  "What the depth holds: metres along the view direction or from the eye, or a "
                  "depth buffer with 0 or, reversed, 1 at the near plane")
      ->check(CLI::IsMember({"view", "distance", "clip", "clip-reversed"}))
      ->capture_default_str();
  command.add_option("--near", options.near, "Near plane, metres; default: the camera file's")
      ->check(positiveNumber());
  command
      .add_option("--far", options.far,
                  "Far plane, metres; of depths in metres what is as far is sky; default: none")
      ->check(positiveNumber(Infinite::kTaken));
  command.add_option("--normal-space", options.normalSpace, "Axes of the normals")
      ->check(CLI::IsMember({"world", "view"}))
      ->capture_default_str();
  command
      .add_option("--depth-channel", options.depthChannel,
                  "Which channel holds the depth; default: the only one, Z or one named depth")
      ->type_name("NAME");
  command
      .add_option("--normal-channels", options.normalChannels,
                  "Which channels hold the normal; default: X, Y and Z of a layer that is named so")
      ->type_name("X,Y,Z");
}

}  // namespace

void addApply(CLI::App& program) {
  auto options = std::make_shared<ApplyOptions>();
  CLI::App* command =
      program.add_subcommand("apply", "Run effects on pictures of depth that were made elsewhere");
  addPictures(*command, *options);
  options->addTo(*command, "As of `grisaille render`, numbered where the depth is")->required();
  command->callback([options] { apply(*options); });
}

}  // namespace grisaille::app
