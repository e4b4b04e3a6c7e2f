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
	static constexpr int kMax = 6; ///< of a vertex with more, the first ones are known
	Index ring[kMax];
	/// Corner at the centre of face (centre, ring[i], ring[i+1]); kNone behind the last face of a
	/// boundary fan.
	Index corner[kMax];
	int size      = 0; ///< neighbours
	bool boundary = false;

	int find(Index v) const
	{
		for (int i = 0; i < size && i < kMax; ++i)
			if (ring[i] == v)
				return i;
		return -1;
	}
	/// Number of neighbours between two places, counter-clockwise.
	int between(int from, int to) const { return to - from - 1 + (to > from ? 0 : size); }
};

/// @param corner  one of firstCorners()
Star starAt(const CornerTable& table, Index corner);

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
	bool isChild(Index v) const { return vertex_[v].parents[0] != kNone; }
	bool isParent(Index v) const { return vertex_[v].childCount != 0; }
	bool isCentre(Index v) const { return isChild(v) && vertex_[v].parents[2] != kNone; }
	const std::array<Index, 3>& parents(Index v) const { return vertex_[v].parents; }
	int valence(Index v) const { return stars_[v].size; }                 ///< in M^j
	int coarseValence(Index v) const { return vertex_[v].coarseValence; } ///< in M^{j-1} so far

	const Star& star(Index v) const { return stars_[v]; }
	/// Can a vertex be a child of the neighbours at two places of its ring, as far as its faces go?
	static bool fits(const Star& star, int placeA, int placeB);
	/// A vertex has two sides, the left one first; on the boundary one.
	static int sideCount(const Star& star) { return star.boundary ? 1 : 2; }
	/// One side of a vertex whose parents are to be at these places. @pre fits()
	static Side side(const Star& star, int placeA, int placeB, int sideIndex);
	/// One side of a child that is no centre.
	Side side(Index child, int sideIndex) const
	{
		const auto& place = vertex_[child].place;
		return side(stars_[child], place[0], place[1], sideIndex);
	}
	/// Pattern of a child's side as the state stands; vertices that are not children stay.
	Pattern pattern(Index child, const Side& side, int sideIndex) const;
	/// Vertex across the edge that the corner faces, or kNone.
	Index across(Index corner) const
	{
		const Index o = fine_.opposite[corner];
		return o == kNone ? kNone : fine_.vertex[o];
	}

	/// Is the vertex undecided, and could these still be parents? What add() asks first.
	bool isOpen(const ChildOf& p) const
	{
		return !isChild(p.child) && !isParent(p.child) && !isChild(p.parentA) &&
		       !isChild(p.parentB);
	}

	/// `v` never becomes a child; it counts as a parent from now on.
	void keep(Index v) { ++vertex_[v].childCount; }
	/// Makes one or two vertices children, all or none. Vertices that are one already, with the
	/// same parents, are skipped.
	bool add(const ChildOf* proposals, int count);
	/// Removes a vertex of valence 3, whose neighbours must all stay.
	bool addCentre(Index v);

private:
	struct Vertex
	{
		std::array<Index, 3> parents {kNone, kNone, kNone}; ///< of a child; third only of a centre
		int coarseValence = 0;
		Index childCount  = 0;                ///< how many have it as parent
		Index edges       = kNone;            ///< list of new edges
		std::array<std::uint8_t, 2> place {}; ///< of a child: where its parents are in its ring
		/// Of a child, by side: the flip that holds an edge reserved.
		std::array<Pattern, 2> flip {Pattern::Invalid, Pattern::Invalid};
	};
	struct Undo
	{
		enum Kind : std::uint8_t { Child, EdgeAdded, EdgeRemoved, FlipOfSide0, FlipOfSide1 } kind;
		Pattern oldFlip;
		Index a, b; ///< the edge, or a the child
	};

	static Side sideAt(const Star& star, int from, int count);
	/// The side of a child that holds a neighbour which is not its parent; tells its index.
	Side sideWith(Index child, Index neighbour, int& sideIndex) const;

	bool propose(const ChildOf& proposal);
	bool settle(Index child);
	bool settleSideWith(Index child, Index neighbour);
	bool settleSide(Index child, const Side& side, int sideIndex);
	bool reserve(Index child, const Side& side, int sideIndex, Pattern flip);
	void release(Index child, const Side& side, int sideIndex);
	void rollBack();

	bool edgeInFine(Index a, Index b) const;
	bool edgeInCoarse(Index a, Index b) const;
	void orderEnds(Index& a, Index& b) const;
	void addEdge(Index a, Index b);
	void removeEdge(Index a, Index b);
	void insertEdge(Index a, Index b);
	void eraseEdge(Index a, Index b);

	Pattern patternWithoutFlip(const Side& side) const;
	bool flipsWith(Index child, Index neighbour) const;
	bool hasParents(Index v, Index a, Index b) const
	{
		const auto& p = vertex_[v].parents;
		return (p[0] == a && p[1] == b) || (p[0] == b && p[1] == a);
	}

	const CornerTable& fine_;
	std::vector<Vertex> vertex_; ///< #V
	std::vector<Star> stars_;    ///< #V

	/// Coarse edges that M^j does not have, in lists at the end with fewer neighbours.
	struct NewEdge
	{
		Index to, next;
		int uses; ///< 2 if two 1:2 faces flip with each other
	};
	std::vector<NewEdge> edges_;
	Index freeEdge_ = kNone;

	std::vector<Undo> undo_;
};

} // namespace wavemesh
