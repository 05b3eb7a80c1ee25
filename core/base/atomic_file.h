// SPDX-License-Identifier: MIT
// Atomic writes: an output file is complete or does not exist.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace grisaille {

// Writes `content` to a temporary file beside the target, "<target>.<pid>.part", then renames it to
// the target. The target is `path`, or the file that its symbolic links lead to: the links stay,
// and a missing target is created. If a step fails, the function removes the temporary file and
// leaves an older target unchanged. A process killed during the write leaves its temporary file; no
// reader looks for files with that ending.
//
// A replaced target keeps its permission bits and, if the system allows it, its owner and group; a
// new target gets 0666 minus the umask. The function never replaces a device, named pipe or socket:
// it writes `content` into it, and for a named pipe waits for the reader. If standard output or
// standard error is redirected to the target, it writes through that stream, after earlier output.
//
// Throws kFileUnwritable.
void writeFileAtomically(const std::string& path, std::string_view content);

// Checks, before long work, that a file can be written at `path`, or into `folder`, which may be
// missing if it can be created. Existing files and folders stay unchanged. Throws kFileUnwritable.
void requireWritable(const std::string& path);
void requireWritableFolder(const std::string& folder);

// The absolute path, without links, of the file that writeFileAtomically() writes: equal for two
// paths exactly if they name the same file. Throws kFileUnwritable if the links form a cycle.
std::filesystem::path targetOf(const std::string& path);

}  // namespace grisaille
