// SPDX-License-Identifier: MIT
// Output files that are whole or not there (atomic writes).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace grisaille {

// Writes `content` to a part file beside the target, "<target>.<pid>.part", then renames the part
// to the target. The target is `path`, or what its symbolic links lead to: the links stay, and a
// missing target is created. If anything fails, the part is removed and an older target stays as it
// was. A process that is killed meanwhile leaves its part, whose ending no reader looks for.
//
// A replaced target keeps its permission bits and, where the system allows it, its owner and group;
// a new one gets 0666 less the umask. A device, named pipe or socket is never replaced: `content`
// is written to it, which waits for the reader of a named pipe. The file that standard output or
// standard error goes to is written through that stream, after what was printed before.
//
// Throws kFileUnwritable.
void writeFileAtomically(const std::string& path, std::string_view content);

// Before work that takes long: throws kFileUnwritable where nothing can be written at `path`, or
// into a folder that is there or can be made. What is there stays as it is.
void requireWritable(const std::string& path);
void requireWritableFolder(const std::string& folder);

// The file that writeFileAtomically() writes, with an absolute path and no links in it: equal for
// two paths exactly if they name the same file. Throws kFileUnwritable where the links go in a
// circle.
std::filesystem::path targetOf(const std::string& path);

}  // namespace grisaille
