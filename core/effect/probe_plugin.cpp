// SPDX-License-Identifier: MIT
// grisaille_probe_plugin FILE: loads, checks and unloads a plugin, and says by its exit status that
// it got as far as that. See probe.h.
#include <sys/resource.h>
#include <unistd.h>

#include "core/effect/probe.h"
#include "core/effect/registry.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const rlimit none = {0, 0};
  setrlimit(RLIMIT_CORE, &none);  // nobody looks into a crash that was expected
  try {
    grisaille::effect::Registry().load(argv[1]);
  } catch (const grisaille::Error&) {
    // Refused in good order.
  }
  _exit(grisaille::effect::kProbeSurvived);  // past what the plugin left for the end
}
