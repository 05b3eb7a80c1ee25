// SPDX-License-Identifier: MIT
#include "app/viewer/portal.h"

#include <dlfcn.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>

namespace grisaille::app::viewer {
namespace {

constexpr uint64_t kLook = 100'000;  // microseconds between two looks at givenUp_
constexpr const char* kPortal = "org.freedesktop.portal.Desktop";
constexpr const char* kPath = "/org/freedesktop/portal/desktop";
constexpr const char* kToken = "grisaille";

// sd-bus, as systemd/sd-bus.h declares it: its header is not needed to build.
struct sd_bus;
struct sd_bus_message;
struct BusError {
  const char *name, *message;
  int need_free;
};
using Handler = int (*)(sd_bus_message*, void*, BusError*);

struct Library {
  void* handle = dlopen("libsystemd.so.0", RTLD_NOW | RTLD_LOCAL);
  int (*open)(sd_bus**) = find<decltype(open)>("sd_bus_open_user");
  int (*uniqueName)(sd_bus*, const char**) = find<decltype(uniqueName)>("sd_bus_get_unique_name");
  int (*match)(sd_bus*, void**, const char*, const char*, const char*, const char*, Handler,
               void*) = find<decltype(match)>("sd_bus_match_signal");
  int (*call)(sd_bus*, const char*, const char*, const char*, const char*, BusError*,
              sd_bus_message**, const char*, ...) = find<decltype(call)>("sd_bus_call_method");
  int (*process)(sd_bus*, sd_bus_message**) = find<decltype(process)>("sd_bus_process");
  int (*wait)(sd_bus*, uint64_t) = find<decltype(wait)>("sd_bus_wait");
  sd_bus* (*close)(sd_bus*) = find<decltype(close)>("sd_bus_flush_close_unref");
  int (*read)(sd_bus_message*, const char*, ...) = find<decltype(read)>("sd_bus_message_read");
  int (*skip)(sd_bus_message*, const char*) = find<decltype(skip)>("sd_bus_message_skip");
  int (*enter)(sd_bus_message*, char,
               const char*) = find<decltype(enter)>("sd_bus_message_enter_container");
  int (*leave)(sd_bus_message*) = find<decltype(leave)>("sd_bus_message_exit_container");

  Library() = default;
  ~Library() {
    if (handle != nullptr) dlclose(handle);
  }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

 private:
  template <typename Function>
  Function find(const char* name) {
    void* found = handle == nullptr ? nullptr : dlsym(handle, name);
    if (found == nullptr && handle != nullptr) {
      dlclose(handle);
      handle = nullptr;
    }
    return reinterpret_cast<Function>(found);
  }
};

// The answer to the request.
struct Answer {
  const Library& bus;
  bool here = false;
  std::string path;
};

// Reads (u response, a{sv} results): the first URI of "uris".
int takeResponse(sd_bus_message* message, void* data, BusError*) {
  Answer& answer = *static_cast<Answer*>(data);
  const Library& bus = answer.bus;
  answer.here = true;
  uint32_t response = 1;
  if (bus.read(message, "u", &response) < 0 || response != 0) return 0;
  if (bus.enter(message, 'a', "{sv}") < 0) return 0;
  while (bus.enter(message, 'e', "sv") > 0) {
    const char *key = "", *uri = nullptr;
    if (bus.read(message, "s", &key) < 0) return 0;
    if (std::string(key) != "uris") {
      if (bus.skip(message, "v") < 0) return 0;
    } else {
      if (bus.enter(message, 'v', "as") < 0 || bus.enter(message, 'a', "s") < 0) return 0;
      if (bus.read(message, "s", &uri) > 0) answer.path = pathOfUri(uri).value_or("");
      return 0;
    }
    if (bus.leave(message) < 0) return 0;
  }
  return 0;
}

bool hasBus() {
  const char* address = std::getenv("DBUS_SESSION_BUS_ADDRESS");
  if (address != nullptr) return *address != '\0';
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  return runtime != nullptr && access((std::string(runtime) + "/bus").c_str(), F_OK) == 0;
}

// The object that announces the answer: the caller's name without ':' and with '_' for '.'.
std::string requestPath(const char* name) {
  std::string sender = *name == ':' ? name + 1 : name;
  for (char& c : sender) c = c == '.' ? '_' : c;
  return std::string(kPath) + "/request/" + sender + "/" + kToken;
}

Portal::Outcome ask(const std::atomic<bool>& givenUp) {
  if (!hasBus()) return {.missing = true, .path = {}};
  const Library library;
  if (library.handle == nullptr) return {.missing = true, .path = {}};
  sd_bus* bus = nullptr;
  if (library.open(&bus) < 0) return {.missing = true, .path = {}};
  Answer answer{library, false, {}};
  const char* name = "";
  const bool asked =
      library.uniqueName(bus, &name) >= 0 &&
      library.match(bus, nullptr, kPortal, requestPath(name).c_str(),
                    "org.freedesktop.portal.Request", "Response", takeResponse, &answer) >= 0 &&
      library.call(bus, kPortal, kPath, "org.freedesktop.portal.FileChooser", "OpenFile", nullptr,
                   nullptr, "ssa{sv}", "", "Open", 2, "handle_token", "s", kToken, "filters",
                   "a(sa(us))", 2, "Scenes, settings, sessions", 4, 0u, "*.glb", 0u, "*.gltf", 0u,
                   "*.toml", 0u, "*.json", "All files", 1, 0u, "*") >= 0;
  while (asked && !answer.here && !givenUp) {
    const int done = library.process(bus, nullptr);
    if (done < 0 || (done == 0 && library.wait(bus, kLook) < 0)) break;
  }
  library.close(bus);
  return {.missing = !asked, .path = answer.path};
}

}  // namespace

std::optional<std::string> pathOfUri(const std::string& uri) {
  const std::string scheme = "file://";
  if (!uri.starts_with(scheme)) return std::nullopt;
  const size_t slash = uri.find('/', scheme.size());
  if (slash == std::string::npos) return std::nullopt;
  std::string path;
  for (size_t i = slash; i < uri.size(); ++i) {
    const std::string digits = uri.substr(i + 1, 2);
    const bool coded = uri[i] == '%' && digits.size() == 2 &&
                       digits.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos;
    path += coded ? static_cast<char>(std::strtol(digits.c_str(), nullptr, 16)) : uri[i];
    if (coded) i += 2;
  }
  return path;
}

Portal::~Portal() {
  *givenUp_ = true;
  if (result_.valid()) result_.wait();
}

bool Portal::start() {
  if (result_.valid()) return false;
  result_ = std::async(std::launch::async, [stop = givenUp_] { return ask(*stop); });
  return true;
}

std::optional<Portal::Outcome> Portal::take() {
  if (!result_.valid() || result_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    return std::nullopt;
  }
  return result_.get();
}

}  // namespace grisaille::app::viewer
