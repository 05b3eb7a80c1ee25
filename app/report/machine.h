// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace grisaille::app {

// The processor and how many of it, as the system tells: what a measurement says it was made on.
std::string machineName();

}  // namespace grisaille::app
