// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The order in which the vertices of a level are coded: strip by strip over the surface, so that
/// half of the neighbours of most vertices are known, and whole parallelograms with them.
#pragma once

#include "mesh/corner_table.h"

namespace wavemesh {

/// Visits face by face across edges, faces whose vertices are all known first, else in the order in
/// which the edges were met; each component from its first face.
///
/// @return #V: the vertices in the order of their first visit, each once. Linear.
std::vector<Index> vertexWalk(const CornerTable& table);

} // namespace wavemesh
