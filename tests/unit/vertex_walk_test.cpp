// SPDX-License-Identifier: GPL-3.0-or-later
// The order in which the vertices of a level are coded.
#include "multires/vertex_walk.h"
#include "stage_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace wavemesh::test {
namespace {

/// For each vertex the lowest vertex of its component.
std::vector<Index> componentsOf(const CornerTable& table)
{
	std::vector<Index> root(table.vertexCount);
	std::iota(root.begin(), root.end(), 0);
	for (bool changed = true; changed;) {
		changed = false;
		for (Index c = 0; c < table.cornerCount(); ++c) {
			Index &a = root[table.vertex[c]], &b = root[table.vertex[nextCorner(c)]];
			changed = changed || a != b;
			a = b = std::min(a, b);
		}
	}
	return root;
}

bool isPermutation(std::vector<Index> order)
{
	std::sort(order.begin(), order.end());
	for (Index v = 0; v < order.size(); ++v)
		if (order[v] != v)
			return false;
	return true;
}

class EveryFamilysWalk : public testing::TestWithParam<NamedMesh>
{
};

TEST_P(EveryFamilysWalk, VisitsEveryVertexOnceComponentAfterComponent)
{
	const CornerTable table = stageMesh(GetParam().mesh).table;
	const auto order        = vertexWalk(table);
	ASSERT_EQ(order.size(), table.vertexCount);
	EXPECT_TRUE(isPermutation(order));
	const auto component = componentsOf(table);
	std::vector<std::uint8_t> over(table.vertexCount, 0);
	for (std::size_t i = 1; i < order.size(); ++i) {
		const Index before = component[order[i - 1]], now = component[order[i]];
		if (before != now)
			over[before] = 1;
		ASSERT_FALSE(over[now]) << "left component " << now << " and came back";
	}
}

TEST_P(EveryFamilysWalk, NextVertexHasAFaceWithTwoThatWereSeen)
{
	const CornerTable table = stageMesh(GetParam().mesh).table;
	const auto order        = vertexWalk(table);
	const auto component    = componentsOf(table);
	std::vector<std::size_t> rank(order.size());
	for (std::size_t i = 0; i < order.size(); ++i)
		rank[order[i]] = i;
	std::vector<std::uint8_t> supported(order.size(), 0);
	for (Index c = 0; c < table.cornerCount(); ++c) {
		const std::size_t own = rank[table.vertex[c]];
		if (rank[table.vertex[nextCorner(c)]] < own && rank[table.vertex[prevCorner(c)]] < own)
			supported[table.vertex[c]] = 1;
	}
	std::size_t inComponent = 0;
	for (std::size_t i = 0; i < order.size(); ++i) {
		inComponent = i > 0 && component[order[i]] == component[order[i - 1]] ? inComponent + 1 : 0;
		if (inComponent >= 2) {
			ASSERT_TRUE(supported[order[i]]) << i;
		}
	}
}

INSTANTIATE_TEST_SUITE_P(
    VertexWalk, EveryFamilysWalk, testing::ValuesIn(allFamilies()), [](const auto& family) {
	    return family.param.name;
    });

TEST(VertexWalk, DependsOnConnectivityAlone)
{
	// Each component starts with the corners of its first face, in their order.
	const CornerTable table = stageMesh(joined({makeTorus(5, 4), makeStrip(4)})).table;
	const auto order        = vertexWalk(table);
	EXPECT_EQ(order[0], table.vertex[0]);
	EXPECT_EQ(order[1], table.vertex[1]);
	EXPECT_EQ(order[2], table.vertex[2]);
}

TEST(VertexWalk, OfNothingIsEmpty)
{
	EXPECT_TRUE(vertexWalk(CornerTable {}).empty());
}

} // namespace
} // namespace wavemesh::test
