// SPDX-License-Identifier: GPL-3.0-or-later
#include "isomorphism.h"

#include "mesh_edit.h"
#include "mesh_families.h"

#include <gtest/gtest.h>

#include <cmath>

namespace wavemesh::test {

namespace {

tool::LabelledMesh labelled(const MeshData& mesh, double step = 1.0 / 1024)
{
	tool::LabelledMesh out;
	out.triangles = mesh.triangles;
	for (const auto& p : mesh.positions)
		out.labels.push_back(
		    {std::llround(p[0] / step), std::llround(p[1] / step), std::llround(p[2] / step)});
	return out;
}

/// As on a lattice of one point: only the connectivity counts.
tool::LabelledMesh unlabelled(const MeshData& mesh)
{
	return labelled(scaled(mesh, 0, 0, 0));
}

} // namespace

TEST(Isomorphism, AcceptsEveryFamilyShuffled)
{
	for (const NamedMesh& m : allFamilies()) {
		const double step = m.name == "tiny" ? 1e-12 : m.name == "huge" ? 1e6 : 1.0 / 64;
		EXPECT_EQ(
		    tool::whatDiffers(labelled(m.mesh, step), labelled(shuffled(m.mesh, 3), step)), "")
		    << m.name;
	}
}

TEST(Isomorphism, AcceptsConnectivityAlone)
{
	for (const NamedMesh& m : allFamilies())
		EXPECT_EQ(tool::whatDiffers(unlabelled(m.mesh), unlabelled(shuffled(m.mesh, 9))), "")
		    << m.name;
}

TEST(Isomorphism, SeesAFlippedEdgeThoughAllVerticesAreInOnePoint)
{
	for (const MeshData& mesh : {makeTorus(9, 7), makeIcosphere(4), makeFlippedSphere(200, 3)}) {
		MeshEdit edit(mesh);
		std::uint32_t h = 0;
		while (!edit.flip(h))
			++h;
		EXPECT_NE(tool::whatDiffers(unlabelled(mesh), unlabelled(edit.result())), "");
	}
}

TEST(Isomorphism, TellsATorusFromATwistedOne)
{
	// All valences are 6 and all labels the same: locally nothing is different.
	const int n = 12, m = 7;
	MeshData straight = makeTorus(n, m), twisted = straight;
	auto at = [&](int i, int j) {
		return static_cast<std::uint32_t>(i % n * m + (j + (i >= n ? 3 : 0)) % m);
	};
	twisted.triangles.clear();
	for (int i = 0; i < n; ++i)
		for (int j = 0; j < m; ++j) {
			twisted.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
			twisted.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
		}
	EXPECT_EQ(tool::whatDiffers(unlabelled(twisted), unlabelled(shuffled(twisted, 1))), "");
	EXPECT_NE(tool::whatDiffers(unlabelled(straight), unlabelled(twisted)), "");
}

TEST(Isomorphism, TellsAMeshFromItsMirrorImage)
{
	const MeshData mesh = makeFlippedSphere(100, 3);
	MeshData mirrored   = mesh;
	for (auto& t : mirrored.triangles)
		std::swap(t[1], t[2]);
	EXPECT_NE(tool::whatDiffers(unlabelled(mesh), unlabelled(mirrored)), "");
}

TEST(Isomorphism, TellsWhichComponentsBelongTogether)
{
	// Two components each; the labels as a whole are the same.
	const MeshData a = makeIcosphere(3), b = makeKleetope(makeIcosahedron());
	const MeshData c = flipRandomEdges(a, 1, *std::make_unique<Rng>(1));
	EXPECT_EQ(tool::whatDiffers(unlabelled(joined({a, b, c})), unlabelled(joined({c, a, b}))), "");
	EXPECT_NE(tool::whatDiffers(unlabelled(joined({a, b, a})), unlabelled(joined({a, b, c}))), "");
}

TEST(Isomorphism, MapsOneVertexToOne)
{
	// Faces fit one by one, but two vertices of one mesh are one vertex of the other.
	const MeshData apart = joined({makeTriangle(), makeTriangle()});
	tool::LabelledMesh x = unlabelled(apart), y = x;
	y.triangles[1] = y.triangles[0];
	EXPECT_NE(tool::whatDiffers(x, y), "");
	EXPECT_NE(tool::whatDiffers(y, x), "");
}

TEST(Isomorphism, OfALargeMeshIsFound)
{
	// Comparing every vertex with every other one would not end.
	const MeshData mesh = makeBumpySphere(200000, 3);
	EXPECT_EQ(tool::whatDiffers(labelled(mesh), labelled(shuffled(mesh, 1))), "");
}

} // namespace wavemesh::test
