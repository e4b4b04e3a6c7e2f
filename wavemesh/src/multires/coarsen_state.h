// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The state of a coarsening in progress: which vertices are children of which edges, and the rules
/// that keep it valid. The search (coarsen.cpp) proposes, this class refuses or records.
///
/// Given a manifold M^j; leaves, at any time, a description of a manifold M^{j-1}.
#pragma once

#include "multires/refinement.h"

namespace wavemesh {

/// Neighbours of a vertex in counter-clockwise order; only vertices with few can become children.
struct Star
{
	static constexpr int kMax = 6;
	int size                  = 0; ///< neighbours; kMax + 1 if there are more
	bool boundary             = false;
	Index ring[kMax + 1];
	Index corner[kMax + 1]; ///< corner at the centre of face (centre, ring[i], ring[i+1])

	int find(Index v) const
	{
		for (int i = 0; i < size && i < kMax; ++i)
			if (ring[i] == v)
				return i;
		return -1;
	}
};

/// The faces on one side of a child m, from parent `from` counter-clockwise to parent `to`:
///
///        inner[1] --- inner[0]
///          /   \      /  \          count = 2 as drawn, or 1
///         /     \    /    \         corner[i] at m, in its i-th face counted from `from`
///       to ------ m ------ from
struct Side
{
	Index from, to;
	int count;
	Index inner[2];
	Index corner[3];
};

/// What the faces on a side merge into.
enum class Pattern : std::uint8_t {
	Invalid,
	Two,             ///< 2:1, apex inner[0]
	TwoFlipAtFrom,   ///< 2:1, apex inner[1]; edge m-inner[0] flips back to from-inner[1]
	TwoFlipAtTo,     ///< 2:1, apex inner[0]; edge m-inner[1] flips back to to-inner[0]
	ThreeFrom,       ///< 3:1 with inner[0] on the edge from-apex, diagonal at m; apex inner[1]
	ThreeTo,         ///< 3:1 with inner[1] on the edge to-apex, diagonal at m; apex inner[0]
	ThreeBehindFrom, ///< 3:1 with inner[0] on the edge from-apex, diagonal to-inner[0]
	ThreeBehindTo,   ///< 3:1 with inner[0] on the edge to-apex, diagonal from-inner[0]
	Four,            ///< 4:1 with both
};

struct ChildOf
{
	Index child, parentA, parentB;
};

class CoarsenState
{
public:
	explicit CoarsenState(const CornerTable& fine);

	const CornerTable& fine() const { return fine_; }
	bool isChild(Index v) const { return parents_[v][0] != kNone; }
	bool isParent(Index v) const { return childCount_[v] != 0; }
	bool isCentre(Index v) const { return isChild(v) && parents_[v][2] != kNone; }
	const std::array<Index, 3>& parents(Index v) const { return parents_[v]; }
	int valence(Index v) const { return int(valence_[v]); }        ///< in M^j
	int coarseValence(Index v) const { return coarseValence_[v]; } ///< in M^{j-1} as it stands

	Star star(Index v) const;
	/// Sides of v between two neighbours that are to be its parents: the left side first; a
	/// boundary vertex has one. Returns their number, 0 if v cannot be a child of these.
	int sides(const Star& star, Index parentA, Index parentB, Side side[2]) const;
	/// Sides of a child.
	int sides(Index child, Side side[2]) const;
	/// Pattern of a child's side as the state stands; vertices that are not children stay.
	Pattern pattern(Index child, const Side& side, int sideIndex) const;
	/// Vertex across the edge that the corner faces, or kNone.
	Index across(Index corner) const
	{
		const Index o = fine_.opposite[corner];
		return o == kNone ? kNone : fine_.vertex[o];
	}

	/// `v` never becomes a child; it counts as a parent from now on.
	void keep(Index v) { ++childCount_[v]; }
	/// Makes one or two vertices children, all or none. Vertices that are one already, with the
	/// same parents, are skipped.
	bool add(const ChildOf* proposals, int count);
	/// Removes a vertex of valence 3, whose neighbours must all stay.
	bool addCentre(Index v);

private:
	struct Undo
	{
		enum Kind : std::uint8_t { Child, EdgeAdded, EdgeRemoved, FlipOfSide0, FlipOfSide1 } kind;
		Pattern oldFlip;
		Index a, b; ///< the edge, or a the child
	};

	bool propose(const ChildOf& proposal, Star& star);
	bool settle(Index child);
	bool settleSide(Index child, const Side& side, int sideIndex);
	bool reserve(Index child, const Side& side, int sideIndex, Pattern flip);
	void release(Index child, const Side& side, int sideIndex);
	void rollBack();

	bool edgeInFine(Index a, Index b) const;
	bool edgeInCoarse(Index a, Index b) const;
	void addEdge(Index a, Index b);
	void removeEdge(Index a, Index b);
	void insertEdge(Index a, Index b);
	void eraseEdge(Index a, Index b);

	Pattern patternWithoutFlip(const Side& side) const;
	bool flipsWith(Index child, Index neighbour) const;
	bool hasParents(Index v, Index a, Index b) const
	{
		return (parents_[v][0] == a && parents_[v][1] == b) ||
		       (parents_[v][0] == b && parents_[v][1] == a);
	}

	const CornerTable& fine_;
	std::vector<Index> first_;                  ///< #V: corner where the fan begins
	std::vector<Index> valence_;                ///< #V
	std::vector<std::array<Index, 3>> parents_; ///< #V: of a child; third only of a centre
	std::vector<Index> childCount_;             ///< #V: how many have it as parent
	std::vector<int> coarseValence_;            ///< #V
	std::vector<std::array<Pattern, 2>> flip_; ///< #V by side: the flip that holds an edge reserved

	/// Coarse edges that M^j does not have, in lists at the end with fewer neighbours.
	struct NewEdge
	{
		Index to, next;
		int uses; ///< 2 if two 1:2 faces flip with each other
	};
	std::vector<Index> edgeHead_; ///< #V
	std::vector<NewEdge> edges_;
	Index freeEdge_ = kNone;

	std::vector<Undo> undo_;
};

} // namespace wavemesh
