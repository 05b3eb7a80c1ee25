// SPDX-License-Identifier: MIT
// Tells solid bodies from sheets. A body's surface is closed, so that its far side is its back. A
// sheet, such as a leaf or a banner, has no thickness, and its back is its front. Exporters mark
// closed meshes as double-sided too: only the mesh itself tells.
#pragma once

#include <vector>

#include "core/scene/scene.h"

namespace grisaille::scene {

// One value for each triangle of Scene::indices: whether it is part of a closed body.
//
// Vertices at equal positions count as one. Triangles that share an edge belong to one part; a part
// may span several primitives, if their instances have equal transforms. A part is closed if each
// of its edges runs as often one way as the other. Triangles with a masked material or without an
// area belong to no part. A primitive with several instances must be closed in each.
//
// Takes the scene in its present pose. Time: that of sorting the scene's edges.
std::vector<bool> bodyTriangles(const Scene& scene);

}  // namespace grisaille::scene
