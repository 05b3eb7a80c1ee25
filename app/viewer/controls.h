// SPDX-License-Identifier: MIT
// Mouse and keyboard outside the panel: move the camera, place objects, zoom, change views.
#pragma once

#include <glm/glm.hpp>
#include <random>

#include "app/viewer/fingers.h"
#include "app/viewer/panel.h"
#include "app/viewer/session.h"
#include "app/viewer/stage.h"

namespace grisaille::app::viewer {

// The picture's rectangle in the window, pixels.
struct Place {
  glm::ivec2 corner = glm::ivec2(0);
  glm::uvec2 size = glm::uvec2(0);
};

class Controls {
 public:
  Controls(Session& session, Panel& panel, Bookmarks& bookmarks, ViewerState& state)
      : session_(session), panel_(panel), bookmarks_(bookmarks), state_(state) {}

  // Call between ImGui::NewFrame() and ImGui::Render(), after the panel. `stage`: the picture that
  // the user sees; may be null. `fingers`: on a touchpad, in this frame. `seconds`: since the last
  // frame. `pixelsAUnit`: pixels per unit of the window. Adds to `requests`. True while a held key
  // or button moves the camera or sprays objects: the next frame must be drawn.
  bool update(const Place& place, Stage* stage, const FingerMove& fingers, double seconds,
              float pixelsAUnit, Requests& requests);

  // The texel under the cursor, none while the cursor is outside the picture or over the panel; and
  // whether the cursor is right of the split line.
  std::optional<glm::ivec2> texel(const Place& place) const;
  bool rightSide(const Place& place) const;

  // True if the last update() moved the camera by a drag, a wheel or a key that repeats.
  bool steered() const { return steered_; }
  bool wantsFullScreen = false;

 private:
  static constexpr double kRest = 0.5;  // seconds without motion end a move of the camera

  enum class Drag : uint8_t { kNone, kOrbit, kPan, kLook, kLine, kPlace, kObject };

  // A point that the user sees. Where there is no surface: at the target's distance.
  struct Pick {
    glm::dvec3 point = glm::dvec3(0);
    bool surface = false;
  };

  bool updateMouse(const Place& place, double seconds);
  void beginDrag(const Place& place);
  void drag(const Place& place, double seconds);
  // controls_camera.cpp
  void dragCamera(const Place& place, glm::dvec2 moved);
  void orbitClear(const glm::dvec3& pivot, glm::dvec2 moved, double height);
  void scroll(const Place& place);
  void pinch(const Place& place);
  void magnify(const Place& place, double factor);
  void steer(const Place& place);
  Pick pick(const Place& place, glm::dvec2 at);  // `at`: texels, from the top left corner
  void aim(const Pick& at);
  double distanceAhead(const Place& place);
  void frameScene(const Place& place);
  void drawAxes(const Place& place, float pixelsAUnit);
  bool updateFlight(const Place& place, double seconds);
  void updateKeysAnywhere(Requests& requests);
  void updateKeys(const Place& place, Requests& requests);
  void updateViewKeys();
  void updateBookmarkKeys();
  // controls_objects.cpp
  void placeObject(const Place& place, glm::dvec2 offset, bool joins);
  void chooseObject(const Place& place);
  void dragObject(const Place& place);
  void spray(const Place& place, double seconds);
  void drawChosen(const Place& place, float pixelsAUnit);
  // Converts pixels of the window to pixels of the picture, from its top left corner; and back.
  glm::dvec2 pointAt(const Place& place, glm::dvec2 at) const;
  glm::dvec2 windowAt(const Place& place, glm::dvec2 point) const;

  Session& session_;
  Panel& panel_;
  Bookmarks& bookmarks_;
  ViewerState& state_;
  Drag drag_ = Drag::kNone;
  glm::dvec2 cursor_ = glm::dvec2(-1), moved_ = glm::dvec2(0);  // pixels of the window
  double sincePlaced_ = 0;                                      // seconds
  Stage* stage_ = nullptr;                                      // of the present update()
  FingerMove fingers_;                                          // as well
  Pick pressed_;                                                // where the drag began
  bool steered_ = false;
  bool carried_ = false;  // the drag has moved the selected object
  bool aimed_ = false;    // the target has the distance of pressed_
  // Seconds since the last press of the left button, and since the camera last moved.
  double sincePress_ = 1e9, sinceMoved_ = 1e9;
  // Whether the last frame panned by a scroll, and seconds since, unless the pointer has moved.
  bool pans_ = false;
  double sincePan_ = 1e9;
  glm::dvec2 pressedAt_ = glm::dvec2(-1);  // cursor at that press
  std::mt19937 random_{1};
};

}  // namespace grisaille::app::viewer
