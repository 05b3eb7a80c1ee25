// SPDX-License-Identifier: MIT
// A manual as one session at a shell: its blocks in order, in one folder.
#pragma once

#include <filesystem>
#include <string>

namespace grisaille::tests {

// A bash script of a Markdown file: ```sh blocks as they stand, "```LANGUAGE FILE" blocks written
// to that file, "```diff FILE" blocks applied to it. It ends with the first command that fails.
std::string sessionOf(const std::filesystem::path& manual);

}  // namespace grisaille::tests
