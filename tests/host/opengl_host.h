// SPDX-License-Identifier: MIT
#pragma once

#include "tests/host/hosts.h"

namespace grisaille::tests {

std::unique_ptr<Host> makeOpenGlHost();

}  // namespace grisaille::tests
