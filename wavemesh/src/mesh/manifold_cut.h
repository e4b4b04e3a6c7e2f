// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Any triangle list becomes an oriented manifold, and what was done to it is remembered.
///
/// Given any faces, leaves faces that buildCornerTable() accepts: degenerate faces and copies of a
/// face are taken out, faces are turned over where their neighbours are oriented the other way, and
/// what still is no manifold is opened by giving vertices several copies. Vertices without faces
/// are taken out. A mesh that is an oriented manifold already is left exactly as it is.
#pragma once

#include "mesh/corner_table.h"

namespace wavemesh {

using Triangles = std::vector<std::array<Index, 3>>;

/// A face that was taken out because another one has the same three vertices.
struct FaceCopy
{
	Index face;  ///< of the original
	Index of;    ///< of the manifold
	bool turned; ///< oriented the other way than the manifold's face
};

/// The manifold, in a numbering of its own that follows the original's, and the way back.
struct ManifoldCut
{
	CornerTable table;
	std::vector<Index> vertex;        ///< #V: the original's vertex behind each
	std::vector<Index> face;          ///< #F: the original's face behind each
	std::vector<std::uint8_t> turned; ///< #F: 1 if it is oriented the other way than the original's
	std::vector<FaceCopy> copies;     ///< ordered by `of`, then by `face`
	std::vector<Index> degenerate;    ///< faces of the original that have a vertex twice
	std::vector<Index> isolated;      ///< vertices of the original outside all faces but degenerate
	/// #V: a vertex that stands for one of the original's together with others says which it is
	/// (the original's number); kNone for all others. Empty if nothing was opened.
	std::vector<Index> group;

	/// Is the manifold something else than the original?
	bool changed() const
	{
		return !group.empty() || !copies.empty() || !degenerate.empty() || !isolated.empty() ||
		       anyTurned();
	}
	bool anyTurned() const;
	/// #V: 1 for the vertices that have a group; empty if nothing was opened.
	std::vector<std::uint8_t> shared() const;
	/// Groups of the first `count` of the vertices listed in `rows`.
	std::vector<Index> groupsOf(const std::vector<Index>& rows, Index count) const;
};

/// @param triangles    any faces whose vertices exist
/// @param vertexCount  of the original
/// @return InvalidArgument for an index out of range, naming the face. Linear but for sorting the
///         faces of an edge.
Result<ManifoldCut> cutToManifold(const Triangles& triangles, Index vertexCount);

} // namespace wavemesh
