// SPDX-License-Identifier: MIT
// The devices that EGL reaches without a display.
#pragma once

#include <string_view>
#include <vector>

#include "core/gpu/device.h"

namespace grisaille::opengl {

struct Adapter {
  gpu::ListedDevice listed;
  void* display = nullptr;  // EGLDisplay, initialised; never terminated, for others may share it
  int version = 0;          // of OpenGL: 45 for 4.5
};

// All of them, each once; asked of EGL on the first call. Throws kBackendMissing.
const std::vector<Adapter>& adapters();

// "" is the first that will do, hardware before software; else a number, or a part of a name in
// either case. Throws kBackendMissing, kNoDevice.
const Adapter& chooseAdapter(std::string_view wanted);

// The current context's device, which has no display here.
Adapter currentAdapter();

// Throws kNoDevice when `there`, a window's device, is not the wanted one, as above.
void requireAdapter(const gpu::ListedDevice& there, std::string_view wanted);

}  // namespace grisaille::opengl
