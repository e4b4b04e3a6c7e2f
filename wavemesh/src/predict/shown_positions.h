// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Where in their cells the vertices of a level are shown. Cells make a surface rough: it is
/// smoothed where it bends no more than they could have made it. A mesh through points of a curved
/// surface lies on its inner side all over: shown a little further out, along the normals, it is
/// nearer to the surface (docs/algorithm.md).
#pragma once

#include "predict/surface.h"
#include "wavelet/lifting.h"

namespace wavemesh {

/// The middles of the cells, smoothed, then each moved along its normal by what the surface bulges
/// over the edges around, as their ends' normals tell: only as far as such a guess was right of the
/// vertices that came last. No vertex leaves its cell.
///
/// @param parents      of the vertices that came last, those with the highest numbers; none: the
///                     level has all vertices, and is smoothed twice instead
/// @param cells        #V by 3, each 2^shift lattice units wide
/// @param latticeBits  bits per coordinate of the finest level
/// @param glue         of the base mesh: vertices that lie at the same place stay in the middle
/// @return #V by 3, in 1/16 of a lattice unit. Linear.
std::vector<LatticePoint> shownPositions(
    const CornerTable& table,
    const Parents& parents,
    const std::vector<LatticePoint>& cells,
    int shift,
    int latticeBits,
    const Glue& glue);

} // namespace wavemesh
