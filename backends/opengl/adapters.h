// SPDX-License-Identifier: MIT
// The OpenGL devices that EGL reaches without a display.
#pragma once

#include <string_view>
#include <vector>

#include "core/gpu/device.h"

namespace grisaille::opengl {

struct Adapter {
  gpu::ListedDevice listed;
  void* display = nullptr;  // EGLDisplay, initialised; never terminated: others may share it
  int version = 0;          // of OpenGL: 45 for 4.5
};

// All devices, each once. The first call queries EGL. Throws kBackendMissing.
const std::vector<Adapter>& adapters();

// Chooses a device. `wanted` is "", the device's number, or a part of its name, ignoring case. For
// "" it prefers devices with OpenGL 4.5, then hardware. Throws kBackendMissing, kNoDevice.
const Adapter& chooseAdapter(std::string_view wanted);

// The device of the current context. Its `display` is null.
Adapter currentAdapter();

// Throws kNoDevice if `there`, a window's device, does not match `wanted`; see chooseAdapter().
void requireAdapter(const gpu::ListedDevice& there, std::string_view wanted);

}  // namespace grisaille::opengl
