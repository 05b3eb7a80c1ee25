// SPDX-License-Identifier: MIT
// The names of the two sides, drawn over a split picture.
#pragma once

#include <glm/glm.hpp>

#include "app/viewer/panel.h"

namespace grisaille::app::viewer {

// Call between ImGui::NewFrame() and ImGui::Render(), for a split picture.
// corner, size: the picture's rectangle, in the window's units
void drawSideLabels(const Session& session, const Status& status, glm::vec2 corner, glm::vec2 size,
                    Layout& layout);

}  // namespace grisaille::app::viewer
