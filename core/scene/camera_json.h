// SPDX-License-Identifier: MIT
// Reads a camera from parsed JSON: from a camera file, or from an entry of a camera path file.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/scene/camera.h"

namespace grisaille::scene {

// Throws kCameraInvalid. `name` prefixes the message.
Camera cameraFromJson(const nlohmann::json& document, const std::string& name);

}  // namespace grisaille::scene
