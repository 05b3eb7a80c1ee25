// SPDX-License-Identifier: MIT
// Camera control: moves a camera by a drag, a scroll or a held key.
//
// Drags are in pixels of the picture, x to the right, y down; `heightPixels` is the picture's
// height. Every function takes a valid camera (scene::validate()) and leaves a valid one: it skips
// a step that would make the camera invalid, for example out of bounds or not finite. Field of
// view, up, size and near plane stay unchanged.
#pragma once

#include <glm/glm.hpp>

#include "core/scene/bounds.h"
#include "core/scene/camera.h"

namespace grisaille::app::viewer {

// Orbits the eye about the target at a constant distance. Geometry in front of the target follows
// the cursor, to the right and down; a drag over the whole height is half a turn. Stops at the
// poles of the axis `up`.
void orbit(scene::Camera& camera, glm::dvec2 dragPixels, double heightPixels);

// Moves eye and target parallel to the picture plane. A point at the target's depth stays under the
// cursor.
void pan(scene::Camera& camera, glm::dvec2 dragPixels, double heightPixels);

// Multiplies the distance to the target by 0.9 per notch: positive notches move nearer. The eye
// never reaches the target.
void dolly(scene::Camera& camera, double notches);

// Turns the view about the eye: a drag to the right looks right, a drag down looks down. A drag
// over the whole height turns by twice the field of view. Stops at the poles. The target keeps its
// distance.
void look(scene::Camera& camera, glm::dvec2 dragPixels, double heightPixels);

// Flies: moves eye and target along the view's right, the camera's `up` and the view direction.
// Each axis is from -1 to 1; a vector longer than 1 is normalised.
void fly(scene::Camera& camera, glm::dvec3 axesRightUpForward, double seconds,
         double metresPerSecond);

// The initial speed, metres per second: ten seconds along the diagonal of the scene's bounds.
double flySpeed(const scene::Bounds& bounds);

// The speed times 1.25 per notch, clamped to 1e-4 ... 1e6 m/s.
double steppedSpeed(double metresPerSecond, double notches);

}  // namespace grisaille::app::viewer
