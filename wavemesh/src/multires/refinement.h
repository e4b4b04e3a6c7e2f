// SPDX-License-Identifier: GPL-3.0-or-later
/** @file
The parent -> child map of one split: everything the paper calls D1, D2 and D3 (sec. IV), as plain
arrays over the corners and faces of the parent level.

Corner i of a face faces one of its edges; `child[i]` is the vertex on that edge. With the face
turned so that corner 0 is the one named:

           0                 0                 0                  0
          / \               /|\               / \                / \
         /   \             / | \            m2---m1            m2---m1
        /     \           /  |  \           / \    \          /  \ /  \
       1-------2         1---m0--2         1----\---2        1---m0---2
      1:1 (plain)     1:2, 0 faces the    1:3, 0 faces the    1:4
                      split edge          edge not split

A 1:3 face is closed by one diagonal (D2; drawn: m2-2), a 1:2 face may flip one of its two edges
that are not split (D3): the edge then runs from the child to the far vertex of the face behind.
*/
#pragma once

#include "mesh/corner_table.h"

namespace wavemesh {

/// What a face of the parent level needs besides the children on its edges.
enum FaceCode : std::uint8_t {
	kFaceNone      = 0, ///< 1:1, 1:4; also 1:2 without flip, 1:3 with diagonal m2-2
	kFaceDiagonal1 = 1, ///< 1:3, D2: diagonal m1-1 in place of m2-2
	kFaceFlip1     = 2, ///< 1:2, D3: flips the edge that corner 1 faces (0-2)
	kFaceFlip2     = 3, ///< 1:2, D3: flips the edge that corner 2 faces (0-1)
	kFaceCentre    = 4, ///< 1:1 becomes 1:3 around a vertex of valence 3 (beyond the paper)
};

struct Refinement
{
	Index parentVertices = 0;
	Index childVertices  = 0; ///< of the finer level; its first parentVertices are the parent's
	/// #parent corners: new vertex on the edge that the corner faces, or kNone
	std::vector<Index> childOnEdge;
	std::vector<FaceCode> faceCode; ///< #parent faces
	bool hasCentres = false;        ///< is any face code kFaceCentre?
};

/// Calls visit(corner, child) for each split edge, by the lower of the corners that face it: in the
/// order of the new vertices.
template <class Visit>
void forEachSplitEdge(
    const CornerTable& parent, const std::vector<Index>& childOnEdge, const Visit& visit)
{
	for (Index c = 0; c < parent.cornerCount(); ++c) {
		const Index d = parent.opposite[c];
		if (childOnEdge[c] != kNone && (d == kNone || c < d))
			visit(c, childOnEdge[c]);
	}
}

/// Number of split edges of a face, 0..3, and the corner that stands for it: the corner facing the
/// split edge (1:2) or the edge that is not split (1:3), else the first.
struct FaceShape
{
	int splits;
	Index corner;
};
inline FaceShape faceShape(const std::vector<Index>& childOnEdge, Index face)
{
	const Index c   = 3 * face;
	const bool s[3] = {
	    childOnEdge[c] != kNone, childOnEdge[c + 1] != kNone, childOnEdge[c + 2] != kNone};
	const int splits = int(s[0]) + int(s[1]) + int(s[2]);
	Index special    = 0;
	if (splits == 1)
		special = s[0] ? 0 : s[1] ? 1 : 2;
	else if (splits == 2)
		special = !s[0] ? 0 : !s[1] ? 1 : 2;
	return {splits, c + special};
}

} // namespace wavemesh
