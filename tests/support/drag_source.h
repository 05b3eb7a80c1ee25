// SPDX-License-Identifier: MIT
// Drops files on a window, as a file manager does: the source's side of the protocol XDND,
// version 5 (freedesktop.org, "Drag-and-Drop Protocol for the X Window System").
#pragma once

#include <string>
#include <vector>

namespace grisaille::tests {

// Drops `uris` ("file:///a%20b.glb") on the only window of $DISPLAY that takes drops, `x`, `y` of
// the screen. Waits until the window has taken them. Throws std::runtime_error if there is no such
// window, if it refuses, or after 20 seconds.
void dropUris(const std::vector<std::string>& uris, int x, int y);

}  // namespace grisaille::tests
