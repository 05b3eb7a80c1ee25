// SPDX-License-Identifier: MIT
// Only in sanitizer builds: suppresses the leaks of two libraries.
// - The validation layer's synchronization validation never frees its record of a command buffer
//   (seen in 1.3.239, for a buffer that was only allocated).
// - Mesa's software driver (22.3) leaves allocations behind: some that its globals point to and, if
//   both backends ran in one process, some that nothing points to.
// The validation layer reports the objects that this backend forgets to destroy. The sanitizer
// matches leaks by library only while the library is loaded, so this file keeps both loaded.
#include <dlfcn.h>

namespace {

bool keep(const char* library) {
  return dlopen(library, RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE) != nullptr;
}

}  // namespace

extern "C" {

// The link line names this symbol, so that every program with this backend links this file.
extern const bool grisaille_vulkan_keeps_libraries;
const bool grisaille_vulkan_keeps_libraries =
    keep("libVkLayer_khronos_validation.so") && keep("libvulkan_lvp.so");

// Functions that the sanitizer looks up by name.
// NOLINTBEGIN(*-reserved-identifier,*-identifier-naming)
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
