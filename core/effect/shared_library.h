// SPDX-License-Identifier: MIT
// Loads shared libraries, from files that may have any content.
#pragma once

#include <memory>
#include <string>

namespace grisaille::effect {

struct CloseLibrary {
  void operator()(void* library) const;
};
using Library = std::unique_ptr<void, CloseLibrary>;

// Throws kPluginUnloadable with the loader's message.
Library openLibrary(const std::string& path);

// Throws kPluginSymbol.
const void* symbolOf(const Library& library, const char* name);

}  // namespace grisaille::effect
