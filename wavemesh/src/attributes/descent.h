// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Which elements of the level before those of a level come from: what attributes of vertices,
/// faces and corners are predicted from, and, the other way round, which value a coarse element
/// takes from a finer one.
#pragma once

#include "multires/refinement.h"
#include "wavelet/lifting.h"

namespace wavemesh {

/// The corners at each vertex, counter-clockwise from its first.
struct Fans
{
	std::vector<Index> begin;  ///< #V + 1, in `corner`
	std::vector<Index> corner; ///< #corners

	explicit Fans(const CornerTable& table);
};

/// Of a split.
struct Descent
{
	/// #(V_j - V_{j-1}): the lower corner of the parent level that faces the vertex's edge; kNone
	/// for a centre.
	std::vector<Index> edge;
	/// #F_j: face of the parent level.
	std::vector<Index> face;
	/// #corners of level j: at an old vertex the corner of the parent level in whose sector it
	/// lies, and kNone; at a new one the corners of its parents, in the same face. kNone both where
	/// flips left nothing to follow.
	std::vector<std::array<Index, 2>> corner;
};

/// @param fans     of `child`
/// @param parents  see parentsOf()
/// Linear.
Descent descentOf(
    const CornerTable& parent,
    const CornerTable& child,
    const Refinement& refinement,
    const Parents& parents,
    const Fans& fans);

} // namespace wavemesh
