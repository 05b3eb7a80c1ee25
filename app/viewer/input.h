// SPDX-License-Identifier: MIT
// Hands keys and pointer to Dear ImGui. This is the only file that differs between its
// releases 1.86 to 1.91. Keys have GLFW's numbers, GLFW_KEY_SPACE to GLFW_KEY_LAST. Every function
// needs a current ImGui context.
#pragma once

#include <glm/glm.hpp>

namespace grisaille::app::viewer {

// Call once for each context, before its first frame. Every frame then takes all events sent before
// it.
void prepareInput();

// Call before ImGui::NewFrame(). `place`: window coordinates; `button`: 0 to 4.
void sendKey(int key, bool down);
void sendModifiers(bool ctrl, bool shift, bool alt, bool super);
void sendPointer(glm::dvec2 place);
void sendButton(int button, bool down);
void sendWheel(glm::dvec2 notches);

// Call between ImGui::NewFrame() and ImGui::Render(). `repeats`: also true at each repeat of a key
// that is held.
bool isKeyPressed(int key, bool repeats = false);
bool isKeyDown(int key);

}  // namespace grisaille::app::viewer
