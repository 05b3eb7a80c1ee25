// SPDX-License-Identifier: MIT
#include "backends/opengl/adapters.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

#include "backends/opengl/context.h"
#include "core/base/error.h"

namespace grisaille::opengl {
namespace {

constexpr EGLint kMaxDevices = 64;

struct Display {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLDeviceEXT device = EGL_NO_DEVICE_EXT;  // none if EGL cannot query it
};

// Loads the first library of the list that is installed; it is never unloaded. Returns false if
// none is.
bool loads(std::initializer_list<const char*> names) {
  return std::any_of(names.begin(), names.end(), [](const char* name) {
    return dlopen(name, RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE) != nullptr;
  });
}

// libepoxy ends the process if one of these libraries is missing.
void requireLibraries() {
  if (!loads({"libEGL.so.1"})) {
    throw Error(ErrorId::kBackendMissing, "OpenGL needs libEGL.so.1, which is not installed");
  }
  if (!loads({"libOpenGL.so.0", "libGL.so.1"})) {
    throw Error(ErrorId::kBackendMissing,
                "OpenGL needs libOpenGL.so.0 or libGL.so.1, and neither is installed");
  }
}

bool hasClientExtension(const char* name) {
  return epoxy_has_egl_extension(nullptr, name);
}

EGLDeviceEXT deviceOf(EGLDisplay display) {
  EGLAttrib device = 0;
  if (!hasClientExtension("EGL_EXT_device_query") && !hasClientExtension("EGL_EXT_device_base")) {
    return EGL_NO_DEVICE_EXT;
  }
  if (!eglQueryDisplayAttribEXT(display, EGL_DEVICE_EXT, &device)) return EGL_NO_DEVICE_EXT;
  return reinterpret_cast<EGLDeviceEXT>(device);
}

// The surfaceless display comes first, because the driver chose its device. Every other EGL device
// follows.
std::vector<Display> openDisplays() {
  std::vector<Display> displays;
  const auto open = [&](EGLenum platform, void* native) {
    // Not eglGetPlatformDisplay(): libepoxy 1.5.10 aborts in it, because it has no display yet on
    // which to check for EGL 1.5.
    const EGLDisplay display = eglGetPlatformDisplayEXT(platform, native, nullptr);
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) return;
    displays.push_back({display, native != nullptr ? native : deviceOf(display)});
  };
  if (!hasClientExtension("EGL_EXT_platform_base")) return displays;
  if (hasClientExtension("EGL_MESA_platform_surfaceless")) {
    open(EGL_PLATFORM_SURFACELESS_MESA, nullptr);
  }
  const bool enumerates =
      hasClientExtension("EGL_EXT_device_enumeration") || hasClientExtension("EGL_EXT_device_base");
  if (!enumerates || !hasClientExtension("EGL_EXT_platform_device")) return displays;
  EGLDeviceEXT devices[kMaxDevices];
  EGLint count = 0;
  if (!eglQueryDevicesEXT(kMaxDevices, devices, &count)) return displays;
  for (EGLint i = 0; i < count; ++i) {
    const bool known = std::any_of(displays.begin(), displays.end(),
                                   [&](const Display& d) { return d.device == devices[i]; });
    if (!known) open(EGL_PLATFORM_DEVICE_EXT, devices[i]);
  }
  return displays;
}

std::string lowered(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

bool isSoftware(std::string_view renderer) {
  const std::string name = lowered(renderer);
  for (const char* software : {"llvmpipe", "softpipe", "swrast", "software rasterizer"}) {
    if (name.find(software) != std::string::npos) return true;
  }
  return false;
}

std::string glString(GLenum what) {
  const GLubyte* text = glGetString(what);
  return text == nullptr ? "unknown" : reinterpret_cast<const char*>(text);
}

std::optional<Adapter> probe(EGLDisplay display, ContextKind kind) {
  try {
    Context context(display, kind);
    context.makeCurrent();
    Adapter adapter = currentAdapter();
    adapter.display = display;
    return adapter;
  } catch (const Error&) {
    return std::nullopt;  // a display without OpenGL does not count as a device
  }
}

std::vector<Adapter> probeAll() {
  requireLibraries();
  const CurrentContextGuard guard;
  std::vector<Adapter> found;
  for (const Display& display : openDisplays()) {
    std::optional<Adapter> adapter = probe(display.display, ContextKind::kCore);
    if (!adapter) adapter = probe(display.display, ContextKind::kAny);
    if (!adapter) continue;
    // EGL gives the software driver for every device without a driver of its own: list it once.
    const bool again = adapter->listed.software &&
                       std::any_of(found.begin(), found.end(), [&](const Adapter& other) {
                         return other.listed.name == adapter->listed.name;
                       });
    if (!again) found.push_back(*std::move(adapter));
  }
  return found;
}

// Order of preference when the user names no device.
int rank(const Adapter& adapter) {
  return (adapter.version >= 45 ? 2 : 0) + (adapter.listed.software ? 0 : 1);
}

std::string listing(const std::vector<Adapter>& found) {
  std::string text;
  for (size_t i = 0; i < found.size(); ++i) {
    text += fmt::format("{}{} '{}'", i == 0 ? "" : ", ", i, found[i].listed.name);
  }
  return text;
}

// `wanted` as a device number; none if it is not a number, SIZE_MAX if the number is too large.
std::optional<size_t> numberOf(std::string_view wanted) {
  size_t number = 0;
  const char* end = wanted.data() + wanted.size();
  const auto [stop, error] = std::from_chars(wanted.data(), end, number);
  if (stop != end) return std::nullopt;
  return error == std::errc() ? number : SIZE_MAX;
}

}  // namespace

Adapter currentAdapter() {
  Adapter adapter;
  adapter.listed.name = glString(GL_RENDERER);
  adapter.listed.driver = glString(GL_VENDOR) + ", " + glString(GL_VERSION);
  adapter.listed.software = isSoftware(adapter.listed.name);
  adapter.version = epoxy_gl_version();
  return adapter;
}

void requireAdapter(const gpu::ListedDevice& there, std::string_view wanted) {
  if (wanted.empty()) return;
  const bool fits = numberOf(wanted)
                        ? chooseAdapter(wanted).listed.name == there.name
                        : lowered(there.name).find(lowered(wanted)) != std::string::npos;
  if (fits) return;
  throw Error(ErrorId::kNoDevice, "OpenGL draws in the window with '{}', not with '{}'", there.name,
              wanted);
}

const std::vector<Adapter>& adapters() {
  static const std::vector<Adapter> found = probeAll();
  return found;
}

const Adapter& chooseAdapter(std::string_view wanted) {
  const std::vector<Adapter>& found = adapters();
  if (found.empty()) {
    throw Error(ErrorId::kNoDevice, "EGL offers no OpenGL device that works without a display");
  }
  if (wanted.empty()) {
    return *std::max_element(found.begin(), found.end(),
                             [](const Adapter& a, const Adapter& b) { return rank(a) < rank(b); });
  }
  if (const std::optional<size_t> number = numberOf(wanted)) {
    if (*number < found.size()) return found[*number];
  } else {
    const std::string part = lowered(wanted);
    for (const Adapter& adapter : found) {
      if (lowered(adapter.listed.name).find(part) != std::string::npos) return adapter;
    }
  }
  throw Error(ErrorId::kNoDevice, "OpenGL has no device '{}', only {}", wanted, listing(found));
}

}  // namespace grisaille::opengl
