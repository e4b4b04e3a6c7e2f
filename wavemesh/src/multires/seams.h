// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Lines on the surface that coarse levels keep: the seams between the charts of a texture. A
/// vertex on one goes only between its two neighbours on it, so that each coarse face stays within
/// one chart. Ends and crossings of seams stay.
#pragma once

#include "multires/coarsen_state.h"

namespace wavemesh {

struct Coarsening;

/// Of a level. Encoder only.
class Seams
{
public:
	Seams() = default; ///< none
	/// @param onSeam  #corners: 1 if the edge that the corner faces is on a seam; both corners of
	///                an edge say the same. The boundary counts as one where a seam meets it.
	Seams(const CornerTable& table, const std::vector<std::uint8_t>& onSeam);

	bool any() const { return !along_.empty(); }
	/// May this vertex go so?
	bool allows(const ChildOf& p) const
	{
		if (!any() || !isOn(p.child))
			return true;
		const auto& n = along_[p.child];
		return (n[0] == p.parentA && n[1] == p.parentB) || (n[0] == p.parentB && n[1] == p.parentA);
	}
	bool allowsCentre(Index v) const { return !any() || !isOn(v); }
	/// Goes to the next coarser level. @param step  that kept to allows(). Linear.
	void carry(const Coarsening& step);

private:
	bool isOn(Index v) const { return along_[v][0] != kNone; }

	/// #V: the neighbours on the seam; itself twice if there are other than two; kNone if there are
	/// none. Empty: there are no seams.
	std::vector<std::array<Index, 2>> along_;
};

} // namespace wavemesh
