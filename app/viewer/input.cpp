// SPDX-License-Identifier: MIT
#include "app/viewer/input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui/imgui.h>

#include <algorithm>
#include <iterator>

namespace grisaille::app::viewer {

#if IMGUI_VERSION_NUM >= 18700

namespace {

struct NamedKey {
  int glfw;
  ImGuiKey key;
};

// Keys outside the contiguous rows. Letters, digits and function keys are contiguous in GLFW and in
// ImGui.
constexpr NamedKey kKeys[] = {{GLFW_KEY_TAB, ImGuiKey_Tab},
                              {GLFW_KEY_LEFT, ImGuiKey_LeftArrow},
                              {GLFW_KEY_RIGHT, ImGuiKey_RightArrow},
                              {GLFW_KEY_UP, ImGuiKey_UpArrow},
                              {GLFW_KEY_DOWN, ImGuiKey_DownArrow},
                              {GLFW_KEY_PAGE_UP, ImGuiKey_PageUp},
                              {GLFW_KEY_PAGE_DOWN, ImGuiKey_PageDown},
                              {GLFW_KEY_HOME, ImGuiKey_Home},
                              {GLFW_KEY_END, ImGuiKey_End},
                              {GLFW_KEY_INSERT, ImGuiKey_Insert},
                              {GLFW_KEY_DELETE, ImGuiKey_Delete},
                              {GLFW_KEY_BACKSPACE, ImGuiKey_Backspace},
                              {GLFW_KEY_SPACE, ImGuiKey_Space},
                              {GLFW_KEY_ENTER, ImGuiKey_Enter},
                              {GLFW_KEY_ESCAPE, ImGuiKey_Escape},
                              {GLFW_KEY_APOSTROPHE, ImGuiKey_Apostrophe},
                              {GLFW_KEY_COMMA, ImGuiKey_Comma},
                              {GLFW_KEY_MINUS, ImGuiKey_Minus},
                              {GLFW_KEY_PERIOD, ImGuiKey_Period},
                              {GLFW_KEY_SLASH, ImGuiKey_Slash},
                              {GLFW_KEY_SEMICOLON, ImGuiKey_Semicolon},
                              {GLFW_KEY_EQUAL, ImGuiKey_Equal},
                              {GLFW_KEY_LEFT_BRACKET, ImGuiKey_LeftBracket},
                              {GLFW_KEY_BACKSLASH, ImGuiKey_Backslash},
                              {GLFW_KEY_RIGHT_BRACKET, ImGuiKey_RightBracket},
                              {GLFW_KEY_GRAVE_ACCENT, ImGuiKey_GraveAccent},
                              {GLFW_KEY_KP_DECIMAL, ImGuiKey_KeypadDecimal},
                              {GLFW_KEY_KP_DIVIDE, ImGuiKey_KeypadDivide},
                              {GLFW_KEY_KP_MULTIPLY, ImGuiKey_KeypadMultiply},
                              {GLFW_KEY_KP_SUBTRACT, ImGuiKey_KeypadSubtract},
                              {GLFW_KEY_KP_ADD, ImGuiKey_KeypadAdd},
                              {GLFW_KEY_KP_ENTER, ImGuiKey_KeypadEnter},
                              {GLFW_KEY_KP_EQUAL, ImGuiKey_KeypadEqual},
                              {GLFW_KEY_LEFT_SHIFT, ImGuiKey_LeftShift},
                              {GLFW_KEY_LEFT_CONTROL, ImGuiKey_LeftCtrl},
                              {GLFW_KEY_LEFT_ALT, ImGuiKey_LeftAlt},
                              {GLFW_KEY_LEFT_SUPER, ImGuiKey_LeftSuper},
                              {GLFW_KEY_RIGHT_SHIFT, ImGuiKey_RightShift},
                              {GLFW_KEY_RIGHT_CONTROL, ImGuiKey_RightCtrl},
                              {GLFW_KEY_RIGHT_ALT, ImGuiKey_RightAlt},
                              {GLFW_KEY_RIGHT_SUPER, ImGuiKey_RightSuper},
                              {GLFW_KEY_MENU, ImGuiKey_Menu}};

// ImGui's key at the same offset from `first` as `key` has from `firstGlfw`.
ImGuiKey inRow(int key, int firstGlfw, ImGuiKey first) {
  return static_cast<ImGuiKey>(first + (key - firstGlfw));
}

// ImGuiKey_None for keys that neither the panel nor its shortcuts use.
ImGuiKey keyOf(int key) {
  if (key >= GLFW_KEY_A && key <= GLFW_KEY_Z) return inRow(key, GLFW_KEY_A, ImGuiKey_A);
  if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) return inRow(key, GLFW_KEY_0, ImGuiKey_0);
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return inRow(key, GLFW_KEY_F1, ImGuiKey_F1);
  if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) {
    return inRow(key, GLFW_KEY_KP_0, ImGuiKey_Keypad0);
  }
  const auto* named = std::ranges::find(kKeys, key, &NamedKey::glfw);
  return named == std::end(kKeys) ? ImGuiKey_None : named->key;
}

}  // namespace

void prepareInput() {
  ImGui::GetIO().ConfigInputTrickleEventQueue = false;
}

void sendKey(int key, bool down) {
  if (keyOf(key) != ImGuiKey_None) ImGui::GetIO().AddKeyEvent(keyOf(key), down);
}

void sendModifiers(bool ctrl, bool shift, bool alt, bool super) {
  ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM >= 18900
  io.AddKeyEvent(ImGuiMod_Ctrl, ctrl);
  io.AddKeyEvent(ImGuiMod_Shift, shift);
  io.AddKeyEvent(ImGuiMod_Alt, alt);
  io.AddKeyEvent(ImGuiMod_Super, super);
#else
  io.AddKeyEvent(ImGuiKey_ModCtrl, ctrl);
  io.AddKeyEvent(ImGuiKey_ModShift, shift);
  io.AddKeyEvent(ImGuiKey_ModAlt, alt);
  io.AddKeyEvent(ImGuiKey_ModSuper, super);
#endif
}

void sendPointer(glm::dvec2 place) {
  ImGui::GetIO().AddMousePosEvent(static_cast<float>(place.x), static_cast<float>(place.y));
}

void sendButton(int button, bool down) {
  ImGui::GetIO().AddMouseButtonEvent(button, down);
}

void sendWheel(glm::dvec2 notches) {
  ImGui::GetIO().AddMouseWheelEvent(static_cast<float>(notches.x), static_cast<float>(notches.y));
}

bool isKeyPressed(int key, bool repeats) {
  return keyOf(key) != ImGuiKey_None && ImGui::IsKeyPressed(keyOf(key), repeats);
}

bool isKeyDown(int key) {
  return keyOf(key) != ImGuiKey_None && ImGui::IsKeyDown(keyOf(key));
}

#else  // before 1.87 the backend fills arrays, indexed by the window library's key numbers

// ImGui's GLFW backend has filled the map; without a window, any map works.
void prepareInput() {
  ImGuiIO& io = ImGui::GetIO();
  for (int key = 0; key < ImGuiKey_COUNT; ++key) {
    if (io.KeyMap[key] < 0) io.KeyMap[key] = key;
  }
}

void sendKey(int key, bool down) {
  ImGui::GetIO().KeysDown[key] = down;
}

void sendModifiers(bool ctrl, bool shift, bool alt, bool super) {
  ImGuiIO& io = ImGui::GetIO();
  io.KeyCtrl = ctrl;
  io.KeyShift = shift;
  io.KeyAlt = alt;
  io.KeySuper = super;
}

void sendPointer(glm::dvec2 place) {
  ImGui::GetIO().MousePos = ImVec2(static_cast<float>(place.x), static_cast<float>(place.y));
}

void sendButton(int button, bool down) {
  ImGui::GetIO().MouseDown[button] = down;
}

void sendWheel(glm::dvec2 notches) {
  ImGui::GetIO().MouseWheel += static_cast<float>(notches.y);
  ImGui::GetIO().MouseWheelH += static_cast<float>(notches.x);
}

bool isKeyPressed(int key, bool repeats) {
  return ImGui::IsKeyPressed(key, repeats);
}

bool isKeyDown(int key) {
  return ImGui::IsKeyDown(key);
}

#endif

}  // namespace grisaille::app::viewer
