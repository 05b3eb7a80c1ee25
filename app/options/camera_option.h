// SPDX-License-Identifier: MIT
// A camera as the command line gives it.
#pragma once

#include <string>

#include "core/scene/camera.h"

namespace grisaille::app {

inline bool isInlineCamera(const std::string& text) {
  return text.starts_with('{');
}

// A camera file or, beginning with '{', what would be in one. `option` is for messages. Throws as
// scene::parseCamera() and scene::loadCamera() do.
inline scene::Camera cameraOf(const std::string& text, const std::string& option) {
  return isInlineCamera(text) ? scene::parseCamera(text, option) : scene::loadCamera(text);
}

}  // namespace grisaille::app
