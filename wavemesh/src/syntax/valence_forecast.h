// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The valences of the finer level as far as the refinement is known: meshes have mostly six, which
/// tells where edges were flipped.
#pragma once

#include "multires/refinement.h"

#include <vector>

namespace wavemesh {

/// Valences of all vertices of the finer level in halves, on the boundary two more; a diagonal that
/// is not known yet counts half at both places.
class ValenceForecast
{
public:
	/// @param r  splits whole; no diagonals and flips yet
	ValenceForecast(
	    const CornerTable& parent, const std::vector<Index>& valence, const Refinement& r) :
	        parent_(parent),
	        r_(r), halves_(r.childVertices, 0)
	{
		for (Index v = 0; v < parent.vertexCount; ++v)
			halves_[v] = 2 * static_cast<int>(valence[v]);
		for (Index f = 0; f < parent.faceCount(); ++f)
			addFace(f);
	}

	int of(Index v) const { return halves_[v]; }
	/// Half valences that a flip of the edge takes from its ends more than from those it joins.
	int flipGain(Index corner, Index edge) const
	{
		return of(end(nextCorner(edge))) + of(end(prevCorner(edge))) - of(r_.childOnEdge[corner]) -
		       of(far(edge));
	}
	void diagonal(Index corner, bool one)
	{
		const Index c1 = nextCorner(corner), c2 = prevCorner(corner);
		const int change = one ? 1 : -1;
		halves_[end(c1)] += change;
		halves_[r_.childOnEdge[c1]] += change;
		halves_[end(c2)] -= change;
		halves_[r_.childOnEdge[c2]] -= change;
	}
	void flip(Index corner, Index edge)
	{
		halves_[end(nextCorner(edge))] -= 2;
		halves_[end(prevCorner(edge))] -= 2;
		halves_[r_.childOnEdge[corner]] += 2;
		halves_[far(edge)] += 2;
	}

private:
	Index end(Index corner) const { return parent_.vertex[corner]; }
	/// The vertex that a flip of the edge joins with the child: that of the face behind.
	Index far(Index edge) const
	{
		const Index d         = parent_.opposite[edge];
		const FaceShape shape = faceShape(r_.childOnEdge, d / 3);
		return shape.splits == 1 ? r_.childOnEdge[shape.corner] : parent_.vertex[d];
	}
	void addFace(Index f)
	{
		const FaceShape shape = faceShape(r_.childOnEdge, f);
		if (shape.splits == 1)
			halves_[end(shape.corner)] += 2;
		if (shape.splits == 2) {
			++halves_[end(nextCorner(shape.corner))];
			++halves_[end(prevCorner(shape.corner))];
		}
		for (Index c = 3 * f; c < 3 * f + 3; ++c) {
			const bool boundary = parent_.opposite[c] == kNone;
			const Index child   = r_.childOnEdge[c];
			if (child != kNone)
				halves_[child] += 3 + shape.splits + (boundary ? 6 : 0);
			if (boundary) {
				halves_[parent_.vertex[nextCorner(c)]] += 2;
				halves_[parent_.vertex[prevCorner(c)]] += 2;
			}
		}
	}

	const CornerTable& parent_;
	const Refinement& r_;
	std::vector<int> halves_; ///< #V of the finer level
};

} // namespace wavemesh
