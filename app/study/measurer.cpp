// SPDX-License-Identifier: MIT
#include "app/study/measurer.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/error.h"

namespace grisaille::app::study {
namespace {

// Copies `picture`; pixels with a truth that is not finite (no surface) become `elsewhere`.
image::Image onSurfaces(const image::Image& picture, const image::Image& truth, float elsewhere) {
  image::Image result = picture;
  for (size_t i = 0; i < result.pixels.size(); ++i) {
    if (!std::isfinite(truth.pixels[i])) result.pixels[i] = elsewhere;
  }
  return result;
}

}  // namespace

image::Image oneChannel(image::Image picture, const std::string& name) {
  const size_t odd = image::countNonFinite(picture);
  if (odd > 0) {
    throw Error(ErrorId::kEffectOutput, "{} holds {} values that are not finite", name, odd);
  }
  if (picture.channels == 1) return picture;
  if (picture.channels != 4) {
    throw Error(ErrorId::kSettingsInvalid,
                "'{}' has {} channels; give an output or a picture of 1 or 4", name,
                picture.channels);
  }
  for (size_t i = 0; i < picture.pixels.size() / 4; ++i) {
    picture.pixels[i] = picture.pixels[i * 4 + 3];
  }
  picture.pixels.resize(picture.pixels.size() / 4);
  picture.channels = 1;
  return picture;
}

void fit(effect::Selection& selection, const std::vector<effect::ParameterValue>& lengths) {
  for (const effect::ParameterValue& one : lengths) {
    selection.values(one.name.effect).fit(one.name.key, one.value);
  }
}

double costOf(const std::vector<gpu::FrameTimes>& frames, const std::vector<std::string>& effects,
              double guardShare) {
  double sum = 0;
  for (const gpu::FrameTimes& frame : frames) {
    for (const gpu::PassTime& pass : frame.passes) {
      const std::string effect = pass.label.substr(0, pass.label.find('/'));
      if (std::ranges::find(effects, effect) != effects.end()) sum += pass.milliseconds;
      sum += frame::shareForEffects(pass.label, guardShare) * pass.milliseconds;
    }
  }
  return frames.empty() ? 0 : sum / static_cast<double>(frames.size());
}

Measurer::Measurer(const Subject& subject, gpu::Device& device)
    : subject_(subject),
      device_(device),
      services_(*subject.scene),
      renderer_(device, *subject.scene) {}

std::unique_ptr<effect::Chain> Measurer::start(const Setting& setting) {
  auto chain = std::make_unique<effect::Chain>();
  apply(setting, *chain);
  chain->start(device_);
  return chain;
}

void Measurer::apply(const Setting& setting, effect::Chain& chain) {
  chain.selection = effect::Selection(*subject_.registry, subject_.effects);
  fit(chain.selection, subject_.lengths);
  for (const effect::Assignment& set : subject_.sets) chain.selection.set(set);
  for (const effect::ParameterValue& one : setting) chain.selection.set(one);
  for (const auto& [effect, objects] : subject_.objects) {
    chain.objects(effect)->assign(objects.view());
  }
}

void Measurer::render(effect::Chain& chain, const scene::Camera& camera) {
  const std::vector<std::string> outputs = {subject_.output};
  renderer_.render({.camera = camera,
                    .width = subject_.size.x,
                    .height = subject_.size.y,
                    .chain = &chain,
                    .outputs = outputs,
                    .services = services_.all()});
}

image::Image Measurer::show(effect::Chain& chain, const scene::Camera& camera) {
  render(chain, camera);
  return oneChannel(renderer_.read(subject_.output), subject_.output);
}

std::vector<CameraErrors> Measurer::errors(effect::Chain& chain, const Seen& seen) {
  std::vector<CameraErrors> errors;
  for (const View& view : subject_.views) {
    const image::Image shown = show(chain, view.camera);
    const image::Difference d = image::compare(shown, view.truth);
    const double square = d.rmse * d.rmse - view.noise * view.noise;
    const image::Similarity similarity =
        image::ssim(onSurfaces(shown, view.truth, 1), onSurfaces(view.truth, view.truth, 1));
    errors.push_back({view.scene, view.name, std::sqrt(std::max(square, 0.0)), d.meanAbsolute,
                      d.bias, d.percentile99, similarity.mean});
    if (seen) seen(view, shown);
  }
  return errors;
}

std::vector<double> Measurer::costs(effect::Chain& chain) {
  const double share = frame::guardShare(chain.selection, subject_.size.x, subject_.size.y);
  std::vector<double> costs;
  for (const View& view : subject_.views) {
    device_.wait();
    device_.takeTimes();
    render(chain, view.camera);
    device_.wait();
    costs.push_back(costOf(device_.takeTimes(), subject_.effects, share));
  }
  return costs;
}

double Measurer::cost(effect::Chain& chain) {
  const std::vector<double> all = costs(chain);
  return std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
}

}  // namespace grisaille::app::study
