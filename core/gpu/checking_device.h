// SPDX-License-Identifier: MIT
// A device that validates every call before it passes it on to another, and says what is wrong with
// a numbered error. It holds its own account of every resource, so that it checks every backend
// alike.
#pragma once

#include "core/gpu/device.h"

namespace grisaille::gpu {

// At destruction, resources that were not destroyed are reported to `message` (none: standard
// error) as kLeaked, by label.
std::unique_ptr<Device> makeCheckingDevice(std::unique_ptr<Device> device, MessageSink message);

}  // namespace grisaille::gpu
