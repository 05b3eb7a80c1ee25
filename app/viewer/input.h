// SPDX-License-Identifier: MIT
// Keys and pointer into Dear ImGui, 1.86 to 1.91: the one place that knows how a release takes
// them. Keys have GLFW's numbers (GLFW_KEY_...). Call all of it between the making and the end of
// an ImGui context.
#pragma once

#include <glm/glm.hpp>

namespace grisaille::app::viewer {

// Once, after the context was made: one frame takes all events that come before it.
void prepareInput();

// Before ImGui::NewFrame(). `place`: window coordinates.
void sendKey(int key, bool down);
void sendModifiers(bool ctrl, bool shift, bool alt, bool super);
void sendPointer(glm::dvec2 place);
void sendButton(int button, bool down);  // 0 to 4; others are left out
void sendWheel(glm::dvec2 notches);

// In a frame. `repeats`: also when the key has been held for a while.
bool isKeyPressed(int key, bool repeats = false);
bool isKeyDown(int key);

}  // namespace grisaille::app::viewer
