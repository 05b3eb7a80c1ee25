// SPDX-License-Identifier: MIT
// In sanitizer builds alone. The validation layer's synchronization validation never frees its
// record of a command buffer (seen in 1.3.239, for one that was only allocated), and Mesa's
// software driver (22.3) leaves blocks of its own behind, some that its globals point to and, where
// both backends ran in one process, some that nothing does. Objects that we forget are told by the
// validation layer. Leaks are told apart by library, and that only while it is loaded, so both
// stay.
#include <dlfcn.h>

namespace {

bool keep(const char* library) {
  return dlopen(library, RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE) != nullptr;
}

}  // namespace

extern "C" {

// Named on the link line, so that every program with this backend has this file.
extern const bool grisaille_vulkan_keeps_libraries;
const bool grisaille_vulkan_keeps_libraries =
    keep("libVkLayer_khronos_validation.so") && keep("libvulkan_lvp.so");

// Names that the sanitizer looks for. NOLINTBEGIN(*-reserved-identifier,*-identifier-naming)
__attribute__((visibility("default"))) const char* __lsan_default_suppressions();
const char* __lsan_default_suppressions() {
  return "leak:libVkLayer_khronos_validation\nleak:libvulkan_lvp.so\n";
}

__attribute__((visibility("default"))) const char* __lsan_default_options();
const char* __lsan_default_options() {
  return "print_suppressions=0";
}
// NOLINTEND(*-reserved-identifier,*-identifier-naming)

}  // extern "C"
