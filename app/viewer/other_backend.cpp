// SPDX-License-Identifier: MIT
#include "app/viewer/other_backend.h"

#include <span>
#include <utility>

namespace grisaille::app::viewer {
namespace {

// The same picture with as many channels as a texture can have, one or four.
std::vector<float> texelsOf(const image::Image& image) {
  if (image.channels == 1 || image.channels == 4) return image.pixels;
  const size_t count = size_t{image.width} * image.height;
  std::vector<float> texels(count * 4, 1.0f);
  for (size_t i = 0; i < count; ++i) {
    for (size_t c = 0; c < image.channels; ++c) {
      texels[4 * i + c] = image.pixels[i * image.channels + c];
    }
  }
  return texels;
}

}  // namespace

OtherBackend::OtherBackend(const std::string& backend, const gpu::DeviceOptions& options,
                           gpu::Device& device)
    : backend_(backend), window_(device), device_(backends::create(backend, options)) {}

OtherBackend::~OtherBackend() {
  forget();
  window_.destroy(texture_);
}

void OtherBackend::forget() {
  stage_.reset();
  chain_ = {};
  copied_.clear();
  scene_ = nullptr;
  values_ = {};
}

// Gives the own chain the settings and the objects of the window's.
StageDesc OtherBackend::ownDesc(StageDesc desc, const effect::Selection& effects) {
  chain_.selection = effects;
  for (const auto& [effect, list] : desc.chain->objectLists()) {
    const auto known = copied_.find(effect);
    if (known != copied_.end() && known->second == list.revision()) continue;
    if (objects::ObjectList* own = chain_.objects(effect)) own->assign(list.view());
    copied_[effect] = list.revision();
  }
  desc.chain = &chain_;
  return desc;
}

bool OtherBackend::isStale(const scene::Scene& scene, StageDesc desc,
                           const effect::Selection& effects) {
  if (!stage_ || scene_ != &scene) return desc.size.x > 0 && desc.size.y > 0;
  return stage_->isStale(ownDesc(std::move(desc), effects));
}

void OtherBackend::update(const scene::Scene& scene, SceneServices& services, StageDesc desc,
                          const effect::Selection& effects) {
  if (scene_ != &scene) forget();
  const StageDesc own = ownDesc(std::move(desc), effects);
  if (!stage_) {
    stage_ = std::make_unique<Stage>(*device_, scene, services, chain_);
    scene_ = &scene;
  }
  if (!stage_->isStale(own)) return;
  values_ = {};
  stage_->update(own);
  values_ = stage_->read(own.left);
  kind_ = stage_->kind(false);
  bringOver();
}

void OtherBackend::bringOver() {
  const std::vector<float> texels = texelsOf(values_);
  const gpu::TextureDesc wanted = {
      .label = "other backend",
      .format = values_.channels == 1 ? gpu::Format::kR32Float : gpu::Format::kRgba32Float,
      .width = values_.width,
      .height = values_.height,
      .usage = gpu::TextureUsage::kSampled};
  if (!texture_ || made_.format != wanted.format || made_.width != wanted.width ||
      made_.height != wanted.height) {
    window_.destroy(texture_);
    texture_ = {};
    texture_ = window_.createTexture(wanted);
    made_ = wanted;
  }
  gpu::Commands& commands = window_.begin();
  try {
    commands.upload(texture_, 0, 0, std::as_bytes(std::span(texels)));
    window_.submit();
  } catch (...) {
    window_.abandon();
    throw;
  }
  ++revision_;
}

std::optional<Side> OtherBackend::side() const {
  if (values_.pixels.empty()) return std::nullopt;
  return Side{texture_, kind_};
}

std::vector<float> OtherBackend::valueAt(glm::uvec2 pixel) const {
  const glm::uvec2 texel = pixel / (stage_ ? stage_->scale() : 1);
  if (texel.x >= values_.width || texel.y >= values_.height) return {};
  const float* first =
      &values_.pixels[(size_t{texel.y} * values_.width + texel.x) * values_.channels];
  return {first, first + values_.channels};
}

}  // namespace grisaille::app::viewer
