// SPDX-License-Identifier: MIT
// A desktop portal for tests: answers every request for a file with the URI of its argument, or as
// if the user had cancelled if it is empty. Uses sd-bus as the viewer does, without its header.
#include <dlfcn.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

static const char* uri;
static void* library;

static void* find(const char* name) {
  return dlsym(library, name);
}

static int answer(void* message, void* bus, void* error) {
  (void)error;
  int (*isCall)(void*, const char*, const char*) = find("sd_bus_message_is_method_call");
  const char* (*sender)(void*) = find("sd_bus_message_get_sender");
  int (*reply)(void*, const char*, ...) = find("sd_bus_reply_method_return");
  int (*emit)(void*, const char*, const char*, const char*, const char*, ...) =
      find("sd_bus_emit_signal");
  if (isCall(message, "org.freedesktop.portal.FileChooser", "OpenFile") <= 0) return 0;
  char path[256];
  snprintf(path, sizeof path, "/org/freedesktop/portal/desktop/request/%s/grisaille",
           sender(message) + 1);
  for (char* c = path; *c != 0; ++c) {
    if (*c == '.') *c = '_';
  }
  reply(message, "o", path);
  if (*uri != 0) {
    emit(bus, path, "org.freedesktop.portal.Request", "Response", "ua{sv}", 0u, 2, "choices",
         "a(ss)", 0, "uris", "as", 1, uri);
  } else {
    emit(bus, path, "org.freedesktop.portal.Request", "Response", "ua{sv}", 1u, 0);
  }
  return 1;
}

int main(int count, char** words) {
  void* bus = NULL;
  uri = count > 1 ? words[1] : "";
  library = dlopen("libsystemd.so.0", RTLD_NOW);
  if (library == NULL) return 1;
  int (*open)(void**) = find("sd_bus_open_user");
  int (*add)(void*, void**, const char*, void*, void*) = find("sd_bus_add_object");
  int (*request)(void*, const char*, uint64_t) = find("sd_bus_request_name");
  int (*process)(void*, void**) = find("sd_bus_process");
  int (*wait)(void*, uint64_t) = find("sd_bus_wait");
  if (open(&bus) < 0 || add(bus, NULL, "/org/freedesktop/portal/desktop", answer, bus) < 0 ||
      request(bus, "org.freedesktop.portal.Desktop", 0) < 0) {
    return 1;
  }
  puts("ready");
  fflush(stdout);
  for (;;) {
    const int done = process(bus, NULL);
    if (done < 0 || (done == 0 && wait(bus, UINT64_MAX) < 0)) return 0;
  }
}
