// SPDX-License-Identifier: MIT
#include "app/stability/runner.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <utility>

#include "app/scene_rays.h"
#include "app/stability/comparison.h"
#include "app/truth/content_hash.h"
#include "core/error.h"
#include "core/frame/view_block.h"

namespace grisaille::app::stability {
namespace {

std::vector<std::string> outputsOf(const Case& one, const effect::Values& values) {
  if (one.effect == "ssao") return {"depth", "normal", "ao"};
  const bool surface = values.get("mode") == 0;
  std::vector<std::string> all = {"depth", "paint", "paint_coverage"};
  if (surface) all.emplace_back("facet_normal");
  return all;
}

std::vector<std::string> furtherOutputs(const Case& one) {
  if (!one.every) return {};
  if (one.effect == "ssao") return {"bent_normal", "tint"};
  return {"paint_owner"};
}

// Of visibility, or the alpha of paint.
void describe(const image::Image& picture, BackendResult& result) {
  const bool paint = picture.channels == 4;
  uint64_t touched = 0;
  for (size_t i = 0; i < picture.pixels.size(); i += picture.channels) {
    touched += (paint ? picture.pixels[i + 3] > 0 : picture.pixels[i] < 1) ? 1 : 0;
  }
  result.touched = static_cast<double>(touched) / (double{1} * picture.width * picture.height);
  truth::ContentHash hash;
  hash.add(std::span<const float>(picture.pixels));
  result.bits = hash.value();
}

bool isAttachment(const std::string& output) {
  return output == "depth" || output == "normal" || output == "facet_normal";
}

// Owners are numbers of shots; directions have signs, and half floats round their length.
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

effect::Values valuesOf(const effect::Registry& registry, const Case& one) {
  effect::Values values(registry.find(one.effect));
  for (const auto& [key, value] : one.settings) values.set(key, value);
  return values;
}

}  // namespace

struct Runner::Stage {
  gpu::Device& device;
  std::map<std::string, std::unique_ptr<effect::Instance>> instances = {};
};

struct Runner::Picture {
  std::map<std::string, image::Image> outputs = {};
  image::Image depth = {}, normal = {};  // with the guard band
  uint32_t guard = 0;
};

Runner::Runner(const effect::Registry& registry, std::span<gpu::Device* const> devices)
    : registry_(registry) {
  for (gpu::Device* device : devices) {
    stages_.push_back(std::make_unique<Stage>(Stage{.device = *device}));
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
    compared.push_back(std::move(picture.outputs.at(one.effect == "ssao" ? "ao" : "paint")));
  }
  if (compared.size() == 2) result.between = apartOf(differences(compared[0], compared[1]));
  return result;
}

const std::string& Runner::backend(size_t index) const {
  return stages_.at(index)->device.info().backend;
}

Seen Runner::see(size_t backend, const Case& one) {
  Picture picture;
  render(*stages_.at(backend), one, valuesOf(registry_, one), sceneOf(one), picture);
  return {.ao = std::move(picture.outputs.at("ao")),
          .view = View(one.camera, one.size, picture.guard, std::move(picture.depth),
                       std::move(picture.normal))};
}

void Runner::render(Stage& stage, const Case& one, const effect::Values& values,
                    const scene::Scene& scene, Picture& picture) {
  auto& instance = stage.instances[one.effect];
  if (!instance) {
    instance = std::make_unique<effect::Instance>(stage.device, values.effect());
  }
  const std::array active = {frame::ActiveEffect{
      .instance = instance.get(), .values = &values, .shots = one.shots, .shotsKept = 0}};
  frame::PictureAttachments pictures;
  if (one.scenery.isPicture()) {
    pictures.show(makePictures(one.scenery, one.camera, one.size));
  }
  SceneRays rays(scene);
  frame::Renderer renderer = one.scenery.isPicture() ? frame::Renderer(stage.device, pictures)
                                                     : frame::Renderer(stage.device, scene);
  const auto draw = [&](const scene::Camera& camera, const glm::uvec2& size,
                        std::span<const frame::ActiveEffect> effects,
                        const std::vector<std::string>& outputs) {
    renderer.render({.camera = camera,
                     .width = size.x,
                     .height = size.y,
                     .effects = effects,
                     .outputs = outputs,
                     .rays = one.scenery.isPicture() ? nullptr : &rays});
  };
  for (const auto& outputs : {outputsOf(one, values), furtherOutputs(one)}) {
    if (outputs.empty()) continue;
    draw(one.camera, one.size, active, outputs);
    for (const std::string& name : outputs) picture.outputs[name] = renderer.read(name);
  }
  picture.depth = std::move(picture.outputs.at("depth"));
  if (one.effect == "sspm") {
    picture.normal = std::move(picture.outputs["facet_normal"]);
    return;
  }
  picture.normal = std::move(picture.outputs.at("normal"));
  picture.guard = one.scenery.isPicture() ? 0 : frame::guardBand(values, one.size.y);
  if (picture.guard == 0) return;
  // The same draw as that which the effect reads.
  draw(frame::widened(one.camera, one.size.y, picture.guard), one.size + 2 * picture.guard, {},
       {"depth", "normal"});
  picture.depth = renderer.read("depth");
  picture.normal = renderer.read("normal");
}

BackendResult Runner::runOn(Stage& stage, const Case& one, const scene::Scene& scene,
                            Picture& picture) {
  BackendResult result;
  result.backend = stage.device.info().backend;
  const auto start = std::chrono::steady_clock::now();
  try {
    const effect::Values values = valuesOf(registry_, one);
    render(stage, one, values, scene, picture);
    for (const auto& [name, image] : picture.outputs) {
      if (!isAttachment(name)) count(image, rangeOf(name, one), result);
    }
    describe(picture.outputs.at(one.effect == "ssao" ? "ao" : "paint"), result);
    const View view(one.camera, one.size, picture.guard, std::move(picture.depth),
                    std::move(picture.normal));
    if (one.effect == "ssao") {
      compareOcclusion(one, values, view, picture.outputs.at("ao"), result);
    } else {
      comparePaint(one, values, view, scene, picture.outputs.at("paint"),
                   picture.outputs.at("paint_coverage"), result);
    }
  } catch (const Error& error) {
    if (error.id() == ErrorId::kDeviceLost) throw;  // no fault of this case, and the end of all
    result.error = error.what();
    stage.instances.erase(one.effect);
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace grisaille::app::stability
