// SPDX-License-Identifier: MIT
// A shared library as a file that may be anything.
#pragma once

#include <memory>
#include <string>

namespace grisaille::effect {

struct CloseLibrary {
  void operator()(void* library) const;
};
using Library = std::unique_ptr<void, CloseLibrary>;

// Throws kPluginUnloadable with the loader's words.
Library openLibrary(const std::string& path);

// Throws kPluginSymbol.
const void* symbolOf(const Library& library, const char* name);

}  // namespace grisaille::effect
