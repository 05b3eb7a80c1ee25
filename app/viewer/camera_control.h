// SPDX-License-Identifier: MIT
// Camera control: moves a camera by a drag, a scroll or a held key.
//
// Drags are in pixels of the picture, x to the right, y down; `heightPixels` is the picture's
// height. Every function takes a valid camera (scene::validate()) and leaves a valid one: it skips
// a step that would make the camera invalid, for example out of bounds or not finite. Field of
// view, up, size and near plane stay unchanged.
//
// The target is the point in the middle of the picture that the camera moves about. Functions that
// move the camera relative to a surface take that surface's point.
#pragma once

#include <glm/glm.hpp>

#include "core/scene/camera.h"

namespace grisaille::app::viewer {

// Sets the distance of the target, which stays in the middle of the picture: the picture does not
// change. `metres`: over 0.
void setTargetDistance(scene::Camera& camera, double metres);

// Turns eye and target about `pivot`, which keeps its pixel. Geometry in front of the pivot follows
// the cursor, to the right and down; a drag over the whole height is half a turn. Stops at the
// poles of the axis `up`.
void orbit(scene::Camera& camera, const glm::dvec3& pivot, glm::dvec2 dragPixels,
           double heightPixels);

// Whether fingers on a touchpad moved by `notches`, to the right and up, rather than a wheel:
// wheels turn by whole or half notches up and down; fingers move by any amount, to any side. For
// windows without a Touchpad.
bool isOfFingers(glm::dvec2 notches);

// Moves eye and target parallel to the picture plane. A point at the target's depth stays under the
// cursor.
void pan(scene::Camera& camera, glm::dvec2 dragPixels, double heightPixels);

// Multiplies the distances of eye and target to `point`, which keeps its pixel, by 0.9 per notch:
// positive notches move nearer. The eye stops before the near plane cuts the point off.
void zoom(scene::Camera& camera, const glm::dvec3& point, double notches);

// As zoom(), by fingers: twice the scale halves the distances. `scale`: over 0; over 1 moves
// nearer.
void pinch(scene::Camera& camera, const glm::dvec3& point, double scale);

// Turns the view to `point`, moves to half of its distance, and makes it the target.
void focus(scene::Camera& camera, const glm::dvec3& point);

// Moves eye and target, in the same direction of view, until a ball is in the middle of the picture
// and as large as the picture allows. radius: metres, over 0; aspect: width of the picture divided
// by its height
void frameBall(scene::Camera& camera, const glm::dvec3& centre, double radius, double aspect);

// Looks at the target from the side that `from` points to, at the same distance. `from`: unit.
void lookFrom(scene::Camera& camera, const glm::dvec3& from);

// Turns the view about the eye: a drag to the right looks right, a drag down looks down. A drag
// over the whole height turns by twice the field of view. Stops at the poles. The target keeps its
// distance.
void look(scene::Camera& camera, glm::dvec2 dragPixels, double heightPixels);

// Flies: moves eye and target along the view's right, the camera's `up` and the view direction.
// Each axis is from -1 to 1; a vector longer than 1 is normalised.
void fly(scene::Camera& camera, glm::dvec3 axesRightUpForward, double seconds,
         double metresPerSecond);

// The speed of flying, metres per second: half the distance ahead in a second. The distance counts
// as at least a thousandth of the scene's extent, so that one can pass a surface, and at most as
// the extent. ahead: metres, infinite: nothing is ahead; extent: diagonal of the scene's bounds,
// metres
double flySpeed(double ahead, double extent);

// The factor times 1.25 per notch, clamped to 1/64 ... 64.
double steppedSpeed(double factor, double notches);

}  // namespace grisaille::app::viewer
