// SPDX-License-Identifier: MIT
// The world's axes, drawn as the camera sees them. A click on an end looks from there; a click on
// the end that faces the user, from the opposite one.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "app/viewer/layout.h"
#include "core/scene/camera.h"

namespace grisaille::app::viewer {

// Width and height of the widget, in the window's units.
float axisWidgetSize();

// Draws the widget. Call between ImGui::NewFrame() and ImGui::Render(). Returns the unit axis whose
// end the user has clicked: the side to look from.
// corner: top right corner of the widget, in the window's units
std::optional<glm::dvec3> drawAxisWidget(const scene::Camera& camera, glm::vec2 corner,
                                         Layout& layout);

}  // namespace grisaille::app::viewer
