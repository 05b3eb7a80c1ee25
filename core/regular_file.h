// SPDX-License-Identifier: MIT
// Files that are read by path. A named pipe would hold the program up, a device need not end, and a
// folder holds no text: each is refused at once, by name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.h"

namespace grisaille {

// What is at `path` where that is no regular file, for messages: "it is a named pipe; only regular
// files are read", or why nothing is known of it. "" for a regular file.
std::string whyNotRegular(const std::filesystem::path& path);

// Throws Error(id, "PATH: why") unless `path` names a regular file, directly or through links.
void requireRegularFile(const std::filesystem::path& path, ErrorId id);

// Opens a regular file for reading, as bytes. Throws Error(id, "PATH: why").
std::ifstream openRegularFile(const std::filesystem::path& path, ErrorId id);

// The whole of a regular file of at most `mostBytes`. Throws Error(id, "PATH: why").
std::string readRegularFile(const std::filesystem::path& path, ErrorId id,
                            uintmax_t mostBytes = UINTMAX_MAX);

}  // namespace grisaille
