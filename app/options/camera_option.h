// SPDX-License-Identifier: MIT
// Parses a camera of the command line.
#pragma once

#include <string>

#include "core/scene/camera.h"

namespace grisaille::app {

inline bool isInlineCamera(const std::string& text) {
  return text.starts_with('{');
}

// `text`: the path of a camera file or, if it begins with '{', the file's JSON. `option`: for
// messages. Throws as scene::parseCamera() and scene::loadCamera() do.
inline scene::Camera cameraOf(const std::string& text, const std::string& option) {
  return isInlineCamera(text) ? scene::parseCamera(text, option) : scene::loadCamera(text);
}

}  // namespace grisaille::app
