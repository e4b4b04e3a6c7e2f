// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons put together from triangles.
#include "polygons.h"
#include "rng.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace wavemesh::test {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Edge     = std::pair<std::uint32_t, std::uint32_t>;

/// @param inside  edges inside a polygon, in either direction
MeshData meshOf(const std::vector<Triangle>& triangles, const std::vector<Edge>& inside)
{
	MeshData m;
	m.triangles = triangles;
	Attribute a;
	a.of         = AttributeOf::Face;
	a.kind       = AttributeKind::FauxEdges;
	a.components = 1;
	for (const Triangle& t : triangles) {
		unsigned bits = 0;
		for (std::size_t k = 0; k < 3; ++k) {
			const Edge edge {t[k], t[(k + 1) % 3]}, back {edge.second, edge.first};
			for (const Edge& e : inside)
				bits |= e == edge || e == back ? 1u << k : 0u;
			m.positions.resize(std::max<std::size_t>(m.positions.size(), t[k] + 1));
		}
		a.values.push_back(bits);
	}
	m.attributes.push_back(a);
	return m;
}

/// A polygon of n corners as a fan around its first; its triangles in any order and turned anyhow.
MeshData fan(std::uint32_t n, Rng& rng)
{
	std::vector<Triangle> triangles;
	std::vector<Edge> inside;
	for (std::uint32_t i = 1; i + 1 < n; ++i) {
		Triangle t {0, i, i + 1};
		std::rotate(t.begin(), t.begin() + rng.below(3), t.end());
		triangles.push_back(t);
		if (i > 1)
			inside.push_back({0, i});
	}
	for (std::size_t i = triangles.size(); i > 1; --i)
		std::swap(triangles[i - 1], triangles[rng.below(std::uint32_t(i))]);
	return meshOf(triangles, inside);
}

bool alike(std::uint32_t, std::uint32_t)
{
	return true;
}

std::vector<std::vector<std::uint32_t>> verticesOf(const MeshData& m, const tool::Polygons& p)
{
	std::vector<std::vector<std::uint32_t>> faces(p.count());
	for (std::size_t f = 0; f < p.count(); ++f)
		for (std::size_t i = p.begin[f]; i < p.begin[f + 1]; ++i)
			faces[f].push_back(m.triangles[p.corners[i] / 3][p.corners[i] % 3]);
	return faces;
}

/// Do all triangles stay what they are?
void expectTriangles(const MeshData& m, const tool::Polygons& p)
{
	EXPECT_FALSE(p.complete);
	auto faces = verticesOf(m, p);
	ASSERT_EQ(faces.size(), m.triangles.size());
	std::vector<std::vector<std::uint32_t>> wanted;
	for (const Triangle& t : m.triangles)
		wanted.push_back({t.begin(), t.end()});
	std::sort(faces.begin(), faces.end());
	std::sort(wanted.begin(), wanted.end());
	EXPECT_EQ(faces, wanted);
}

TEST(Polygons, OfAFanBeginAtItsApex)
{
	Rng rng(5);
	for (const std::uint32_t n : {5u, 6u, 9u, 1000u}) {
		const MeshData m       = fan(n, rng);
		const tool::Polygons p = tool::polygonsOf(m, alike);
		EXPECT_TRUE(p.complete);
		std::vector<std::uint32_t> all(n);
		for (std::uint32_t i = 0; i < n; ++i)
			all[i] = i;
		EXPECT_EQ(verticesOf(m, p), (std::vector<std::vector<std::uint32_t>> {all}));
	}
}

TEST(Polygons, WithoutAnApexAreWholeToo)
{
	const MeshData m =
	    meshOf({{0, 1, 2}, {2, 3, 4}, {4, 5, 0}, {0, 2, 4}}, {{0, 2}, {2, 4}, {4, 0}});
	const tool::Polygons p = tool::polygonsOf(m, alike);
	EXPECT_TRUE(p.complete);
	EXPECT_EQ(verticesOf(m, p), (std::vector<std::vector<std::uint32_t>> {{0, 1, 2, 3, 4, 5}}));
}

TEST(Polygons, BesideTrianglesAndEachOther)
{
	const MeshData m =
	    meshOf({{0, 1, 2}, {0, 2, 3}, {2, 4, 3}, {3, 4, 5}, {4, 6, 5}}, {{0, 2}, {4, 5}});
	const tool::Polygons p = tool::polygonsOf(m, alike);
	EXPECT_TRUE(p.complete);
	const auto faces = verticesOf(m, p);
	ASSERT_EQ(faces.size(), 3u);
	EXPECT_EQ(faces[0], (std::vector<std::uint32_t> {0, 1, 2, 3}));
	EXPECT_EQ(faces[1], (std::vector<std::uint32_t> {2, 4, 3}));
	EXPECT_EQ(faces[2].size(), 4u);
}

TEST(Polygons, ThatAreNoneStayTriangles)
{
	const std::vector<std::pair<const char*, MeshData>> cases = {
	    {"a vertex inside", meshOf({{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}, {{0, 1}, {0, 2}, {0, 3}})},
	    {"a ring", meshOf(
	                   {{0, 1, 3}, {1, 4, 3}, {1, 2, 4}, {2, 5, 4}, {2, 0, 5}, {0, 3, 5}},
	                   {{1, 3}, {1, 4}, {2, 4}, {2, 5}, {0, 5}, {0, 3}})},
	    {"nothing behind an edge", meshOf({{0, 1, 2}}, {{0, 1}})},
	    {"turned against each other", meshOf({{0, 1, 2}, {0, 3, 2}}, {{0, 2}})},
	    {"twice the same", meshOf({{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 2, 3}}, {{0, 2}})},
	    {"closed", meshOf({{0, 1, 2}, {0, 2, 1}}, {{0, 1}, {1, 2}, {2, 0}})},
	    {"a vertex twice", meshOf({{0, 1, 2}, {0, 2, 3}, {3, 2, 1}}, {{0, 2}, {2, 3}})}};
	for (const auto& [name, mesh] : cases) {
		SCOPED_TRACE(name);
		expectTriangles(mesh, tool::polygonsOf(mesh, alike));
	}
}

TEST(Polygons, WithDifferentCornersAtAVertexStayTriangles)
{
	const MeshData m = meshOf({{0, 1, 2}, {0, 2, 3}}, {{0, 2}});
	expectTriangles(m, tool::polygonsOf(m, [](std::uint32_t, std::uint32_t) { return false; }));
}

} // namespace
} // namespace wavemesh::test
