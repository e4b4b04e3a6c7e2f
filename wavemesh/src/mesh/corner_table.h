// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Connectivity of one level as two index arrays. Face f owns corners 3f, 3f+1, 3f+2,
/// counter-clockwise; corner c stands at vertex[c] and faces the edge next(c) -> prev(c).
///
///            v(c)
///            /c \            opposite[c] is the corner that faces the same edge from the
///           / f  \           other side, or kNone on the boundary.
///     next(c)-----prev(c)
///           \    /           Invariant: an oriented 2-manifold, with or without boundary.
///            \d /            d = opposite[c],  c = opposite[d]
///
/// The levels of the codec are index arrays, not VCG meshes: a walk over all 1-rings takes half the
/// time and the adjacency of a refined level follows from its parent without a search.
#pragma once

#include <wavemesh/mesh_data.h>
#include <wavemesh/status.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace wavemesh {

using Index           = std::uint32_t;
constexpr Index kNone = ~Index {0};
/// Lattice point: integer multiples of the step.
using LatticePoint = std::array<std::int32_t, 3>;

/// Of vertices, and of faces: corners are 32-bit numbers with a sign to spare.
constexpr std::size_t kMostElements = 0x7fffffff / 3;

/// LimitExceeded, and what to do about it, for a mesh that no .wmc can hold.
Status checkCounts(std::size_t vertices, std::size_t faces);

inline Index nextCorner(Index c)
{
	return c % 3 == 2 ? c - 2 : c + 1;
}
inline Index prevCorner(Index c)
{
	return c % 3 == 0 ? c + 2 : c - 1;
}

struct CornerTable
{
	Index vertexCount = 0;
	std::vector<Index> vertex;   ///< #corners
	std::vector<Index> opposite; ///< #corners, kNone on the boundary

	Index faceCount() const { return cornerCount() / 3; }
	Index cornerCount() const { return static_cast<Index>(vertex.size()); }

	/// Corner at the same vertex in the face across the edge that leaves c's vertex towards
	/// next(c), clockwise; kNone on the boundary.
	Index swingRight(Index c) const
	{
		const Index o = opposite[prevCorner(c)];
		return o == kNone ? kNone : prevCorner(o);
	}
	/// The same, counter-clockwise, across the edge towards prev(c).
	Index swingLeft(Index c) const
	{
		const Index o = opposite[nextCorner(c)];
		return o == kNone ? kNone : nextCorner(o);
	}
	void link(Index c, Index d)
	{
		opposite[c] = d;
		if (d != kNone)
			opposite[d] = c;
	}
};

/// For each vertex the corner from which swingLeft() visits its whole fan: the rightmost one at a
/// boundary vertex, any other else; kNone for a vertex without faces. #V. Linear.
std::vector<Index> firstCorners(const CornerTable& table);

/// Number of edges at each vertex. #V. Linear.
std::vector<Index> valences(const CornerTable& table);

/// For each corner of `coded` the corner of `own` that is the same. #corners. About linear: hubs
/// cost nothing.
/// @param source  for each vertex of `coded` that of `own`, which has the same faces in another
///                order
std::vector<Index>
matchCorners(const CornerTable& coded, const CornerTable& own, const std::vector<Index>& source);

/// Adjacency of a triangle list.
///
/// @return Unsupported, naming edge or vertex, for non-manifold edges or vertices, inconsistent
///         orientation, degenerate faces or isolated vertices. InvalidArgument for an index out of
///         range. Linear in faces, whatever the valences.
Result<CornerTable>
buildCornerTable(const std::vector<std::array<std::uint32_t, 3>>& triangles, Index vertexCount);

} // namespace wavemesh
