// SPDX-License-Identifier: MIT
// Fly and orbit: what a drag, a scroll or a held key makes of a camera.
//
// Drags are in pixels of the picture, x to the right, y down; `heightPixels` is the picture's
// height. Every function takes a sound camera (scene::validate()) and leaves a sound one: a step
// that would end at no camera, such as one out of all bounds or with numbers that are not finite,
// is not taken. Field of view, up, size and near plane stay as they are.
#pragma once

#include <glm/glm.hpp>

#include "core/scene/camera.h"

namespace grisaille::app::viewer {

// Orbit. The scene turns with the cursor about the target: dragging right moves what is in front of
// the target to the right, dragging down moves it down, half a turn for the whole height. Stops at
// the poles, which `up` names. The distance stays.
void orbit(scene::Camera& camera, glm::dvec2 dragPixels, double heightPixels);

// Moves eye and target across the view, so that what lies as deep as the target stays under the
// cursor.
void pan(scene::Camera& camera, glm::dvec2 dragPixels, double heightPixels);

// Scales the distance to the target by 0.9 a notch: over 0 goes nearer, never to or through the
// target.
void dolly(scene::Camera& camera, double notches);

// Fly. Turns about the eye: dragging right looks to the right, dragging down looks down, the whole
// height by twice the field of view. Stops at the poles. The target comes along, as far away.
void look(scene::Camera& camera, glm::dvec2 dragPixels, double heightPixels);

// Moves eye and target along the view's right, the camera's `up` and the view direction. Axes are
// within -1 ... 1; together they are no faster than one alone.
void fly(scene::Camera& camera, glm::dvec3 axesRightUpForward, double seconds,
         double metresPerSecond);

// A speed to begin with: ten seconds through the whole scene. Metres a second.
double flySpeed(const scene::Bounds& bounds);

// That speed, faster by 1.25 a notch, between 1e-4 and 1e6 m/s.
double steppedSpeed(double metresPerSecond, double notches);

}  // namespace grisaille::app::viewer
