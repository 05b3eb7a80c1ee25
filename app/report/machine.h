// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace grisaille::app {

// Names the machine of a measurement: processor, number of hardware threads, system and release.
std::string machineName();

}  // namespace grisaille::app
