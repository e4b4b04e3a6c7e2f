// SPDX-License-Identifier: GPL-3.0-or-later
// The decoder's half of a split: templates as drawn in refinement.h, diagonals, flips, links.
#include "mesh_check.h"
#include "multires/refine.h"
#include "stage_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace wavemesh::test {
namespace {

CornerTable tableOf(const std::vector<Triangle>& faces, Index vertices)
{
	return buildCornerTable(faces, vertices).value();
}

Refinement nothing(const CornerTable& parent)
{
	Refinement r;
	r.parentVertices = r.childVertices = parent.vertexCount;
	r.childOnEdge.assign(parent.cornerCount(), kNone);
	r.faceCode.assign(parent.faceCount(), kFaceNone);
	return r;
}

void split(Refinement& r, const CornerTable& parent, Index corner)
{
	r.childOnEdge[corner] = r.childVertices++;
	if (parent.opposite[corner] != kNone)
		r.childOnEdge[parent.opposite[corner]] = r.childOnEdge[corner];
}

/// Refines one triangle whose corner 0 of the drawing is vertex `turn`; children are numbered
/// m0, m1, m2 as far as they exist, from 3. Expected faces: in the drawing's names, 3..5 the m's.
void expectTemplate(std::array<bool, 3> splits, FaceCode code, const std::vector<Triangle>& drawn)
{
	for (Index turn = 0; turn < 3; ++turn) {
		const CornerTable parent = tableOf({{0, 1, 2}}, 3);
		Refinement r             = nothing(parent);
		std::uint32_t name[7] = {turn, (turn + 1) % 3, (turn + 2) % 3, kNone, kNone, kNone, kNone};
		for (Index i = 0; i < 3; ++i)
			if (splits[i]) {
				name[3 + i] = r.childVertices;
				split(r, parent, (turn + i) % 3);
			}
		r.faceCode[0] = code;
		if (code == kFaceCentre) {
			name[6]      = r.childVertices++;
			r.hasCentres = true;
		}
		std::vector<Triangle> expected = drawn;
		for (Triangle& t : expected)
			for (auto& v : t)
				v = name[v];
		const CornerTable fine = refine(parent, r);
		EXPECT_EQ(sortedFaces(facesOf(fine)), sortedFaces(expected)) << turn;
		EXPECT_EQ(whatIsNotLinked(fine), "");
		EXPECT_EQ(whatIsNotManifold(meshOf(fine, {})), "");
	}
}

TEST(Refine_Template, 1To1_IsTheFace)
{
	expectTemplate({false, false, false}, kFaceNone, {{0, 1, 2}});
}
TEST(Refine_Template, 1To2_RunsFromCorner0ToTheChild)
{
	expectTemplate({true, false, false}, kFaceNone, {{0, 1, 3}, {0, 3, 2}});
}
TEST(Refine_Template, 1To3_HasTheDiagonalM2To2)
{
	expectTemplate({false, true, true}, kFaceNone, {{0, 5, 4}, {5, 1, 2}, {5, 2, 4}});
}
TEST(Refine_Template, 1To3WithDiagonal1_HasTheDiagonalM1To1)
{
	expectTemplate({false, true, true}, kFaceDiagonal1, {{0, 5, 4}, {5, 1, 4}, {4, 1, 2}});
}
TEST(Refine_Template, 1To4_HasTheMiddleTriangle)
{
	expectTemplate({true, true, true}, kFaceNone, {{0, 5, 4}, {1, 3, 5}, {2, 4, 3}, {3, 4, 5}});
}
TEST(Refine_Template, Centre_HasThreeFacesAroundANewVertex)
{
	expectTemplate({false, false, false}, kFaceCentre, {{0, 1, 6}, {1, 2, 6}, {2, 0, 6}});
}

// Two faces, (2, 0, 1) and (3, 2, 1)..: 1 and 3 face the edge 0-2.
const std::vector<Triangle> kPair {{0, 1, 2}, {0, 2, 3}};

TEST(Refine_Flip, WithAPlainFace_RunsFromTheChildToTheFarVertex)
{
	const CornerTable parent = tableOf(kPair, 4);
	Refinement r             = nothing(parent);
	split(r, parent, 2);        // the edge 0-1, faced by vertex 2: child 4
	r.faceCode[0] = kFaceFlip2; // corner 2 counted from the named one is vertex 1: edge 2-0
	EXPECT_EQ(
	    sortedFaces(facesOf(refine(parent, r))), sortedFaces({{4, 1, 2}, {0, 4, 3}, {4, 2, 3}}));
	// The mirror image: the edge 1-2, faced by vertex 0, has the child; corner 1 is vertex 1.
	r = nothing(parent);
	split(r, parent, 0);
	r.faceCode[0] = kFaceFlip1;
	EXPECT_EQ(
	    sortedFaces(facesOf(refine(parent, r))), sortedFaces({{0, 1, 4}, {0, 4, 3}, {4, 2, 3}}));
}

TEST(Refine_Flip, WithA1To2Face_RunsFromChildToChild)
{
	const CornerTable parent = tableOf(kPair, 4);
	for (const bool fromSecond : {false, true}) {
		Refinement r = nothing(parent);
		split(r, parent, 2); // 4 on 0-1
		split(r, parent, 3); // 5 on 2-3, faced by vertex 0
		if (fromSecond)
			r.faceCode[1] = kFaceFlip2; // named corner is vertex 0; corner 2 is vertex 3: edge 0-2
		else
			r.faceCode[0] = kFaceFlip2;
		const CornerTable fine = refine(parent, r);
		EXPECT_EQ(
		    sortedFaces(facesOf(fine)), sortedFaces({{2, 4, 1}, {0, 5, 3}, {0, 4, 5}, {4, 2, 5}}))
		    << fromSecond;
		EXPECT_EQ(whatIsNotLinked(fine), "");
	}
}

TEST(CanFlip, RefusesBoundaryUsedFacesAndFacesWithTwoOrMoreSplits)
{
	const CornerTable parent = tableOf(kPair, 4);
	Refinement r             = nothing(parent);
	split(r, parent, 2);
	std::vector<std::uint8_t> flipped(2, 0);
	EXPECT_TRUE(canFlip(parent, r, flipped, 1));
	EXPECT_FALSE(canFlip(parent, r, flipped, 0)) << "boundary";
	for (std::size_t used : {0u, 1u}) {
		flipped.assign(2, 0);
		flipped[used] = 1;
		EXPECT_FALSE(canFlip(parent, r, flipped, 1)) << used;
	}
	flipped.assign(2, 0);
	split(r, parent, 3);
	EXPECT_TRUE(canFlip(parent, r, flipped, 1)) << "1:2 behind";
	split(r, parent, 4);
	EXPECT_FALSE(canFlip(parent, r, flipped, 1)) << "1:3 behind";
}

// ---- against a naive refinement with sets of triangles ----

std::vector<Triangle>
naiveFace(const Refinement& r, const CornerTable& parent, Index f, Index centre)
{
	const FaceShape s = faceShape(r.childOnEdge, f);
	std::uint32_t v[3], m[3];
	for (Index i = 0; i < 3; ++i) {
		const Index c = 3 * f + (s.corner - 3 * f + i) % 3;
		v[i]          = parent.vertex[c];
		m[i]          = r.childOnEdge[c];
	}
	switch (s.splits) {
	case 1:
		return {{v[0], v[1], m[0]}, {v[0], m[0], v[2]}};
	case 2:
		if (r.faceCode[f] == kFaceDiagonal1)
			return {{v[0], m[2], m[1]}, {m[2], v[1], m[1]}, {m[1], v[1], v[2]}};
		return {{v[0], m[2], m[1]}, {m[2], v[1], v[2]}, {m[2], v[2], m[1]}};
	case 3:
		return {{v[0], m[2], m[1]}, {v[1], m[0], m[2]}, {v[2], m[1], m[0]}, {m[0], m[1], m[2]}};
	default:
		if (r.faceCode[f] == kFaceCentre)
			return {{v[0], v[1], centre}, {v[1], v[2], centre}, {v[2], v[0], centre}};
		return {{v[0], v[1], v[2]}};
	}
}

/// The face among `faces` that runs a -> b; moved to begin there.
Triangle& faceAlong(std::vector<Triangle>& faces, std::uint32_t a, std::uint32_t b)
{
	for (Triangle& t : faces)
		for (int k = 0; k < 3; ++k) {
			if (t[0] == a && t[1] == b)
				return t;
			std::rotate(t.begin(), t.begin() + 1, t.end());
		}
	throw std::runtime_error("no such edge");
}

std::vector<Triangle> naiveRefine(const CornerTable& parent, const Refinement& r)
{
	std::vector<std::vector<Triangle>> byFace;
	Index centre =
	    r.childVertices -
	    static_cast<Index>(std::count(r.faceCode.begin(), r.faceCode.end(), kFaceCentre));
	for (Index f = 0; f < parent.faceCount(); ++f) {
		byFace.push_back(naiveFace(r, parent, f, centre));
		centre += r.faceCode[f] == kFaceCentre;
	}
	for (Index f = 0; f < parent.faceCount(); ++f) {
		if (r.faceCode[f] != kFaceFlip1 && r.faceCode[f] != kFaceFlip2)
			continue;
		const Index named     = faceShape(r.childOnEdge, f).corner;
		const Index c         = r.faceCode[f] == kFaceFlip1 ? nextCorner(named) : prevCorner(named);
		const std::uint32_t a = parent.vertex[nextCorner(c)], b = parent.vertex[prevCorner(c)];
		Triangle& near        = faceAlong(byFace[f], a, b);
		Triangle& far         = faceAlong(byFace[parent.opposite[c] / 3], b, a);
		const std::uint32_t l = near[2], o = far[2];
		near = {l, a, o};
		far  = {o, b, l};
	}
	std::vector<Triangle> all;
	for (const auto& faces : byFace)
		all.insert(all.end(), faces.begin(), faces.end());
	return all;
}

TEST(Refine, OfRandomRefinements_IsWhatTheDrawingsSay)
{
	Rng rng(61);
	for (const NamedMesh& m : smallFamilies(200)) {
		const StageMesh parent = stageMesh(m.mesh);
		for (int round = 0; round < 20; ++round) {
			const Refinement r     = randomRefinement(parent.table, rng);
			const CornerTable fine = refine(parent.table, r);
			ASSERT_EQ(fine.vertexCount, r.childVertices);
			ASSERT_EQ(sortedFaces(facesOf(fine)), sortedFaces(naiveRefine(parent.table, r)))
			    << m.name;
			ASSERT_EQ(whatIsNotLinked(fine), "") << m.name;
		}
	}
}

TEST(Refine, WithoutFlips_IsManifoldOfTheSameTopologyAndKeepsTheOrderOfFaces)
{
	Rng rng(62);
	for (const NamedMesh& m : smallFamilies(200)) {
		const StageMesh parent = stageMesh(m.mesh);
		Topology before, after;
		ASSERT_EQ(whatIsNotManifold(m.mesh, &before), "");
		for (int round = 0; round < 10; ++round) {
			const Refinement r     = randomRefinement(parent.table, rng, false);
			const CornerTable fine = refine(parent.table, r);
			ASSERT_EQ(whatIsNotManifold(meshOf(fine, {}), &after), "") << m.name;
			ASSERT_EQ(after.euler, before.euler);
			ASSERT_EQ(after.boundaryLoops, before.boundaryLoops);
			// Descendants of a face: contiguous and in the order of the faces.
			std::vector<Triangle> naive = naiveRefine(parent.table, r), got = facesOf(fine);
			for (std::size_t begin = 0, f = 0; begin < got.size(); ++f) {
				const auto n   = naiveFace(r, parent.table, static_cast<Index>(f), 0).size();
				const auto at  = static_cast<std::ptrdiff_t>(begin),
				           end = at + static_cast<std::ptrdiff_t>(n);
				ASSERT_EQ(
				    sortedFaces({got.begin() + at, got.begin() + end}),
				    sortedFaces({naive.begin() + at, naive.begin() + end}));
				begin += n;
			}
		}
	}
}

TEST(Refine, FullSplit_QuadruplesTheFaces)
{
	const StageMesh parent = stageMesh(makeTorus(12, 9));
	Refinement r           = nothing(parent.table);
	for (Index c = 0; c < parent.table.cornerCount(); ++c)
		if (r.childOnEdge[c] == kNone)
			split(r, parent.table, c);
	const CornerTable fine = refine(parent.table, r);
	EXPECT_EQ(fine.faceCount(), 4 * parent.table.faceCount());
	EXPECT_EQ(fine.vertexCount, 4 * parent.table.vertexCount) << "a torus: V = E / 3";
	EXPECT_EQ(whatIsNotManifold(meshOf(fine, {})), "");
}

} // namespace
} // namespace wavemesh::test
