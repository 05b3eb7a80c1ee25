// SPDX-License-Identifier: MIT
// Small carved and turned things. Unless stated otherwise, a part stands on y = 0 and is centred on
// the y axis. Lengths are in metres.
#pragma once

#include <cstdint>

#include "core/scene/built_in/shapes.h"

namespace grisaille::scene {

// A flower in relief: a ring of petals round a hollow.
Solid rosette(double radius, double height, uint32_t petals, uint32_t segmentsPerPetal);

// A scroll in relief: a tapering stem that rolls up, with leaves. It starts at the origin along +x
// and rolls up towards -z.
Solid scroll(double size);

// Pieces of chess, each about 0.03 m wide.
Solid pawn();
Solid rook();
Solid knight();  // faces +x
Solid bishop();
Solid queen();
Solid king();

// A chain that lies along a line. wire: radius of the wire; a link is 9 times as long
Solid chain(const Path& line, double wire);

// A comb that lies in the xy plane with its teeth down; its spine is at y = 0, along x.
Solid comb(double length, double tooth, uint32_t teeth);

// A finger ring that lies flat; the second has a stone.
Solid fingerRing(double radius);
Solid jewelRing(double radius);

Solid coin(double radius, double height);
Solid spool(double radius, double height);
// The thread that is wound on a spool.
Solid thread(double radius, double low, double high, double width);

struct Die {
  Solid body, pips;
};
Die die(double size);

}  // namespace grisaille::scene
