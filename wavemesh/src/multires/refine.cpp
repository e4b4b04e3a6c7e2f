// SPDX-License-Identifier: GPL-3.0-or-later
#include "multires/refine.h"

#include <cassert>

namespace wavemesh {
namespace {

/// One way to subdivide a face. Points 0..2 are its corners, 3..5 the children on the edges that
/// corners 0..2 face, 6 the centre.
struct Template
{
	int faces;
	int point[4][3];
	/// Corner of the descendants that faces each half of edge i, from the end next(i) to prev(i);
	/// both halves the same where the edge is not split.
	int outer[3][2];
};

enum TemplateId { kPlain, kCentre, kTwo, kThreeDiagonal2, kThreeDiagonal1, kFour };

constexpr Template kTemplates[] = {
    // 1:1
    {1, {{0, 1, 2}}, {{0, 0}, {1, 1}, {2, 2}}},
    // centre
    {3, {{6, 1, 2}, {6, 2, 0}, {6, 0, 1}}, {{0, 0}, {3, 3}, {6, 6}}},
    // 1:2, the child on the edge that corner 0 faces
    {2, {{0, 1, 3}, {0, 3, 2}}, {{0, 3}, {4, 4}, {2, 2}}},
    // 1:3, the edge that corner 0 faces is whole; diagonal from the child next to 1 to vertex 2
    {3, {{0, 5, 4}, {5, 1, 2}, {5, 2, 4}}, {{3, 3}, {6, 1}, {2, 5}}},
    // 1:3, diagonal from the child next to 2 to vertex 1
    {3, {{0, 5, 4}, {5, 1, 4}, {4, 1, 2}}, {{6, 6}, {7, 1}, {2, 5}}},
    // 1:4
    {4, {{0, 5, 4}, {1, 3, 5}, {2, 4, 3}, {3, 4, 5}}, {{5, 7}, {8, 1}, {2, 4}}},
};

/// Pairs of descendant corners that face each other inside the face.
struct InnerLinks
{
	int count;
	int pair[3][2];
};
constexpr InnerLinks kInnerLinks[] = {
    {0, {}},
    {3, {{1, 5}, {4, 8}, {7, 2}}},
    {1, {{1, 5}}},
    {2, {{0, 7}, {4, 8}}},
    {2, {{0, 4}, {3, 8}}},
    {3, {{0, 9}, {3, 10}, {6, 11}}},
};

struct Placement
{
	Index first;           ///< first descendant face
	std::uint8_t id;       ///< TemplateId
	std::uint8_t rotation; ///< corner of the face that plays point 0
};

Placement place(const Refinement& r, Index face, Index firstDescendant)
{
	const FaceShape shape = faceShape(r.childOnEdge, face);
	const FaceCode code   = r.faceCode[face];
	TemplateId id         = kFour;
	if (shape.splits == 0)
		id = code == kFaceCentre ? kCentre : kPlain;
	else if (shape.splits == 1)
		id = kTwo;
	else if (shape.splits == 2)
		id = code == kFaceDiagonal1 ? kThreeDiagonal1 : kThreeDiagonal2;
	return {firstDescendant, std::uint8_t(id), std::uint8_t(shape.corner - 3 * face)};
}

/// Corner among the descendants of c's face that faces half `half` of c's edge.
Index outerCorner(const std::vector<Placement>& placements, Index c, int half)
{
	const Index face   = c / 3;
	const Placement& p = placements[face];
	const int turned   = int(c - 3 * face) - p.rotation;
	return 3 * p.first + Index(kTemplates[p.id].outer[turned < 0 ? turned + 3 : turned][half]);
}

void flipEdge(CornerTable& t, Index c)
{
	// Faces (c, n, p) and (d, p, n) share the edge n-p; afterwards it runs from vertex(c) to
	// vertex(d).
	const Index d  = t.opposite[c];
	const Index cn = nextCorner(c), cp = prevCorner(c), dn = nextCorner(d), dp = prevCorner(d);
	const Index acrossCn = t.opposite[cn], acrossDn = t.opposite[dn];
	t.vertex[cp] = t.vertex[d];
	t.vertex[dp] = t.vertex[c];
	t.link(c, acrossDn);
	t.link(d, acrossCn);
	t.link(cn, dn);
}

} // namespace

bool canFlip(
    const CornerTable& parent,
    const Refinement& r,
    const std::vector<std::uint8_t>& flipped,
    Index edgeCorner)
{
	const Index across = parent.opposite[edgeCorner];
	if (across == kNone || flipped[edgeCorner / 3] || flipped[across / 3])
		return false;
	// Faces that share a second edge (only damaged files have them) would lose their adjacency.
	for (const Index c : {nextCorner(edgeCorner), prevCorner(edgeCorner)})
		if (parent.opposite[c] != kNone && parent.opposite[c] / 3 == across / 3)
			return false;
	const FaceShape shape = faceShape(r.childOnEdge, across / 3);
	return shape.splits == 0 || shape.splits == 1;
}

CornerTable refine(const CornerTable& parent, const Refinement& r)
{
	assert(r.childOnEdge.size() == parent.vertex.size());
	std::vector<Placement> placements(parent.faceCount());
	Index faces = 0;
	for (Index f = 0; f < parent.faceCount(); ++f) {
		placements[f] = place(r, f, faces);
		faces += Index(kTemplates[placements[f].id].faces);
	}

	CornerTable fine;
	fine.vertexCount = r.childVertices;
	fine.vertex.resize(3 * std::size_t(faces));
	fine.opposite.resize(3 * std::size_t(faces), kNone);

	Index centre = r.childVertices; // centres are the last vertices of the level, in face order
	if (r.hasCentres)
		for (const FaceCode code : r.faceCode)
			centre -= code == kFaceCentre;

	for (Index f = 0; f < parent.faceCount(); ++f) {
		const Placement& p = placements[f];
		const Template& t  = kTemplates[p.id];
		const Index base   = 3 * p.first;
		Index points[7];
		for (Index i = 0; i < 3; ++i) {
			const Index turned = p.rotation + i;
			const Index c      = 3 * f + (turned < 3 ? turned : turned - 3);
			points[i]          = parent.vertex[c];
			points[3 + i]      = r.childOnEdge[c];
		}
		points[6] = p.id == kCentre ? centre++ : kNone;
		for (int k = 0; k < t.faces; ++k)
			for (int i = 0; i < 3; ++i)
				fine.vertex[base + Index(3 * k + i)] = points[t.point[k][i]];
		const InnerLinks& links = kInnerLinks[p.id];
		for (int k = 0; k < links.count; ++k)
			fine.link(base + Index(links.pair[k][0]), base + Index(links.pair[k][1]));

		for (Index i = 0; i < 3; ++i) {
			const Index c = 3 * f + i, d = parent.opposite[c];
			if (d == kNone || d > 3 * f + 2)
				continue; // linked from the face that comes later
			fine.link(outerCorner(placements, c, 0), outerCorner(placements, d, 1));
			if (r.childOnEdge[c] != kNone)
				fine.link(outerCorner(placements, c, 1), outerCorner(placements, d, 0));
		}
	}
	for (Index f = 0; f < parent.faceCount(); ++f)
		if (r.faceCode[f] == kFaceFlip1 || r.faceCode[f] == kFaceFlip2) {
			const Index turn = r.faceCode[f] == kFaceFlip1 ? 1 : 2;
			const Index c    = faceShape(r.childOnEdge, f).corner;
			flipEdge(fine, outerCorner(placements, 3 * f + (c - 3 * f + turn) % 3, 0));
		}
	return fine;
}

} // namespace wavemesh
