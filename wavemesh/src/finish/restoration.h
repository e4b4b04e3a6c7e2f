// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// From the finest level, an oriented manifold, to the vertices and faces of the original.
///
/// The *restored* mesh numbers its elements by the decoder's order: the vertices of the finest
/// level without glued copies, then the isolated ones; the faces of the finest level, then copies
/// of faces, then degenerate faces. Everything that the file keeps besides the levels is coded in
/// this numbering.
#pragma once

#include "mesh/glue.h"
#include "mesh/manifold_cut.h"
#include "mesh/quantization.h"

#include <wavemesh/mesh_data.h>

namespace wavemesh {

/// What the finest level does not tell.
struct Restoration
{
	struct Copies
	{
		Index same   = 0; ///< further faces with the vertices and the orientation of this one
		Index turned = 0; ///< with its vertices and the other orientation
	};
	std::vector<std::uint8_t> turned;             ///< #F_J: 1 if the original is oriented otherwise
	std::vector<Copies> copies;                   ///< #F_J, or empty
	std::vector<std::array<Index, 2>> degenerate; ///< restored vertices: a face (a, a, b)
	std::vector<LatticePoint> isolated;
};

/// The corner that the restored mesh has in the place of c, and the other way round, if the face is
/// turned.
inline Index turnedCorner(Index c)
{
	return c % 3 == 0 ? c : c % 3 == 1 ? c + 1 : c - 1;
}

struct RestoredMesh
{
	std::vector<LatticePoint> points; ///< #V, lattice units
	Triangles triangles;              ///< #F, rows of `points`
};

/// For each vertex of the finest level its number in the restored mesh. Glued ones share theirs.
struct RestoredNumbers
{
	std::vector<Index> of; ///< #V_J
	Index count = 0;       ///< without isolated ones
};
RestoredNumbers restoredNumbers(const Glue& glue, Index vertices);

/// @param numbers  from restoredNumbers()
/// @pre the rows of `r.degenerate` exist
RestoredMesh restore(
    const CornerTable& finest,
    const std::vector<LatticePoint>& positions,
    const RestoredNumbers& numbers,
    const Restoration& r);

/// Normals of the vertices, faces or corners, from the lattice points: of a vertex and of its
/// corners the sum of its faces', weighted by area. Of length 1, or 0. #rows by 3.
std::vector<double> normalsOf(const RestoredMesh& mesh, AttributeOf of);

/// Where the elements of a restored mesh come from: writing only.
struct RestoredSource
{
	std::vector<Index> vertex; ///< #V of the restored mesh: vertex of the original
	std::vector<Index> face;   ///< #F
};

/// What there is to restore of `original`.
/// @param source   #V_J: the cut's vertex behind each of the finest level
/// @param lattice  of all positions
/// @param from     [out]
Restoration whatToRestore(
    const ManifoldCut& cut,
    const MeshData& original,
    const Lattice& lattice,
    const CornerTable& finest,
    const std::vector<Index>& source,
    const RestoredNumbers& numbers,
    RestoredSource& from);

} // namespace wavemesh
