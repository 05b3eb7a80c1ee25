// SPDX-License-Identifier: MIT
// Output files that are whole or not there.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace grisaille::image {

// Calls `writer` with the name of a part file beside `path` ("<path>.<pid>.part<ending>", so that
// the ending still tells the format), then renames the part to `path`. Whatever fails, the part is
// removed and an older `path` stays as it was. Throws kFileUnwritable, and what `writer` throws.
void writeAside(const std::string& path,
                const std::function<void(const std::string& part)>& writer);

// The same for content that is in memory already.
void writeFileAside(const std::string& path, std::string_view content);

}  // namespace grisaille::image
