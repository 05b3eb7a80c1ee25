// SPDX-License-Identifier: MIT
#include "lab/stability/runner.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <utility>

#include "app/services/scene_services.h"
#include "app/truth/content_hash.h"
#include "core/base/error.h"
#include "core/frame/view_block.h"
#include "lab/stability/comparison.h"

namespace grisaille::lab::stability {
namespace {

// The attachments that the effect reads and its oracle needs.
std::vector<std::string> attachmentsOf(const Case& one, const effect::Values& values) {
  if (one.effect == "sspm") {
    if (values.text("mode") == "surface") return {"depth", "facet_normal"};
    return {"depth"};
  }
  std::vector<std::string> all = {"depth", "normal"};
  const std::string backs = values.text("estimator") == "slices" ? values.text("backs") : "";
  if (backs == "drawn" || backs == "peeled") all.emplace_back("back_depth");
  if (backs == "peeled") all.emplace_back("next_depth");
  // Pictures have no thickness.
  if (backs == "bodies" && !one.scenery.isPicture()) all.emplace_back("thickness");
  if (one.output == "tint") all.emplace_back("base_colour");
  return all;
}

std::vector<std::string> outputsOf(const Case& one) {
  if (one.effect == "ssao") return {one.output};
  return {one.output, "paint_coverage"};
}

// Outputs whose range is checked, without a comparison with the oracle.
std::vector<std::string> furtherOutputs(const Case& one) {
  if (!one.every) return {};
  if (one.effect == "sspm") return {"paint_owner"};
  std::vector<std::string> all = {"ao", "bent_normal", "tint"};
  std::erase(all, one.output);
  return all;
}

// Sets result.touched and result.bits. Touched pixels are below 1 in visibility and tint, over 0 in
// the alpha of paint; bent normals touch every surface.
void describe(const image::Image& picture, const std::string& output, BackendResult& result) {
  uint64_t touched = 0;
  for (size_t i = 0; i < picture.pixels.size(); i += picture.channels) {
    const float* pixel = &picture.pixels[i];
    const bool surface =
        output == "bent_normal" && glm::vec3(pixel[0], pixel[1], pixel[2]) != glm::vec3(0);
    const bool paint = output == "paint" && pixel[3] > 0;
    touched += surface || paint || (output != "bent_normal" && output != "paint" && pixel[0] < 1);
  }
  result.touched = static_cast<double>(touched) / (double{1} * picture.width * picture.height);
  app::truth::ContentHash hash;
  hash.add(std::span<const float>(picture.pixels));
  result.bits = hash.value();
}

// The allowed range of an output. Owners are numbers of shots. Bent normals have signs, and
// rounding to half floats may make them longer than 1.
std::pair<double, double> rangeOf(const std::string& output, const Case& one) {
  if (output == "paint_owner") return {0, static_cast<double>(one.shots.size())};
  constexpr double kHalf = 1.0 / 1024;
  if (output == "bent_normal") return {-1 - kHalf, 1 + kHalf};
  return {0, 1};
}

void count(const image::Image& image, std::pair<double, double> range, BackendResult& result) {
  for (const float value : image.pixels) {
    if (!std::isfinite(value)) {
      ++result.nonFinite;
    } else if (value < range.first || value > range.second) {
      ++result.outside;
    }
  }
}

scene::Scene sceneOf(const Case& one) {
  return one.scenery.isPicture() ? scene::Scene() : makeScene(one.scenery);
}

// The camera whose picture extends `guard` pixels further on each side.
scene::Camera widened(const scene::Camera& camera, const glm::uvec2& size, uint32_t guard) {
  if (guard == 0) return camera;
  scene::Camera wide = camera;
  const glm::dvec2 share = glm::dvec2(size + 2 * guard) / glm::dvec2(size);
  const double slope = std::tan(glm::radians(camera.fovyDegrees) / 2);
  wide.fovyDegrees = glm::degrees(2 * std::atan(slope * share.y));
  wide.orthographicHeight *= share.y;
  wide.shift /= share;
  return wide;
}

}  // namespace

struct Runner::Stage {
  explicit Stage(gpu::Device& on) : device(on), started(chain, on) {}

  gpu::Device& device;
  effect::Chain chain;
  effect::StartedChain started;
};

struct Runner::Picture {
  std::map<std::string, image::Image> outputs = {};
  std::vector<oracle::View> views = {};  // of all frames; the last is that of the case itself
  image::Image expected = {};            // the oracle's picture
};

Runner::Runner(const effect::Registry& registry, std::span<gpu::Device* const> devices)
    : registry_(registry) {
  for (gpu::Device* device : devices) {
    stages_.push_back(std::make_unique<Stage>(*device));
  }
}

Runner::~Runner() = default;

Result Runner::run(const Case& one) {
  Result result{.key = keyOf(one), .backends = {}, .between = {}};
  std::vector<image::Image> compared;
  const scene::Scene scene = sceneOf(one);
  for (const auto& stage : stages_) {
    Picture picture;
    result.backends.push_back(runOn(*stage, one, scene, picture));
    if (!result.backends.back().error.empty()) continue;
    compared.push_back(std::move(picture.outputs.at(one.output)));
  }
  if (compared.size() == 2) result.between = apartOf(differences(compared[0], compared[1]));
  return result;
}

const std::string& Runner::backend(size_t index) const {
  return stages_.at(index)->device.info().backend;
}

Compared Runner::compare(const Case& one) {
  Picture picture;
  runOn(*stages_.at(0), one, sceneOf(one), picture);
  return {.picture = std::move(picture.outputs.at(one.output)),
          .expected = std::move(picture.expected)};
}

Seen Runner::see(size_t backend, const Case& one) {
  Picture picture;
  Stage& stage = *stages_.at(backend);
  choose(stage, one);
  render(stage, one, sceneOf(one), picture);
  return {.ao = std::move(picture.outputs.at("ao")), .view = std::move(picture.views.back())};
}

// Sets up the case's effect with its values and shots.
void Runner::choose(Stage& stage, const Case& one) {
  effect::Chain& chain = stage.chain;
  chain.selection = effect::Selection(registry_, std::array{one.effect});
  for (const auto& [key, value] : one.settings) chain.selection.values(one.effect).set(key, value);
  // Start the effect again: its history must begin with the case.
  if (!one.before.empty()) chain.start(stage.device);
  objects::ObjectList* list = chain.objects(one.effect);
  if (list == nullptr) return;
  // Assign an empty list first. Otherwise the effect keeps the maps of equal shots, which belong to
  // the scenery of the previous case.
  list->assign({&list->table(), nullptr, 0});
  list->assign(objectsOf(list->table(), one.shots).view());
}

void Runner::render(Stage& stage, const Case& one, const scene::Scene& scene, Picture& picture) {
  const effect::Values& values = stage.chain.selection.values(one.effect);
  frame::PictureAttachments pictures;
  if (one.scenery.isPicture()) {
    pictures.show(makePictures(one.scenery, one.camera, one.size));
  }
  app::SceneServices services(scene);
  frame::Renderer renderer = one.scenery.isPicture() ? frame::Renderer(stage.device, pictures)
                                                     : frame::Renderer(stage.device, scene);
  const auto draw = [&](const scene::Camera& camera, const glm::uvec2& size, effect::Chain* chain,
                        const std::vector<std::string>& outputs) {
    renderer.render({.camera = camera,
                     .width = size.x,
                     .height = size.y,
                     .chain = chain,
                     .outputs = outputs,
                     .services = one.scenery.isPicture() ? effect::Services{} : services.all()});
  };
  const auto read = [&](const std::vector<std::string>& outputs) {
    for (const std::string& name : outputs) picture.outputs[name] = renderer.read(name);
  };
  const uint32_t guard = one.scenery.isPicture() ? 0 : effect::guardBand(values, one.size.y);
  std::vector<scene::Camera> cameras = one.before;
  cameras.push_back(one.camera);
  for (const scene::Camera& camera : cameras) {
    draw(camera, one.size, &stage.chain, outputsOf(one));
    read(outputsOf(one));
    // Draw the effect's input again, to read it back for the oracle.
    const std::vector<std::string> names = attachmentsOf(one, values);
    draw(widened(camera, one.size, guard), one.size + 2 * guard, nullptr, names);
    oracle::Attachments seen;
    for (const std::string& name : names) {
      (name == "depth"         ? seen.depth
       : name == "back_depth"  ? seen.back
       : name == "next_depth"  ? seen.next
       : name == "thickness"   ? seen.thickness
       : name == "base_colour" ? seen.colour
                               : seen.normal) = renderer.read(name);
    }
    picture.views.emplace_back(camera, one.size, guard, std::move(seen));
  }
  const std::vector<std::string> further = furtherOutputs(one);
  if (further.empty()) return;
  draw(one.camera, one.size, &stage.chain, further);
  read(further);
}

BackendResult Runner::runOn(Stage& stage, const Case& one, const scene::Scene& scene,
                            Picture& picture) {
  BackendResult result;
  result.backend = stage.device.info().backend;
  const auto start = std::chrono::steady_clock::now();
  try {
    choose(stage, one);
    render(stage, one, scene, picture);
    const effect::Values& values = stage.chain.selection.values(one.effect);
    for (const auto& [name, image] : picture.outputs) count(image, rangeOf(name, one), result);
    describe(picture.outputs.at(one.output), one.output, result);
    if (one.effect == "ssao") {
      picture.expected =
          compareOcclusion(one, values, picture.views, picture.outputs.at(one.output), result);
    } else {
      picture.expected =
          comparePaint(one, values, picture.views.back(), scene, picture.outputs.at("paint"),
                       picture.outputs.at("paint_coverage"), result);
    }
  } catch (const Error& error) {
    if (error.id() == ErrorId::kDeviceLost) throw;  // ends the sweep
    result.error = error.what();
    stage.chain.stop();
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace grisaille::lab::stability
