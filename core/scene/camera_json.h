// SPDX-License-Identifier: MIT
// A camera as JSON that is parsed already: of a file of its own, or of a path's.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/scene/camera.h"

namespace grisaille::scene {

// Throws kCameraInvalid, with `name` before the message.
Camera cameraFromJson(const nlohmann::json& document, const std::string& name);

}  // namespace grisaille::scene
