// SPDX-License-Identifier: MIT
// grisaille view: opens the interactive viewer.
#include <charconv>
#include <memory>

#include "app/command.h"
#include "app/options/driver_messages.h"
#include "app/options/option_checks.h"
#include "app/options/output_file.h"
#include "app/options/scene_options.h"
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
      program.add_subcommand("view", "View a scene in a window: move, tune effects, place objects");
  command->add_option("scene", session.scene, sceneHelp());
  command->add_option("--camera", session.camera,
                      "A camera file or its JSON; default: a view of the scene");
  session.pose.addTo(*command);
  command
      ->add_option("--size", options->windowSize,
                   "Size of the window; default: its size when it was last closed")
      ->type_name("WxH");
  command->add_option("--backend", options->backend,
                      "opengl or vulkan; default: the first that opens a window");
  command->add_option("--device", options->device,
                      "Number of a device or part of its name, see `grisaille backends`");
  CLI::Option* effects =
      command->add_option("--effects", session.effects, "Effects, in the order they run")
          ->delimiter(',');
  command
      ->add_option("--preset", session.presets,
                   "fast, balanced, fine or reference; --config and --set override it")
      ->type_name("EFFECT=NAME")
      ->allow_extra_args(false);
  command->add_option("--set", session.sets, "Value of a parameter, see `grisaille effects`")
      ->type_name("EFFECT.PARAMETER=VALUE")
      ->allow_extra_args(false);
  command->add_option("--config", session.config, "Settings file, TOML; --set overrides it");
  command
      ->add_option("--surface", session.surface, "Surfaces in color: white, or their base colours")
      ->check(CLI::IsMember({"white", "base"}));
  addBackground(*command, session.background);
  command->add_option("--view", session.view, "Output to show; default: color");
  command->add_option("--split", session.split,
                      "Second output, shown to the right of a line that you can drag");
  command
      ->add_option("--split-as", session.splitWay,
                   "Compare both sides by a line, by their difference, or in turn; default: line")
      ->type_name("WAY")
      ->transform(CLI::CheckedTransformer(std::map<std::string, viewer::SplitWay>{
                                              {"line", viewer::SplitWay::kLine},
                                              {"difference", viewer::SplitWay::kDifference},
                                              {"flicker", viewer::SplitWay::kFlicker}})
                      .description("{line,difference,flicker}"));
  command->add_option("--split-backend", session.splitBackend,
                      "Backend that renders the right side; default: the window's");
  command->add_flag("--compare-truth", session.compareTruth,
                    "Ray trace the view, and show the error of the first effect's visibility");
  command
      ->add_option("--truth-radius", session.truthRadius,
                   "Length of the rays of --compare-truth, metres; default: the effect's radius")
      ->type_name("R")
      ->check(positiveNumber());
  command
      ->add_option("--truth-rays", session.truthRays,
                   "Rays per pixel at which --compare-truth ends; default: 256")
      ->check(wholeNumberFrom(viewer::TruthSettings::kLeastRays, viewer::TruthSettings::kMostRays));
  command
      ->add_option("--load", session.loads,
                   "Load objects of an effect from a file that `grisaille render --save` wrote")
      ->type_name("EFFECT=FILE")
      ->allow_extra_args(false);
  command->add_option("--plugin-path", session.pluginPaths, "Another folder to load effects from")
      ->type_name("DIR")
      ->allow_extra_args(false);
  command->add_option("--bookmarks", options->bookmarks, "Folder of the bookmarks, camera files")
      ->type_name("DIR");
  command->add_flag("--fresh", options->fresh,
                    "Start without the scene, camera, effects and panel of the last session");
  command
      ->add_option("--session", options->sessionFile,
                   "Start with a session file; other options override it")
      ->type_name("FILE.json");
  command
      ->add_option("--layout", options->layoutFile,
                   "Write the position of each control as JSON, for programs that drive the window")
      ->type_name("FILE");
  command->add_option("--frames", options->frames,
                      "Close the window after this many frames that show the scene; default: stay "
                      "open");
  command
      ->add_option("--capture", options->capture, "Write the last picture of the window to a file")
      ->type_name("FILE.png");
  command->add_flag("--check", options->check,
                    "Validate every graphics call, in the rendering layer and in the driver");
  command->callback([options, effects] {
    options->session.effectsGiven = effects->count() > 0;
    if (!options->session.splitBackend.empty()) backends::find(options->session.splitBackend);
    if (!options->windowSize.empty()) options->size = parseSize(options->windowSize);
    if (!options->capture.empty()) image::checkWritable(options->capture);
    const NamedOutput outputs[] = {{"--capture " + options->capture, options->capture},
                                   {"--layout " + options->layoutFile, options->layoutFile}};
    requireDistinct(outputs);
    DriverMessages messages;
    options->message = messages.sink();
    viewer::Viewer(*options).run();
    if (options->check) messages.throwIfAny();
  });
}

}  // namespace grisaille::app
