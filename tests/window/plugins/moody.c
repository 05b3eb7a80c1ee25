/* SPDX-License-Identifier: MIT
 *
 * moody cannot record a frame while the file that $MOODY names exists. Otherwise it says that all
 * is visible. needy is the same, and reads moody's output by name. */
#include <stdlib.h>
#include <unistd.h>

#include "grisaille/effect.h"

static uint32_t reads(const double* values, uint32_t wanted) {
  (void)wanted;
  (void)values;
  return 0;
}

static grisaille_result create(const grisaille_host* host, void** out) {
  (void)host;
  *out = NULL;
  return GRISAILLE_OK;
}

static grisaille_result record(void* instance, const grisaille_frame* frame) {
  const uint64_t count = (uint64_t)frame->width * frame->height;
  const char* file = getenv("MOODY");
  grisaille_result result = GRISAILLE_OK;
  float* texels = NULL;
  uint64_t i = 0;
  (void)instance;
  if (file != NULL && access(file, F_OK) == 0) return GRISAILLE_FAILED;
  if ((frame->wanted & 1) == 0) return GRISAILLE_OK;
  texels = malloc(count * sizeof(float));
  if (texels == NULL) return GRISAILLE_FAILED;
  for (i = 0; i < count; ++i) texels[i] = 1;
  result = frame->upload_texture(frame, frame->outputs[0], 0, 0, texels, count * sizeof(float));
  free(texels);
  return result;
}

static void destroy(void* instance) {
  (void)instance;
}

/* Names and tooltips that are longer than the panel is wide. */
static const grisaille_param_desc kParams[] = {{
    .struct_size = sizeof(grisaille_param_desc),
    .type = GRISAILLE_PARAM_FLOAT,
    .key = "patience",
    .label = "Patience with the people who use this program all day long and into the night",
    .unit = "",
    .tooltip =
        "How long it takes until this effect loses its patience, which it does without a warning: "
        "a tooltip that no window of a few hundred pixels can show on one line of text, however "
        "small that text may be",
    .hard_min = 0,
    .hard_max = 1,
    .soft_min = 0,
    .soft_max = 1,
    .default_value = 0.5,
    .step = 0.1,
}};

static const grisaille_output_desc kOutputs[] = {{
    .struct_size = sizeof(grisaille_output_desc),
    .format = GRISAILLE_FORMAT_R32F,
    .role = GRISAILLE_ROLE_VISIBILITY,
    .key = "all",
    .tooltip = "One everywhere",
}};

static const grisaille_effect_desc kEffect = {
    .struct_size = sizeof(grisaille_effect_desc),
    .param_count = 1,
    .output_count = 1,
    .key = "moody",
    .label = "Moody",
    .version = "1.0.0",
    .tooltip = "Fails on request",
    .params = kParams,
    .outputs = kOutputs,
    .reads = reads,
    .create = create,
    .record = record,
    .destroy = destroy,
};

static const grisaille_input_desc kInputs[] = {{
    .struct_size = sizeof(grisaille_input_desc),
    .flags = GRISAILLE_INPUT_REQUIRED,
    .key = "moody.all",
    .tooltip = "What moody says",
}};

static const grisaille_effect_desc kNeedy = {
    .struct_size = sizeof(grisaille_effect_desc),
    .output_count = 1,
    .key = "needy",
    .label = "Needy",
    .version = "1.0.0",
    .tooltip = "Needs moody",
    .outputs = kOutputs,
    .reads = reads,
    .create = create,
    .record = record,
    .destroy = destroy,
    .input_count = 1,
    .inputs = kInputs,
};

static const grisaille_effect_desc* const kEffects[] = {&kEffect, &kNeedy};

GRISAILLE_EXPORT const grisaille_plugin_desc grisaille_plugin = {
    GRISAILLE_MAGIC, GRISAILLE_ABI_MAJOR, GRISAILLE_ABI_MINOR, sizeof(grisaille_plugin_desc), 2, 0,
    kEffects};
