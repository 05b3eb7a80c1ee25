// SPDX-License-Identifier: MIT
// Output files that are whole or not there.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace grisaille::image {

// Calls `writer` with the name of a part file beside `path`, "<path>.<pid>.part", then renames the
// part to `path`. Whatever fails, the part is removed and an older `path` stays as it was. A
// process that is killed meanwhile leaves its part: no ending that anything is looked for by.
// Throws kFileUnwritable, and what `writer` throws.
void writeAside(const std::string& path,
                const std::function<void(const std::string& part)>& writer);

// The same for content that is in memory already.
void writeFileAside(const std::string& path, std::string_view content);

// Before work that takes long: throws kFileUnwritable where nothing can be written at `path`, or
// into a folder that is there or can be made. What is there stays as it is.
void requireWritable(const std::string& path);
void requireWritableFolder(const std::string& folder);

}  // namespace grisaille::image
