// SPDX-License-Identifier: MIT
// Readers of files that users name. They refuse named pipes (which may block), devices (which may
// never end) and folders.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "core/base/error.h"

namespace grisaille {

// The reason why the file at `path` cannot be read as a regular file, for messages: "it is a named
// pipe; only regular files are read", or the system's reason, for example that the file is missing.
// "" for a regular file.
std::string whyNotRegular(const std::filesystem::path& path);

// Throws Error(id, "PATH: why") unless `path` names a regular file, directly or through links.
void requireRegularFile(const std::filesystem::path& path, ErrorId id);

// Opens a regular file for reading, as bytes. Throws Error(id, "PATH: why").
std::ifstream openRegularFile(const std::filesystem::path& path, ErrorId id);

// The same if `path` exists; nullopt otherwise.
std::optional<std::ifstream> openRegularFileIfThere(const std::filesystem::path& path, ErrorId id);

// The content of a regular file of at most `mostBytes`. Throws Error(id, "PATH: why").
std::string readRegularFile(const std::filesystem::path& path, ErrorId id,
                            uintmax_t mostBytes = UINTMAX_MAX);

}  // namespace grisaille
