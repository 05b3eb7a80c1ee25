// SPDX-License-Identifier: MIT
// Parts of machines. Unless stated otherwise, a part stands on y = 0 and is centred on the y axis.
// Lengths are in metres.
#pragma once

#include <cstdint>

#include "core/scene/built_in/shapes.h"

namespace grisaille::scene {

// A hexagonal bolt head on its washer. radius: of the head's inner circle
Solid bolt(double radius);

// Bolts on a circle, `count` of them.
Solid boltCircle(double circle, double radius, uint32_t count);

// Two flanges of a pipe that meet at y = 0, with their bolts and the gap of a gasket.
Solid flangePair(double pipeRadius);

// A pipe along a bent line, with flange pairs at both ends if `flanged`.
Solid pipe(const Path& line, double radius, bool flanged);

// A valve in a pipe along y, centred at the origin; its wheel faces +z.
Solid valve(double pipeRadius);

// An I-beam along x, centred at x = 0, whose upper face is at y = 0.
Solid iBeam(double length, double height, double width);

// A square of flat bars and twisted rods, as floors of walkways have. The bars run along z; the
// upper edge is at y = 0.
// size: along x and z
// pitch: distance of the bars, which are 5 mm thick
Solid gratingPanel(const glm::dvec2& size, double pitch, double height);

// An electric motor with cooling fins. The shaft points to +x at y = `axis`, the feet are on y = 0.
Solid motor(double axis);

// The housing of a gear, with ribs and covers; shafts along x at y = `axis`.
Solid gearCase(double axis);

// A tank along x with two saddles; its axis is at y = `axis`.
Solid tank(double length, double radius, double axis);

// A steel drum with two hoops.
Solid drum(double height);

// A cabinet that faces +z with its back at z = 0: a door in a frame, louvres, a handle.
Solid cabinet(const glm::dvec3& size);

}  // namespace grisaille::scene
