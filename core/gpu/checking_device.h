// SPDX-License-Identifier: MIT
// A device that validates every call, then forwards it to another device. An invalid call throws a
// numbered error and is not forwarded. The checking device keeps its own records of every resource,
// which makes its checks the same for every backend.
#pragma once

#include "core/gpu/host_device.h"

namespace grisaille::gpu {

// The destructor reports every resource that was not destroyed, with its label, as kLeaked.
// `message`: receives these reports; empty: standard error.
std::unique_ptr<Device> makeCheckingDevice(std::unique_ptr<Device> device, MessageSink message);
std::unique_ptr<HostDevice> makeCheckingHostDevice(std::unique_ptr<HostDevice> device,
                                                   MessageSink message);

}  // namespace grisaille::gpu
