// SPDX-License-Identifier: MIT
// Only in sanitizer builds. Mesa's software driver (22.3) keeps two allocations that only its
// globals point to. Destroying a window unloads the driver, and the allocations then count as
// leaks. This file keeps the driver loaded.
#include <dlfcn.h>

extern "C" {

// The link line names this symbol, so that every program with this backend links this file.
extern const bool grisaille_opengl_keeps_libraries;
const bool grisaille_opengl_keeps_libraries =
    dlopen("/usr/lib/" LIBRARY_ARCHITECTURE "/dri/swrast_dri.so",
           RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE) != nullptr;

}  // extern "C"
