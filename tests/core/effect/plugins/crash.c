/* SPDX-License-Identifier: MIT
 *
 * Plugins that end the process while it loads them. -DCRASH_... selects how. */
#include <signal.h>
#include <stdint.h>
#include <unistd.h>

#include "grisaille/effect.h"

__attribute__((constructor)) static void load(void) {
#if defined(CRASH_LOAD)
  raise(SIGABRT);
#elif defined(CRASH_EXIT)
  _exit(0);
#elif defined(CRASH_HANG)
  for (;;) pause();
#endif
}

#if defined(CRASH_UNLOAD)
/* A valid plugin, since only accepted plugins are unloaded. */
#define KEY "crash_unload"
#include "plain.c"

__attribute__((destructor)) static void unload(void) {
  raise(SIGABRT);
}
#else

static const grisaille_effect_desc kEffect = {.struct_size = sizeof kEffect};

#if defined(CRASH_TABLE)
/* An address without memory. */
#define FIRST ((const grisaille_effect_desc*)(uintptr_t)16)
#else
#define FIRST &kEffect
#endif
static const grisaille_effect_desc* const kEffects[] = {FIRST};

GRISAILLE_EXPORT const grisaille_plugin_desc grisaille_plugin = {
    GRISAILLE_MAGIC, GRISAILLE_ABI_MAJOR, GRISAILLE_ABI_MINOR, sizeof(grisaille_plugin_desc), 1, 0,
    kEffects};
#endif
