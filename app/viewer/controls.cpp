// SPDX-License-Identifier: MIT
#include "app/viewer/controls.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/viewer/camera_control.h"
#include "app/viewer/input.h"

namespace grisaille::app::viewer {
namespace {

constexpr double kLineReach = 6;      // pixels on either side where a click grabs the line
constexpr double kDoubleClick = 0.5;  // seconds between the presses, at most
constexpr double kDoubleReach = 6;    // pixels between the presses, at most

}  // namespace

glm::dvec2 Controls::pointAt(const Place& place, glm::dvec2 at) const {
  const glm::dvec2 size(place.size);
  return glm::dvec2(session_.centre) * size +
         (at - glm::dvec2(place.corner) + 0.5 - 0.5 * size) / static_cast<double>(session_.zoom);
}

glm::dvec2 Controls::windowAt(const Place& place, glm::dvec2 point) const {
  const glm::dvec2 size(place.size);
  return (point - glm::dvec2(session_.centre) * size) * static_cast<double>(session_.zoom) +
         glm::dvec2(place.corner) - 0.5 + 0.5 * size;
}

std::optional<glm::ivec2> Controls::texel(const Place& place) const {
  if (ImGui::GetIO().WantCaptureMouse) return std::nullopt;
  const glm::dvec2 inside = cursor_ - glm::dvec2(place.corner);
  if (inside.x < 0 || inside.y < 0 || inside.x >= place.size.x || inside.y >= place.size.y) {
    return std::nullopt;
  }
  const glm::ivec2 at(glm::floor(pointAt(place, cursor_)));
  const bool outside = at.x < 0 || at.y < 0 || at.x >= static_cast<int>(place.size.x) ||
                       at.y >= static_cast<int>(place.size.y);
  return outside ? std::nullopt : std::optional(at);
}

bool Controls::rightSide(const Place& place) const {
  return session_.split && session_.splitting.way == SplitWay::kLine &&
         cursor_.x - place.corner.x + 0.5 > double{session_.line} * place.size.x;
}

bool Controls::update(const Place& place, Stage* stage, const FingerMove& fingers, double seconds,
                      float pixelsAUnit, Requests& requests) {
  const ImGuiIO& io = ImGui::GetIO();
  const glm::dvec2 now = glm::dvec2(io.MousePos.x, io.MousePos.y) * double{pixelsAUnit};
  moved_ = cursor_.x < 0 ? glm::dvec2(0) : now - cursor_;
  cursor_ = now;
  stage_ = stage;
  fingers_ = fingers;
  sincePress_ += seconds;
  sinceMoved_ += seconds;
  if (!std::exchange(pans_, false)) sincePan_ += seconds;  // a slow frame is no rest
  if (moved_ != glm::dvec2(0)) sincePan_ = 1e9;
  const scene::Camera before = session_.camera;
  const uint64_t jumps = session_.jumps();
  // A burst of the wheel, or a drag in the panel, is one place of the history.
  if (drag_ == Drag::kNone && sinceMoved_ > kRest && !ImGui::IsAnyItemActive()) {
    session_.cameraHistory.note(session_.camera);
  }
  updateKeysAnywhere(requests);
  if (!io.WantTextInput) updateKeys(place, requests);
  if (place.size.x == 0 || place.size.y == 0) return false;
  drawAxes(place, pixelsAUnit);
  drawChosen(place, pixelsAUnit);
  bool moves = updateMouse(place, seconds);
  if (!io.WantTextInput && !io.KeyCtrl && updateFlight(place, seconds)) moves = true;
  if (session_.camera.eye != before.eye) sinceMoved_ = 0;
  steered_ = session_.camera != before && session_.jumps() == jumps;
  return moves;
}

bool Controls::updateMouse(const Place& place, double seconds) {
  const ImGuiIO& io = ImGui::GetIO();
  if (drag_ == Drag::kNone) {
    if (!io.WantCaptureMouse) beginDrag(place);
  } else {
    drag(place, seconds);
  }
  if (!io.WantCaptureMouse && (io.MouseWheel != 0 || io.MouseWheelH != 0)) scroll(place);
  if (!io.WantCaptureMouse && fingers_.scale != 1) pinch(place);
  return drag_ == Drag::kPlace && session_.sprays();
}

void Controls::beginDrag(const Place& place) {
  const double line = place.corner.x + double{session_.line} * place.size.x;
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    const bool lined = session_.split && session_.splitting.way == SplitWay::kLine;
    if (lined && std::abs(cursor_.x - line) <= kLineReach) {
      drag_ = Drag::kLine;
    } else if (ImGui::GetIO().KeyCtrl) {
      drag_ = Drag::kObject;
      chooseObject(place);
    } else if (session_.placing && !ImGui::GetIO().KeyAlt) {
      drag_ = Drag::kPlace;
      sincePlaced_ = 0;
      placeObject(place, glm::dvec2(0), false);
    } else {
      drag_ = Drag::kOrbit;
    }
  } else if (ImGui::IsMouseClicked(ImGuiMouseButton_Middle)) {
    drag_ = Drag::kPan;
  } else if (ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
    drag_ = Drag::kLook;
  }
  if (drag_ != Drag::kOrbit && drag_ != Drag::kPan) return;
  pressed_ = pick(place, pointAt(place, cursor_));
  aimed_ = false;
  if (drag_ == Drag::kPan) return;
  session_.findSurfaces();
  const bool again = sincePress_ < kDoubleClick && glm::length(cursor_ - pressedAt_) < kDoubleReach;
  sincePress_ = again ? 1e9 : 0;  // a third press is no double click
  pressedAt_ = cursor_;
  if (!again || !pressed_.surface) return;
  scene::Camera next = session_.camera;
  focus(next, pressed_.point);
  session_.goTo(next);
}

void Controls::drag(const Place& place, double seconds) {
  constexpr ImGuiMouseButton kButtons[] = {0, 0, ImGuiMouseButton_Middle, ImGuiMouseButton_Right, 0,
                                           0, 0};
  switch (drag_) {
    case Drag::kOrbit:
    case Drag::kPan:
    case Drag::kLook:
      if (moved_ != glm::dvec2(0)) dragCamera(place, moved_ / static_cast<double>(session_.zoom));
      break;
    case Drag::kLine:
      session_.line = std::clamp(
          static_cast<float>((cursor_.x - place.corner.x + 0.5) / place.size.x), 0.0f, 1.0f);
      break;
    case Drag::kObject:
      dragObject(place);
      break;
    default:
      spray(place, seconds);
      break;
  }
  if (!ImGui::IsMouseDown(kButtons[static_cast<size_t>(drag_)])) drag_ = Drag::kNone;
}

// Keys that also work while the user types in a text field.
void Controls::updateKeysAnywhere(Requests& requests) {
  const bool ctrl = ImGui::GetIO().KeyCtrl;
  if (isKeyPressed(GLFW_KEY_F1)) panel_.help = !panel_.help;
  if (isKeyPressed(GLFW_KEY_F2)) panel_.shown = !panel_.shown;
  if (isKeyPressed(GLFW_KEY_F5)) requests.rescan = true;
  if (isKeyPressed(GLFW_KEY_F11)) wantsFullScreen = true;
  if (isKeyPressed(GLFW_KEY_F12)) requests.picture = true;
  if (ctrl && isKeyPressed(GLFW_KEY_Q)) requests.quit = true;
  if (isKeyPressed(GLFW_KEY_ESCAPE)) requests.cancelLoading = true;
  if (ctrl && isKeyPressed(GLFW_KEY_O)) requests.openDialog = true;
  if (ctrl && isKeyPressed(GLFW_KEY_S)) panel_.saveSettings();
  if (ctrl && (isKeyPressed(GLFW_KEY_EQUAL) || isKeyPressed(GLFW_KEY_KP_ADD)))
    state_.layout.textScale *= 1.1;
  if (ctrl && (isKeyPressed(GLFW_KEY_MINUS) || isKeyPressed(GLFW_KEY_KP_SUBTRACT)))
    state_.layout.textScale /= 1.1;
  if (ctrl && isKeyPressed(GLFW_KEY_0)) state_.layout.textScale = 1;
  state_.layout.textScale = std::clamp(state_.layout.textScale, 0.5, 4.0);
}

void Controls::updateKeys(const Place& place, Requests& requests) {
  const ImGuiIO& io = ImGui::GetIO();
  if (isKeyPressed(GLFW_KEY_ESCAPE)) {
    panel_.closeDialogs();
    ImGui::SetWindowFocus(nullptr);
    session_.chooseNone();
  }
  updateBookmarkKeys();
  if (io.KeyCtrl) {
    if (isKeyPressed(GLFW_KEY_Z, true)) io.KeyShift ? session_.redo() : session_.undo();
    if (isKeyPressed(GLFW_KEY_Y, true)) session_.redo();
    if (isKeyPressed(GLFW_KEY_C)) requests.copyCommand = true;
    return;
  }
  updateViewKeys();
  if (isKeyPressed(GLFW_KEY_F)) frameScene(place);
  if (isKeyPressed(GLFW_KEY_DELETE)) session_.deleteChosen();
  if (io.WantCaptureKeyboard) return;  // the panel takes the keys
  if (isKeyPressed(GLFW_KEY_TAB)) panel_.takeFocus();
  if (isKeyPressed(GLFW_KEY_SPACE)) {
    session_.attempt("object",
                     [&] { session_.place(0.5 * glm::dvec2(place.size), place.size, false); });
  }
  steer(place);
}

void Controls::updateViewKeys() {
  if (isKeyPressed(GLFW_KEY_B)) session_.placing = !session_.placing;
  if (isKeyPressed(GLFW_KEY_X)) {
    SplitWay& way = session_.splitting.way;
    if (session_.split && ImGui::GetIO().KeyShift) {
      way = static_cast<SplitWay>((static_cast<int>(way) + 1) % 3);
    } else {
      session_.split = !session_.split;
    }
  }
  if (isKeyPressed(GLFW_KEY_LEFT_BRACKET)) session_.line = std::max(session_.line - 0.05f, 0.0f);
  if (isKeyPressed(GLFW_KEY_RIGHT_BRACKET)) session_.line = std::min(session_.line + 0.05f, 1.0f);
  if (isKeyPressed(GLFW_KEY_T)) session_.compareWithTruth(!session_.comparing.on);
  if (isKeyPressed(GLFW_KEY_I)) session_.inspecting = !session_.inspecting;
  if (isKeyPressed(GLFW_KEY_P)) session_.paused = !session_.paused;
  if (isKeyPressed(GLFW_KEY_N)) session_.step = true;
  if (isKeyPressed(GLFW_KEY_K))
    session_.attempt("pose", [&] { session_.play(!session_.playback.playing); });
  if (isKeyPressed(GLFW_KEY_COMMA, true)) session_.stepFrames(-1);
  if (isKeyPressed(GLFW_KEY_PERIOD, true)) session_.stepFrames(1);
  if (isKeyPressed(GLFW_KEY_HOME)) session_.goTo(session_.homeCamera);
  if (ImGui::GetIO().KeyAlt) {
    CameraHistory& history = session_.cameraHistory;
    if (isKeyPressed(GLFW_KEY_LEFT, true)) {
      session_.jumpTo(history.back(session_.camera).value_or(session_.camera));
    }
    if (isKeyPressed(GLFW_KEY_RIGHT, true)) {
      session_.jumpTo(history.forward(session_.camera).value_or(session_.camera));
    }
  }
  if (isKeyPressed(GLFW_KEY_KP_ADD, true) || isKeyPressed(GLFW_KEY_EQUAL, true)) {
    session_.zoom = std::min(session_.zoom * 1.25f, 64.0f);
  }
  if (isKeyPressed(GLFW_KEY_KP_SUBTRACT, true) || isKeyPressed(GLFW_KEY_MINUS, true)) {
    session_.zoom = std::max(session_.zoom / 1.25f, 1.0f);
    if (session_.zoom == 1) session_.centre = glm::vec2(0.5f);
  }
  if (isKeyPressed(GLFW_KEY_V)) {
    const std::vector<Viewable> all = session_.views(false);
    const auto now = std::ranges::find(all, session_.left, &Viewable::output);
    const size_t index = now == all.end() ? 0 : static_cast<size_t>(now - all.begin());
    const size_t step = ImGui::GetIO().KeyShift ? all.size() - 1 : 1;
    session_.left = all[(index + step) % all.size()].output;
  }
}

void Controls::updateBookmarkKeys() {
  for (int digit = 1; digit <= 9; ++digit) {
    if (!isKeyPressed(GLFW_KEY_0 + digit)) continue;
    const std::string name = std::to_string(digit);
    session_.attempt("bookmark", [&] {
      if (ImGui::GetIO().KeyCtrl) {
        bookmarks_.save(name, session_.camera);
        panel_.refreshLists();
        session_.say("bookmark " + name + " set");
        return;
      }
      for (const Bookmarks::Entry& entry : bookmarks_.list()) {
        if (entry.name == name && entry.camera) session_.goTo(*entry.camera);
      }
    });
  }
}

}  // namespace grisaille::app::viewer
