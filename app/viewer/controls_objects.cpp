// SPDX-License-Identifier: MIT
// How the pointer places objects in the picture, selects them and moves them.
#include <algorithm>

#include "app/viewer/controls.h"
#include "core/scene/view.h"

namespace grisaille::app::viewer {
namespace {

constexpr double kSprayInterval = 1.0 / 20;  // seconds
constexpr int kMostSprayed = 8;              // per frame
constexpr double kSprayRadius = 12;          // pixels
constexpr double kReach = 24;                // pixels from an object's point that select it
constexpr double kReachRadii = 1;            // the same, in radii of ambient occlusion
constexpr double kHeld = 4;                  // pixels that a drag may tremble
constexpr float kRing = 0.8f;                // radius of the selection's ring, font heights

bool isInside(glm::dvec2 point, glm::uvec2 size) {
  return point.x >= 0 && point.y >= 0 && point.x < size.x && point.y < size.y;
}

}  // namespace

void Controls::placeObject(const Place& place, glm::dvec2 offset, bool joins) {
  const glm::dvec2 point = pointAt(place, cursor_ + offset);
  if (!isInside(point, place.size)) return;
  session_.attempt("object", [&] { session_.place(point, place.size, joins); });
}

void Controls::spray(const Place& place, double seconds) {
  if (!session_.sprays()) return;
  sincePlaced_ += seconds;
  std::normal_distribution<double> off(0, kSprayRadius / 2);
  for (int i = 0; i < kMostSprayed && sincePlaced_ >= kSprayInterval &&
                  ImGui::IsMouseDown(ImGuiMouseButton_Left);
       ++i, sincePlaced_ -= kSprayInterval) {
    placeObject(place, {off(random_), off(random_)}, true);
  }
  sincePlaced_ = std::min(sincePlaced_, kSprayInterval);
}

// Selects the object that is nearest to the surface under the pointer; far from all of them: none.
void Controls::chooseObject(const Place& place) {
  carried_ = false;
  pressedAt_ = cursor_;
  session_.chooseNone();
  const glm::dvec2 point = pointAt(place, cursor_);
  const Pick under = pick(place, point);
  if (!under.surface || !isInside(point, place.size)) return;
  const scene::View view = scene::viewOf(session_.camera, place.size);
  const double depth = glm::dot(under.point - view.eye, -glm::dvec3(view.worldFromView[2]));
  const double reach = kReach * scene::pixelSize(view, depth) / static_cast<double>(session_.zoom);
  session_.chooseNear(under.point, std::max(reach, kReachRadii * session_.sceneRadius()));
}

// Carries the selected object along the surfaces under the pointer: one step of undo.
void Controls::dragObject(const Place& place) {
  if (!carried_ && glm::length(cursor_ - pressedAt_) < kHeld) return;
  const glm::dvec2 point = pointAt(place, cursor_);
  if (moved_ == glm::dvec2(0) || !isInside(point, place.size)) return;
  session_.attempt("object", [&] {
    if (session_.moveChosen(point, place.size, carried_)) carried_ = true;
  });
}

// A ring around the selected object.
void Controls::drawChosen(const Place& place, float pixelsAUnit) {
  const auto at = session_.chosenPoint();
  if (!at) return;
  const scene::View view = scene::viewOf(session_.camera, place.size);
  const glm::dvec3 seen = glm::transpose(view.worldFromView) * (*at - view.eye);
  if (!view.orthographic && seen.z >= 0) return;
  const glm::dvec2 point = scene::pixelOf(view, seen);
  if (!isInside(point, place.size)) return;
  const auto where = glm::vec2(windowAt(place, point - 0.5)) / pixelsAUnit;
  const float radius = kRing * ImGui::GetFontSize();
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const glm::vec2 corner = glm::vec2(place.corner) / pixelsAUnit;
  const glm::vec2 end = corner + glm::vec2(place.size) / pixelsAUnit;
  list.PushClipRect(ImVec2(corner.x, corner.y), ImVec2(end.x, end.y));
  const float line = radius / 6;
  list.AddCircle(ImVec2(where.x, where.y), radius, IM_COL32(0, 0, 0, 255), 0, 2 * line);
  list.AddCircle(ImVec2(where.x, where.y), radius, IM_COL32(255, 255, 255, 255), 0, line);
  list.PopClipRect();
  const auto chosen = session_.chosen();
  panel_.layout.note("selected", where.x - radius, where.y - radius, where.x + radius,
                     where.y + radius, fmt::format("{} {}", chosen->effect, chosen->index));
}

}  // namespace grisaille::app::viewer
