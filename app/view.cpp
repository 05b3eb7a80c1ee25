// SPDX-License-Identifier: MIT
// grisaille view: a window to look, tune and shoot.
#include <charconv>
#include <memory>

#include "app/command.h"
#include "app/options/driver_messages.h"
#include "app/options/option_checks.h"
#include "app/options/output_file.h"
#include "app/options/size.h"
#include "app/viewer/viewer.h"
#include "core/image/image.h"

namespace grisaille::app {
namespace {

struct ViewOptions : viewer::ViewerOptions {
  std::string windowSize;
};

}  // namespace

void addView(CLI::App& program) {
  auto options = std::make_shared<ViewOptions>();
  viewer::SessionOptions& session = options->session;
  CLI::App* command =
      program.add_subcommand("view", "Open a window on a scene: look, tune, place objects");
  command->add_option("scene", session.scene, "A .gltf or .glb file; default: the built-in atrium");
  command->add_option("--camera", session.camera,
                      "A camera file or its JSON; default: one that sees the scene");
  command->add_option("--size", options->windowSize, "Of the window; default: as it was left")
      ->type_name("WxH");
  command->add_option("--backend", options->backend,
                      "opengl or vulkan; default: the first that opens a window");
  command->add_option("--device", options->device, "Number or part of a device's name");
  CLI::Option* effects =
      command->add_option("--effects", session.effects, "Effects, in the order they run")
          ->delimiter(',');
  command
      ->add_option("--preset", session.presets,
                   "fast, balanced, fine or reference; --config and --set go over it")
      ->type_name("EFFECT=NAME")
      ->allow_extra_args(false);
  command->add_option("--set", session.sets, "A parameter's value")
      ->type_name("EFFECT.PARAMETER=VALUE")
      ->allow_extra_args(false);
  command->add_option("--config", session.config, "Settings, as TOML");
  command->add_option("--surface", session.surface, "What the light falls on")
      ->check(CLI::IsMember({"white", "base"}));
  command->add_option("--view", session.view, "The output to look at; default: color");
  command->add_option("--split", session.split,
                      "A second output, right of a line that can be dragged");
  command->add_flag("--compare-truth", session.compareTruth,
                    "Trace the view and show how far the first effect's visibility is from it");
  command
      ->add_option("--truth-radius", session.truthRadius,
                   "Length of its rays, metres; default: the effect's own radius")
      ->type_name("R")
      ->check(positiveNumber());
  command->add_option("--truth-rays", session.truthRays, "Rays a pixel in the end; default: 256")
      ->check(wholeNumberFrom(viewer::TruthSettings::kLeastRays, viewer::TruthSettings::kMostRays));
  command->add_option("--load", session.loads, "Objects of an effect, as a file that --save wrote")
      ->type_name("EFFECT=FILE")
      ->allow_extra_args(false);
  command->add_option("--plugin-path", session.pluginPaths, "A further folder of effects")
      ->type_name("DIR")
      ->allow_extra_args(false);
  command->add_option("--bookmarks", options->bookmarks, "A folder of camera files")
      ->type_name("DIR");
  command
      ->add_option("--layout", options->layoutFile,
                   "Write where each control lies, as JSON, for programs that drive the window")
      ->type_name("FILE");
  command->add_option("--frames", options->frames,
                      "End after so many whole frames; default: when the window is closed");
  command->add_option("--screenshot", options->screenshot, "Write what the window holds at the end")
      ->type_name("FILE.png");
  command->add_flag("--check", options->check,
                    "Validate every call, in the layer and in the driver");
  command->callback([options, effects] {
    options->session.effectsGiven = effects->count() > 0;
    if (!options->windowSize.empty()) options->size = parseSize(options->windowSize);
    if (!options->screenshot.empty()) image::checkWritable(options->screenshot);
    const NamedOutput outputs[] = {{"--screenshot " + options->screenshot, options->screenshot},
                                   {"--layout " + options->layoutFile, options->layoutFile}};
    requireDistinct(outputs);
    DriverMessages messages;
    options->message = messages.sink();
    viewer::Viewer(*options).run();
    if (options->check) messages.throwIfAny();
  });
}

}  // namespace grisaille::app
