/* SPDX-License-Identifier: MIT
 * Preloaded into the program, makes dlopen fail for libraries with $HIDE_LIBRARY in their name. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

__attribute__((visibility("default"))) void* dlopen(const char* name, int flags) {
  void* (*next)(const char*, int) = (void* (*)(const char*, int))dlsym(RTLD_NEXT, "dlopen");
  const char* hidden = getenv("HIDE_LIBRARY");
  if (name != NULL && hidden != NULL && strstr(name, hidden) != NULL) name = "hidden by a test";
  return next(name, flags);
}
