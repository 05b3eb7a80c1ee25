// SPDX-License-Identifier: MIT
#include "core/effect/instance.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "core/effect/host_services.h"

namespace grisaille::effect {

gpu::Format formatOf(uint32_t format) {
  switch (format) {
    case GRISAILLE_FORMAT_R8:
      return gpu::Format::kR8Unorm;
    case GRISAILLE_FORMAT_RGBA8:
      return gpu::Format::kRgba8Unorm;
    case GRISAILLE_FORMAT_R16F:
      return gpu::Format::kR16Float;
    case GRISAILLE_FORMAT_RGBA16F:
      return gpu::Format::kRgba16Float;
    case GRISAILLE_FORMAT_R32F:
      return gpu::Format::kR32Float;
    case GRISAILLE_FORMAT_RG32F:
      return gpu::Format::kRg32Float;
    case GRISAILLE_FORMAT_RGBA32F:
      return gpu::Format::kRgba32Float;
    case GRISAILLE_FORMAT_R32UI:
      return gpu::Format::kR32Uint;
    default:
      return gpu::Format::kNone;
  }
}

struct Instance::State {
  State(gpu::Maker& device, const Effect& of) : desc(*of.desc), services(device, of) {}
  ~State() { services.destroyAll(); }

  const grisaille_effect_desc& desc;
  HostServices services;
  void* effect = nullptr;  // the instance from create()
  bool made = false;       // create() succeeded and destroy() was not called yet
};

Instance::Instance(gpu::Maker& device, const Effect& effect)
    : state_(std::make_unique<State>(device, effect)) {
  HostServices& services = state_->services;
  const grisaille_effect_desc& desc = state_->desc;
  services.open();
  const grisaille_result result = foreignCall(ErrorId::kEffectCreate, desc.key, "create", [&] {
    return desc.create(services.table(), &state_->effect);
  });
  services.close();
  state_->made = result == GRISAILLE_OK;
  const std::string failure = services.failure(result);
  if (failure.empty()) return;
  const ErrorId id = services.failureId(ErrorId::kEffectCreate);
  end();
  throw Error(id, "{} cannot be created: {}", desc.key, failure);
}

Instance::~Instance() {
  try {
    end();
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.what());
  }
}

void Instance::end() {
  if (!std::exchange(state_->made, false)) return;
  state_->services.open();
  foreignCall(ErrorId::kEffectRecord, state_->desc.key, "destroy",
              [&] { state_->desc.destroy(state_->effect); });
  state_->services.close();
}

void Instance::record(const FrameInputs& inputs) {
  HostServices& services = state_->services;
  const grisaille_frame* frame = services.openFrame(inputs);
  grisaille_result result = GRISAILLE_FAILED;
  try {
    result = foreignCall(ErrorId::kEffectRecord, state_->desc.key, "record",
                         [&] { return state_->desc.record(state_->effect, frame); });
  } catch (...) {
    services.close();  // also ends a pass that the effect left open
    throw;
  }
  services.close();
  const std::string failure = services.failure(result);
  if (!failure.empty()) {
    throw Error(services.failureId(ErrorId::kEffectRecord), "{} cannot record: {}",
                state_->desc.key, failure);
  }
}

void Instance::drawAt(const PointInputs& inputs) {
  const grisaille_effect_desc& desc = state_->desc;
  if (desc.draw_at == nullptr) {
    throw Error(ErrorId::kEffectDrawsNoPoints, "{} cannot tell what it draws at points", desc.key);
  }
  std::ranges::fill(inputs.drawn, grisaille_drawn{});
  HostServices& services = state_->services;
  const grisaille_points* points = services.openPoints(inputs);
  grisaille_result result = GRISAILLE_FAILED;
  try {
    result = foreignCall(ErrorId::kEffectRecord, desc.key, "draw_at",
                         [&] { return desc.draw_at(state_->effect, points); });
  } catch (...) {
    services.close();
    throw;
  }
  services.close();
  const std::string failure = services.failure(result);
  if (!failure.empty()) {
    throw Error(services.failureId(ErrorId::kEffectRecord), "{} cannot draw at points: {}",
                desc.key, failure);
  }
  const auto inUnit = [](float x) { return x >= 0 && x <= 1; };
  const auto wrong = std::ranges::find_if_not(inputs.drawn, [&](const grisaille_drawn& d) {
    return std::ranges::all_of(d.colour, inUnit) && inUnit(d.alpha) &&
           d.owner <= inputs.objects.count;
  });
  if (wrong == inputs.drawn.end()) return;
  throw Error(ErrorId::kEffectRecord,
              "{} draws at point {} the colour {}, {}, {} with alpha {} and owner {}", desc.key,
              wrong - inputs.drawn.begin(), wrong->colour[0], wrong->colour[1], wrong->colour[2],
              wrong->alpha, wrong->owner);
}

size_t Instance::resources() const {
  return state_->services.resources();
}

const Report& Instance::report() const {
  return state_->services.report();
}

}  // namespace grisaille::effect
