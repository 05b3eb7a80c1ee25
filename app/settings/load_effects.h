// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/effect/registry.h"

namespace grisaille::app {

// Loads every effect of effect::searchPaths(pluginPaths).
std::unique_ptr<effect::Registry> loadEffects(const std::vector<std::string>& pluginPaths);

}  // namespace grisaille::app
