// SPDX-License-Identifier: MIT
#include "tests/backends/drivers/agreement.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>

#include "app/settings/presets.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"

namespace grisaille::tests {
namespace {

constexpr size_t kShots = 100;
constexpr uint32_t kTruthStride = 2;  // pixels
constexpr uint32_t kTruthRays = 64;   // per pixel
constexpr double kTruthRadius = 0.5;  // metres, the effect's default

// Pictures with a depth of back faces, and of the next surfaces behind them.
class SharedSource : public frame::AttachmentSource {
 public:
  SharedSource(gpu::Device& device, const SharedAttachments& shared)
      : pictures_(&device), back_(shared.backDepth), next_(shared.nextDepth) {
    pictures_.show(shared.pictures);
  }
  bool goesBeyond() const override { return false; }
  void record(gpu::Commands& commands, const scene::View& view, gpu::BufferRange viewBlock,
              const frame::AttachmentTargets& targets, std::string_view passes) override {
    frame::AttachmentTargets others = targets;
    others.backDepth = {};
    others.nextDepth = {};
    pictures_.record(commands, view, viewBlock, others, passes);
    commands.beginPass("pictures/depths behind");
    const auto upload = [&](gpu::Texture to, const image::Image& from) {
      if (to) commands.upload(to, 0, 0, std::as_bytes(std::span(from.pixels)));
    };
    upload(targets.backDepth, back_);
    upload(targets.nextDepth, next_);
    commands.endPass();
  }

 private:
  frame::PictureAttachments pictures_;
  const image::Image &back_, &next_;
};

std::vector<lab::Shot> shotsInto(const DriverSubject& subject) {
  const std::vector<trace::Hit> seen =
      subject.rays->tracer().castPrimary(subject.camera, subject.width, subject.height);
  std::mt19937 random(11);
  const auto unit = [&] { return static_cast<float>(random() >> 8) / 16777216.0f; };
  std::vector<lab::Shot> shots;
  while (shots.size() < kShots) {
    const trace::Hit& target = seen[random() % seen.size()];
    const glm::dvec3 aside(3 * unit() - 1.5, 1.5 * unit() - 0.7, 3 * unit() - 1.5);
    const glm::dvec3 muzzle = subject.camera.eye + aside;
    const glm::dvec3 way = target.position - muzzle;
    if (target.viewDepth == 0 || glm::length(way) < 0.1) continue;
    const glm::vec3 direction(glm::normalize(way));
    shots.push_back({.origin = {muzzle.x, muzzle.y, muzzle.z},
                     .direction = {direction.x, direction.y, direction.z},
                     .color = {unit(), unit(), unit()},
                     .range = 0});
  }
  return shots;
}

std::vector<image::Image> drawOn(frame::Renderer& renderer, const DriverSubject& subject,
                                 effect::Chain* chain, const std::vector<std::string>& outputs) {
  renderer.render({.camera = subject.camera,
                   .width = subject.width,
                   .height = subject.height,
                   .chain = chain,
                   .outputs = outputs,
                   .services = {.rays = subject.rays.get()}});
  std::vector<image::Image> images;
  for (const std::string& output : outputs) images.push_back(renderer.read(output));
  return images;
}

// Key of the only effect in a selection.
std::string keyOf(const effect::Selection& selection) {
  return selection.entries().front().key();
}

std::vector<image::Image> drawEffect(gpu::Device& device, frame::Renderer& renderer,
                                     const DriverSubject& subject,
                                     const effect::Selection& selection,
                                     const std::vector<std::string>& outputs) {
  effect::Chain chain(selection);
  const effect::StartedChain started(chain, device);
  if (objects::ObjectList* list = chain.objects("sspm"); list != nullptr) {
    list->assign(objectsOf(list->table(), subject.shots).view());
  }
  return drawOn(renderer, subject, &chain, outputs);
}

}  // namespace

DriverSubject::DriverSubject(std::string theName, scene::Scene theScene,
                             const scene::Camera& theCamera, uint32_t theWidth, uint32_t theHeight)
    : name(std::move(theName)),
      scene(std::move(theScene)),
      camera(theCamera),
      width(theWidth),
      height(theHeight),
      rays(std::make_unique<TracedRays>(scene)) {
  shots = shotsInto(*this);
}

std::unique_ptr<DriverSubject> DriverSubject::atrium(uint32_t width, uint32_t height) {
  return std::unique_ptr<DriverSubject>(new DriverSubject(
      "the built-in atrium", scene::makeAtrium(), scene::atriumCamera(), width, height));
}

std::unique_ptr<DriverSubject> DriverSubject::sponza(uint32_t width, uint32_t height) {
  const char* given = std::getenv("GRISAILLE_SPONZA");
  const std::filesystem::path file = given != nullptr ? given : SHARED_SPONZA;
  if (!std::filesystem::exists(file)) return nullptr;
  scene::Camera camera;
  camera.eye = glm::dvec3(-9.0, 1.7, -0.3);
  camera.target = glm::dvec3(0, 3, -0.4);
  return std::unique_ptr<DriverSubject>(
      new DriverSubject("Crytek Sponza", scene::loadGltf(file.string()), camera, width, height));
}

void DriverSubject::traceTruth() {
  std::vector<glm::uvec2> pixels;
  for (uint32_t y = kTruthStride / 2; y < height; y += kTruthStride) {
    for (uint32_t x = kTruthStride / 2; x < width; x += kTruthStride) pixels.emplace_back(x, y);
  }
  truthHits_ = rays->tracer().castPrimary(camera, width, height, pixels);
  truth_ = rays->tracer().ambientOcclusion(truthHits_, kTruthRadius, kTruthRays, 1);
}

DriverSubject::Errors DriverSubject::errors(const image::Image& ao, const image::Image& depth) {
  if (truth_.empty()) traceTruth();
  double squares = 0, sameSquares = 0, count = 0, same = 0;
  for (size_t i = 0; i < truthHits_.size(); ++i) {
    if (std::isnan(truth_[i].mean)) continue;
    const glm::uvec2 pixel = truthHits_[i].pixel;
    const double off = ao.at(pixel.x, pixel.y) - truth_[i].mean;
    // Subtract the truth's own noise.
    const double square = off * off - std::pow(truth_[i].standardError, 2);
    squares += square;
    count += 1;
    if (std::abs(depth.at(pixel.x, pixel.y) / truthHits_[i].viewDepth - 1) > 0.01) continue;
    sameSquares += square;
    same += 1;
  }
  return {.whole = std::sqrt(squares / count),
          .sameSurface = std::sqrt(sameSquares / same),
          .otherSurface = 1 - same / count};
}

SharedAttachments drawShared(gpu::Device& device, const DriverSubject& subject) {
  frame::Renderer renderer(device, subject.scene);
  std::vector<image::Image> images =
      drawOn(renderer, subject, nullptr, {"depth", "normal", "back_depth", "next_depth"});
  return {.pictures = {.viewDepth = std::move(images[0]),
                       .normal = std::move(images[1]),
                       .baseColour = {}},
          .backDepth = std::move(images[2]),
          .nextDepth = std::move(images[3])};
}

effect::Selection selectionOf(const effect::Registry& registry, const PresetOf& preset) {
  effect::Selection selection(registry, std::array{preset.effect});
  effect::Values& values = selection.values(preset.effect);
  app::applyPreset(values, app::loadPresets(values.effect()), preset.preset);
  return selection;
}

std::vector<PresetOf> allPresets(const effect::Registry& registry) {
  std::vector<PresetOf> all;
  for (const char* effect : {"ssao", "sspm"}) {
    for (const app::Preset& preset : app::loadPresets(registry.find(effect)).all) {
      all.push_back({effect, preset.name});
    }
  }
  return all;
}

std::string outputOf(const std::string& effect) {
  return effect == "ssao" ? "ao" : "paint";
}

image::Image applyShared(gpu::Device& device, const DriverSubject& subject,
                         const effect::Selection& selection, const SharedAttachments& shared) {
  SharedSource source(device, shared);
  frame::Renderer renderer(device, source);
  return drawEffect(device, renderer, subject, selection, {outputOf(keyOf(selection))})[0];
}

std::pair<image::Image, image::Image> drawWhole(gpu::Device& device, const DriverSubject& subject,
                                                const effect::Selection& selection) {
  frame::Renderer renderer(device, subject.scene);
  std::vector<image::Image> images =
      drawEffect(device, renderer, subject, selection, {outputOf(keyOf(selection)), "depth"});
  return {std::move(images[0]), std::move(images[1])};
}

double shareApart(const image::Image& a, const image::Image& b) {
  size_t apart = 0;
  const size_t pixels = size_t{a.width} * a.height;
  for (size_t i = 0; i < pixels; ++i) {
    float worst = 0;
    for (size_t c = i * a.channels; c < (i + 1) * a.channels; ++c) {
      const float off = std::abs(a.pixels[c] - b.pixels[c]);
      worst = off <= worst ? worst : off;  // keeps a NaN
    }
    apart += worst <= 2.0f / 255 ? 0 : 1;
  }
  return static_cast<double>(apart) / static_cast<double>(pixels);
}

}  // namespace grisaille::tests
