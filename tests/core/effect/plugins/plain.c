/* SPDX-License-Identifier: MIT
 *
 * A valid effect in plain C; -DFAULT_... adds one fault. KEY is its key. With -DMARKED it is a
 * default effect: it runs when the user names no effects. */
#include <stdlib.h>

#include "grisaille/effect.h"

#ifndef KEY
#define KEY "plain"
#endif

#ifdef FAULT_NO_RECORD
#define HAS_RECORD 0
#else
#define HAS_RECORD 1
#endif

typedef struct Plain {
  const grisaille_host* host;
  grisaille_buffer left; /* left for the host to destroy */
} Plain;

static uint32_t reads(const double* values, uint32_t wanted) {
  (void)values;
  (void)wanted;
  return 0;
}

static grisaille_result create(const grisaille_host* host, void** out) {
  const grisaille_buffer_desc desc = {sizeof desc, 0, 64, "left"};
  Plain* plain = malloc(sizeof *plain);
  if (plain == NULL) return GRISAILLE_FAILED;
  plain->host = host;
  if (host->create_buffer(host, &desc, &plain->left) != GRISAILLE_OK) {
    free(plain);
    return GRISAILLE_FAILED;
  }
  *out = plain;
  return GRISAILLE_OK;
}

static grisaille_result record(void* instance, const grisaille_frame* frame) {
  const uint64_t bytes = (uint64_t)frame->width * frame->height * sizeof(float);
  grisaille_result result = GRISAILLE_OK;
  float* texels = NULL;
  (void)instance;
  if ((frame->wanted & 1) == 0) return GRISAILLE_OK;
  texels = calloc(1, bytes);
  if (texels == NULL) return GRISAILLE_FAILED;
  texels[0] = (float)frame->values[0];
  result = frame->upload_texture(frame, frame->outputs[0], 0, 0, texels, bytes);
  free(texels);
  return result;
}

static void destroy(void* instance) {
  free(instance);
}

static const grisaille_param_desc kParams[] = {{
    .struct_size = sizeof(grisaille_param_desc),
    .type = GRISAILLE_PARAM_FLOAT,
    .key = "first",
    .label = "First",
    .unit = "",
    .tooltip = "The first texel",
    .hard_min = 0,
#ifdef FAULT_RANGE
    .hard_max = 0.5,
#else
    .hard_max = 1,
#endif
    .soft_min = 0,
    .soft_max = 1,
    .default_value = 0.25,
    .step = 0.125,
}};

static const grisaille_output_desc kOutputs[] = {{
    .struct_size = sizeof(grisaille_output_desc),
    .format = GRISAILLE_FORMAT_R32F,
    .role = GRISAILLE_ROLE_NONE,
    .key = "plain",
#ifdef FAULT_TOOLTIP
    .tooltip = "two\nlines",
#else
    .tooltip = "Zero, but for the first texel",
#endif
}};

static const grisaille_effect_desc kEffect = {
#if defined(FAULT_EFFECT_SIZE)
    .struct_size = sizeof(grisaille_effect_desc) + 8,
#else
    .struct_size = sizeof(grisaille_effect_desc),
#endif
    .param_count = 1,
    .output_count = 1,
#ifdef MARKED
    .flags = GRISAILLE_EFFECT_DEFAULT,
#endif
#ifndef FAULT_NULL_KEY
    .key = KEY,
#endif
    .label = "Plain",
    .version = "1.0.0",
    .tooltip = "Writes one texel",
    .params = kParams,
    .outputs = kOutputs,
    .reads = reads,
    .create = create,
    .record = HAS_RECORD ? record : NULL,
    .destroy = destroy,
};

static const grisaille_effect_desc* const kEffects[] = {&kEffect};

#if defined(FAULT_MAGIC)
#define MAGIC 0x12345678u
#else
#define MAGIC GRISAILLE_MAGIC
#endif
#if defined(FAULT_MAJOR)
#define MAJOR (GRISAILLE_ABI_MAJOR + 1)
#elif defined(FAULT_OLD_MAJOR)
#define MAJOR (GRISAILLE_ABI_MAJOR - 1)
#else
#define MAJOR GRISAILLE_ABI_MAJOR
#endif
#if defined(FAULT_MINOR)
#define MINOR (GRISAILLE_ABI_MINOR + 1)
#else
#define MINOR GRISAILLE_ABI_MINOR
#endif
#if defined(FAULT_SIZE)
#define SIZE sizeof(grisaille_plugin_desc) + 8
#else
#define SIZE sizeof(grisaille_plugin_desc)
#endif
#if defined(FAULT_SYMBOL)
#define SYMBOL grisaille_other
#else
#define SYMBOL grisaille_plugin
#endif

GRISAILLE_EXPORT const grisaille_plugin_desc SYMBOL = {MAGIC, MAJOR, MINOR, SIZE, 1, 0, kEffects};
