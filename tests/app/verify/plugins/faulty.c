/* SPDX-License-Identifier: MIT
 *
 * An effect that `grisaille effects --verify` passes or, with -DFAULT_..., fails. Most faults show
 * with the parameter at its maximum. Exceptions: the effects that never write or never finish
 * create(), and the one that fails between the default and the maximum. KEY is its key. */
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "grisaille/effect.h"

static uint32_t reads(const double* values, uint32_t wanted) {
  (void)wanted;
  (void)values;
  return 0;
}

static grisaille_result create(const grisaille_host* host, void** out) {
#if defined(FAULT_UNMADE)
  for (;;) pause();
#endif
  *out = (void*)host;
  return GRISAILLE_OK;
}

static float valueAt(double level) {
#if defined(FAULT_BETWEEN)
  if (level > 0.5 && level < 1) return NAN;
#endif
  if (level < 1) return (float)level;
#if defined(FAULT_CRASHES)
  raise(SIGABRT);
#elif defined(FAULT_EXITS)
  _exit(0);
#elif defined(FAULT_NAN)
  return NAN;
#elif defined(FAULT_RANGE)
  return 2;
#elif defined(FAULT_HANGS)
  for (;;) pause();
#endif
  return 1;
}

/* Faults of every frame. */
static grisaille_result harm(const grisaille_host* host, const grisaille_frame* frame,
                             float* first) {
  (void)host;
  (void)frame;
  (void)first;
#if defined(FAULT_LEAKS)
  if (malloc(1 << 20) == NULL) return GRISAILLE_FAILED;
#elif defined(FAULT_CLOCK)
  *first = (float)(time(NULL) % 64) / 64;
#elif defined(FAULT_REMEMBERS)
  *first = (float)(frame->index % 64) / 64;
#elif defined(FAULT_HOARDS)
  const grisaille_texture_desc desc = {.struct_size = sizeof(desc),
                                       .format = GRISAILLE_FORMAT_R8,
                                       .usage = GRISAILLE_TEXTURE_SAMPLED,
                                       .width = 4,
                                       .height = 4};
  grisaille_texture made = {0};
  return host->create_texture(host, &desc, &made);
#endif
  return GRISAILLE_OK;
}

static grisaille_result record(void* instance, const grisaille_frame* frame) {
  const uint64_t bytes = (uint64_t)frame->width * frame->height * sizeof(float);
  float first = valueAt(frame->values[0]);
  grisaille_result result = GRISAILLE_OK;
  float* texels = NULL;
  if (harm(instance, frame, &first) != GRISAILLE_OK) return GRISAILLE_FAILED;
#if defined(FAULT_LEAVES)
  return GRISAILLE_OK;
#endif
  if ((frame->wanted & 1) == 0) return GRISAILLE_OK;
  texels = calloc(1, bytes);
  if (texels == NULL) return GRISAILLE_FAILED;
  texels[0] = first;
  result = frame->upload_texture(frame, frame->outputs[0], 0, 0, texels, bytes);
  free(texels);
  return result;
}

static void destroy(void* instance) {
  (void)instance;
}

static const grisaille_param_desc kParams[] = {{
    .struct_size = sizeof(grisaille_param_desc),
    .type = GRISAILLE_PARAM_FLOAT,
    .key = "level",
    .label = "Level",
    .unit = "",
    .tooltip = "The first texel",
    .hard_min = 0,
    .hard_max = 1,
    .soft_min = 0,
    .soft_max = 1,
    .default_value = 0.25,
    .step = 0.125,
}};

static const grisaille_output_desc kOutputs[] = {{
    .struct_size = sizeof(grisaille_output_desc),
    .format = GRISAILLE_FORMAT_R32F,
    .role = GRISAILLE_ROLE_VISIBILITY,
    .key = "first",
    .tooltip = "Zero, but for the first texel",
}};

static const grisaille_effect_desc kEffect = {
    .struct_size = sizeof(grisaille_effect_desc),
    .param_count = 1,
    .output_count = 1,
    .key = KEY,
    .label = "Faulty",
    .version = "1.0.0",
    .tooltip = "Writes one texel",
    .params = kParams,
    .outputs = kOutputs,
    .reads = reads,
    .create = create,
    .record = record,
    .destroy = destroy,
};

static const grisaille_effect_desc* const kEffects[] = {&kEffect};

GRISAILLE_EXPORT const grisaille_plugin_desc grisaille_plugin = {
    GRISAILLE_MAGIC, GRISAILLE_ABI_MAJOR, GRISAILLE_ABI_MINOR, sizeof(grisaille_plugin_desc), 1, 0,
    kEffects};
