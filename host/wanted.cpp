// SPDX-License-Identifier: MIT
#include "host/wanted.h"

#include <algorithm>

#include "host/checks.h"

namespace grisaille::host {
namespace {

constexpr uint32_t kLargestSide = 16384;  // pixels

effect::Chain chainOf(const grisaille_host_device& device, const grisaille_host_effect_desc& desc) {
  const std::string keys[] = {&present(desc.effect, "desc.effect")};
  return effect::Chain(effect::Selection(device.registry, keys));
}

}  // namespace

void checkSize(const grisaille_host_device& device, uint32_t width, uint32_t height) {
  const uint32_t most = std::min(kLargestSide, device.gpu->info().capabilities.maxTextureSize);
  if (width >= 1 && width <= most && height >= 1 && height <= most) return;
  throw Error(ErrorId::kTextureSize, "{} x {} pixels are out of 1 to {}", width, height, most);
}

uint32_t indexOf(const effect::Effect& effect, std::string_view key) {
  const auto outputs = effect.outputs();
  for (uint32_t i = 0; i < outputs.size(); ++i) {
    if (key == outputs[i].key) return i;
  }
  std::string all;
  for (const grisaille_output_desc& output : outputs) {
    all += (all.empty() ? "" : ", ") + std::string(output.key);
  }
  throw Error(ErrorId::kOutputUnknown, "effect {} has no output '{}'; it has {}", effect.key(),
              oneLine(key), all);
}

uint32_t layersOf(const grisaille_host_effect_desc& desc) {
  constexpr uint32_t kMost = 16;
  if (desc.layers > kMost) {
    throw Error(ErrorId::kHostValue, "desc.layers is {}, over {}", desc.layers, kMost);
  }
  return std::max(desc.layers, 1u);
}

uint32_t keptSizesOf(const grisaille_host_effect_desc& desc) {
  constexpr uint32_t kMost = 256;
  if (desc.kept_sizes <= kMost) return desc.kept_sizes;
  throw Error(ErrorId::kHostValue, "desc.kept_sizes is {}, over {}", desc.kept_sizes, kMost);
}

Wanted::Wanted(const grisaille_host_device& device, const grisaille_host_effect_desc& desc)
    : chain(chainOf(device, desc)), layers(layersOf(desc)) {
  effect::Values& values = chain.selection.entries()[0].values;
  checkEnum(desc.rows, 2, "desc.rows");
  copies = layers > 1 || desc.rows != GRISAILLE_HOST_ROWS_FROM_TOP;
  if (desc.output_count > 0) present(desc.outputs, "desc.outputs");
  for (uint32_t i = 0; i < desc.output_count; ++i) {
    outputs |=
        1u << indexOf(values.effect(), &present(desc.outputs[i], "an entry of desc.outputs"));
  }
  if (desc.output_count == 0) outputs = 1;
  if (desc.setting_count > 0) present(desc.settings, "desc.settings");
  for (uint32_t i = 0; i < desc.setting_count; ++i) {
    const grisaille_host_setting& one = desc.settings[i];
    values.set(&present(one.key, "the key of a setting"),
               std::string_view(&present(one.text, "the text of a setting")));
  }
}

gpu::MemoryUse memoryNeeded(const grisaille_host_device& device,
                            const grisaille_host_effect_desc& desc,
                            const grisaille_host_prepare& how) {
  device.gpu->requireUsable();
  checkPrepare(how);
  const Wanted wanted(device, desc);
  checkSize(device, desc.width, desc.height);
  gpu::MemoryUse use = neededOf(*device.gpu, wanted.chain.selection.entries()[0].values, {},
                                {.width = desc.width,
                                 .height = desc.height,
                                 .wanted = wanted.outputs,
                                 .inputs = how.inputs,
                                 .orthographic = how.orthographic != 0,
                                 .copies = wanted.copies,
                                 .layers = wanted.layers})
                           .memory;
  use.hostBytes *= device.framesInFlight;
  return use;
}

}  // namespace grisaille::host
