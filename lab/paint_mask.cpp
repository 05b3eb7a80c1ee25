// SPDX-License-Identifier: MIT
// grisaille-lab paint-mask: traces the mask that shots of paint should cover.
#include <fmt/format.h>

#include <memory>

#include "app/options/scene_options.h"
#include "app/settings/load_effects.h"
#include "core/base/error.h"
#include "core/image/image.h"
#include "lab/command.h"
#include "lab/paint/paint_mask.h"

namespace grisaille::lab {
namespace {

constexpr double kFarthest = 1e6;  // metres, same limit as sspm's paint_range

struct PaintMaskOptions {
  app::SceneOptions view;
  std::string load, write;
  std::vector<std::string> pluginPaths;
  double paintRange = 0;  // metres; 0: not given
};

std::vector<Shot> shotsFrom(const PaintMaskOptions& options) {
  const auto registry = app::loadEffects(options.pluginPaths);
  std::vector<Shot> shots = loadShots(*registry, options.load);
  for (size_t i = 0; options.paintRange == 0 && i < shots.size(); ++i) {
    if (shots[i].range > 0) continue;
    throw Error(ErrorId::kUsage, "shot {} of {} has no range; pass --paint-range", i, options.load);
  }
  return shots;
}

void writePaintMask(const PaintMaskOptions& options) {
  image::checkWritable(options.write);
  const double range = options.paintRange;
  if (range != 0 && !(range > 0 && range <= kFarthest)) {
    throw Error(ErrorId::kUsage, "--paint-range is {:g}; it must be over 0 and at most {:g} metres",
                range, kFarthest);
  }
  const std::vector<Shot> shots = shotsFrom(options);
  app::SceneView view = app::loadView(options.view);
  view.takePose();
  const auto& [scene, pose, camera, size] = view;

  const trace::RayTracer tracer(scene, camera.eye);
  const std::vector<uint8_t> mask =
      paintMask(tracer, tracer.castPrimary(camera, size.x, size.y), shots, range);
  image::write({.width = size.x,
                .height = size.y,
                .channels = 1,
                .pixels = std::vector<float>(mask.begin(), mask.end())},
               options.write, {.transfer = image::Transfer::kData});
  fmt::print("wrote {}\n", options.write);
}

}  // namespace

void addPaintMask(CLI::App& program) {
  auto options = std::make_shared<PaintMaskOptions>();
  CLI::App* command = program.add_subcommand(
      "paint-mask", "Trace which pixels shots of paint should cover: 1 there, 0 elsewhere");
  options->view.addTo(*command);
  command->add_option("--load", options->load, "The shots: objects of sspm")
      ->type_name("FILE.json")
      ->required();
  command->add_option("--paint-range", options->paintRange, "Metres, for shots without a range")
      ->type_name("R");
  command->add_option("--write", options->write, "The mask, one channel, as .exr or .png")
      ->type_name("FILE")
      ->required();
  command->add_option("--plugin-path", options->pluginPaths, "Another folder to load effects from")
      ->type_name("DIR")
      ->allow_extra_args(false);
  command->callback([options] { writePaintMask(*options); });
}

}  // namespace grisaille::lab
