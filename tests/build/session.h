// SPDX-License-Identifier: MIT
// Runs a manual page as one shell session: its blocks in order, in one folder.
#pragma once

#include <filesystem>
#include <string>

namespace grisaille::tests {

// Converts a Markdown file to a bash script. ```sh blocks are copied, "```LANGUAGE FILE" blocks are
// written to that file, "```diff FILE" blocks are applied to it. The script stops at the first
// command that fails.
std::string sessionOf(const std::filesystem::path& manual);

}  // namespace grisaille::tests
