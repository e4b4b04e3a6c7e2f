// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Vertices of the base mesh that stand for the same vertex of the original, because the original
/// was opened there (mesh/manifold_cut.h). They are never removed by coarsening and never moved by
/// lifting, so they lie at the same place in every level: no cracks.
#pragma once

#include "mesh/corner_table.h"

#include <algorithm>
#include <unordered_map>

namespace wavemesh {

struct Glue
{
	/// #V_0: the lowest vertex of level 0 that stands for the same original; itself for most. Empty
	/// if nothing is glued. Vertices of finer levels are never glued.
	std::vector<Index> first;
	std::vector<std::uint8_t> shared; ///< #V_0: 1 if it is not the only one of its original

	bool empty() const { return first.empty(); }
	bool isCopy(Index v) const { return v < first.size() && first[v] != v; }
	bool isShared(Index v) const { return v < shared.size() && shared[v] != 0; }
};

/// @param group  #V_0: vertices of the same group, other than kNone, are glued
/// @return empty if there are none
inline Glue glueOf(const std::vector<Index>& group)
{
	Glue glue;
	std::unordered_map<Index, Index> firstOf;
	glue.first.resize(group.size());
	glue.shared.resize(group.size(), 0);
	for (Index v = 0; v < group.size(); ++v) {
		glue.first[v] = group[v] == kNone ? v : firstOf.emplace(group[v], v).first->second;
		if (glue.first[v] != v)
			glue.shared[v] = glue.shared[glue.first[v]] = 1;
	}
	const bool any = std::find(glue.shared.begin(), glue.shared.end(), 1) != glue.shared.end();
	return any ? glue : Glue();
}

} // namespace wavemesh
