// SPDX-License-Identifier: MIT
// In sanitizer builds alone. Mesa's software driver (22.3) keeps two blocks that its globals point
// to. A window's end unloads it, and then nothing does: it stays.
#include <dlfcn.h>

extern "C" {

// Named on the link line, so that every program with this backend has this file.
extern const bool grisaille_opengl_keeps_libraries;
const bool grisaille_opengl_keeps_libraries =
    dlopen("/usr/lib/" LIBRARY_ARCHITECTURE "/dri/swrast_dri.so",
           RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE) != nullptr;

}  // extern "C"
