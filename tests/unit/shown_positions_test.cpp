// SPDX-License-Identifier: GPL-3.0-or-later
// Where levels below the finest are shown: nearer to the surface than a mesh through its points.
#include "predict/shown_positions.h"
#include "stage_meshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace wavemesh::test {
namespace {

struct Level
{
	CornerTable table;
	Parents parents;
	std::vector<LatticePoint> cells;
	int shift, bits;

	std::vector<LatticePoint> likely(const Glue& glue = {}) const
	{
		return likelyPositions(table, cells, shift, glue);
	}
	std::vector<LatticePoint> shown(const Glue& glue = {}) const
	{
		return shownPositions(table, parents, cells, shift, bits, glue);
	}
};

/// Of a mesh, the level that is so many splits below the finest; extents are 2^precision cells.
Level levelOf(const MeshData& mesh, std::size_t below, int bits = 12, int precision = 7)
{
	const Levels levels       = makeLevels(mesh, {}, bits);
	const std::size_t i       = levels.replay.levels.size() - below;
	const ReplayedLevel& last = levels.replay.levels[i - 1];
	Level level {
	    levels.replay.levels[i].parent,
	    parentsOf(last.parent, last.refinement),
	    {},
	    bits - precision,
	    bits};
	for (std::size_t v = 0; v < level.table.vertexCount; ++v) {
		LatticePoint p = levels.positions[v];
		for (std::int32_t& x : p)
			x >>= level.shift;
		level.cells.push_back(p);
	}
	return level;
}

/// Mean square, over points spread evenly in each face, of the distance from a sphere.
double offTheSphere(const CornerTable& table, const std::vector<LatticePoint>& positions, int bits)
{
	constexpr int kSteps = 9;
	const double radius  = 8.0 * ((1 << bits) - 1);
	double sum           = 0;
	std::size_t count    = 0;
	for (Index c = 0; c < table.cornerCount(); c += 3)
		for (int i = 0; i < kSteps; ++i)
			for (int j = 0; i + j < kSteps; ++j) {
				const double share[3] = {
				    (i + 1 / 3.0) / kSteps, (j + 1 / 3.0) / kSteps, 1 - (i + j + 2 / 3.0) / kSteps};
				double square = 0;
				for (std::size_t k = 0; k < 3; ++k) {
					double x = -radius;
					for (Index corner = 0; corner < 3; ++corner)
						x += share[corner] * positions[table.vertex[c + corner]][k];
					square += x * x;
				}
				sum += std::pow(std::sqrt(square) / radius - 1, 2);
				++count;
			}
	return sum / double(count);
}

TEST(ShownPositions, OfASphereAreNearerToItThanLikelyOnes)
{
	for (const int bits : {10, 12, 16, 20})
		for (const std::size_t below : {2u, 3u}) {
			const Level level = levelOf(makeIcosphere(32), below, bits, 8);
			EXPECT_LT(
			    offTheSphere(level.table, level.shown(), bits),
			    0.6 * offTheSphere(level.table, level.likely(), bits))
			    << bits << " bits, " << below << " splits below the finest";
		}
}

TEST(ShownPositions, OfPlanesAndEdgesAreTheLikelyOnes)
{
	for (const MeshData& mesh : {makeFlatGrid(30, 30), makeHoledPlate(2, 12)}) {
		const Level level = levelOf(mesh, 1, 12, 11);
		EXPECT_EQ(level.shown(), level.likely());
	}
}

TEST(ShownPositions, OfGluedVerticesAndLevelsWithoutASplitAreTheLikelyOnes)
{
	Level level = levelOf(makeIcosphere(16), 1);
	std::vector<Index> group(level.table.vertexCount, kNone);
	for (const std::size_t v : {3u, 10u, 11u})
		group[v] = 0;
	const Glue glue  = glueOf(group);
	const auto shown = level.shown(glue), likely = level.likely(glue);
	std::size_t moved = 0;
	for (std::size_t v = 0; v < shown.size(); ++v) {
		if (group[v] == 0) {
			EXPECT_EQ(shown[v], middleOfCell(level.cells[v], level.shift)) << v;
		}
		moved += shown[v] != likely[v];
	}
	EXPECT_GT(moved, shown.size() / 2);
	level.parents.clear();
	EXPECT_EQ(level.shown(), level.likely());
}

TEST(ShownPositions, AreInsideTheirCellsHoweverWild)
{
	Rng rng(77);
	for (const int bits : {4, 12, 24})
		for (const int shift : {1, bits - 1}) {
			Level level = levelOf(makeBumpySphere(400, 7), 1, bits, bits - shift);
			for (LatticePoint& p : level.cells)
				for (std::int32_t& x : p)
					x = rng.below(2) == 0 ? 0 : (1 << (bits - shift)) - 1;
			const auto shown = level.shown();
			for (std::size_t v = 0; v < shown.size(); ++v) {
				const LatticePoint middle = middleOfCell(level.cells[v], shift);
				for (std::size_t k = 0; k < 3; ++k)
					ASSERT_LE(std::abs(shown[v][k] - middle[k]), 8 * ((1 << shift) - 1));
			}
		}
}

} // namespace
} // namespace wavemesh::test
