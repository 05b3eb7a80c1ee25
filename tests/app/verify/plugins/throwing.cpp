// SPDX-License-Identifier: MIT
// An effect that does not use the C++ wrapper. -DTHROWS_IN_... selects the function that throws an
// exception. KEY is its key.
#include <exception>

#include "grisaille/effect.h"

namespace {

// The text lies in the plugin and cannot be read after unloading.
struct Thrown : std::exception {
  const char* what() const noexcept override { return "thrown on purpose"; }
};

uint32_t reads(const double*, uint32_t) {
#if defined(THROWS_IN_READS)
  throw Thrown();
#endif
  return 0;
}

grisaille_result create(const grisaille_host*, void** out) {
#if defined(THROWS_IN_CREATE)
  throw Thrown();
#endif
  *out = nullptr;
  return GRISAILLE_OK;
}

grisaille_result record(void*, const grisaille_frame* frame) {
#if defined(THROWS_IN_RECORD)
  frame->begin_pass(frame, "left open");
  throw Thrown();
#endif
  static_cast<void>(frame);
  return GRISAILLE_OK;
}

void destroy(void*) {
#if defined(THROWS_IN_DESTROY)
  throw Thrown();
#endif
}

constexpr grisaille_output_desc kOutputs[] = {{
    .struct_size = sizeof(grisaille_output_desc),
    .format = GRISAILLE_FORMAT_R32F,
    .role = GRISAILLE_ROLE_VISIBILITY,
    .key = "none",
    .tooltip = "Never written",
}};

constexpr grisaille_effect_desc kEffect = {
    .struct_size = sizeof(grisaille_effect_desc),
    .param_count = 0,
    .output_count = 1,
    .flags = 0,
    .key = KEY,
    .label = "Throwing",
    .version = "1.0.0",
    .tooltip = "Throws",
    .params = nullptr,
    .outputs = kOutputs,
    .reads = reads,
    .create = create,
    .record = record,
    .destroy = destroy,
    .guard_band = nullptr,
    .objects = nullptr,
    .draw_at = nullptr,
    .needs = 0,
    .input_count = 0,
    .inputs = nullptr,
};

constexpr const grisaille_effect_desc* kEffects[] = {&kEffect};

}  // namespace

extern "C" {
extern GRISAILLE_EXPORT const grisaille_plugin_desc grisaille_plugin;
const grisaille_plugin_desc grisaille_plugin = {
    GRISAILLE_MAGIC, GRISAILLE_ABI_MAJOR, GRISAILLE_ABI_MINOR, sizeof(grisaille_plugin_desc), 1, 0,
    kEffects};
}
