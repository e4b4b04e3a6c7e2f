// SPDX-License-Identifier: GPL-3.0-or-later
// Where levels are shown: nearer to the surface than the middles of cells, and than a mesh through
// points of it.
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
	std::vector<LatticePoint> truth, cells;
	int shift, bits;

	std::vector<LatticePoint> middles() const { return middlesOfCells(cells, shift); }
	std::vector<LatticePoint> likely() const { return likelyPositions(table, cells, shift, {}); }
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
	    {},
	    bits - precision,
	    bits};
	for (std::size_t v = 0; v < level.table.vertexCount; ++v) {
		LatticePoint p = levels.positions[v];
		level.truth.push_back(p);
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

/// Sum of squared distances of the vertices from where they are in truth.
double offTheTruth(const Level& level, const std::vector<LatticePoint>& positions)
{
	double sum = 0;
	for (std::size_t v = 0; v < positions.size(); ++v)
		for (std::size_t k = 0; k < 3; ++k)
			sum += std::pow(positions[v][k] - 16.0 * level.truth[v][k], 2);
	return sum;
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

TEST(ShownPositions, OfALevelWithAllVerticesAreSmootherThanItsCells)
{
	for (const int bits : {10, 12, 16, 20, 24}) {
		Level level = levelOf(makeIcosphere(32), 1, bits, 6);
		level.parents.clear();
		const double middles = offTheSphere(level.table, level.middles(), bits);
		EXPECT_LT(offTheSphere(level.table, level.shown(), bits), 0.3 * middles) << bits;
		EXPECT_LT(
		    offTheSphere(level.table, level.shown(), bits),
		    0.7 * offTheSphere(level.table, level.likely(), bits))
		    << bits;
	}
}

TEST(ShownPositions, OfPlanesAndEdgesAreNotFartherFromTheTruthThanTheirCells)
{
	for (const MeshData& mesh : {makeFlatGrid(30, 30), makeHoledPlate(2, 12)})
		for (const int precision : {8, 11})
			for (const bool all : {false, true}) {
				Level level = levelOf(mesh, 1, 12, precision);
				if (all)
					level.parents.clear();
				EXPECT_LE(
				    offTheTruth(level, level.shown()), 1.001 * offTheTruth(level, level.middles()))
				    << precision << ' ' << all;
			}
}

TEST(ShownPositions, OfGluedVerticesAreTheMiddlesOfTheirCells)
{
	Level level = levelOf(makeIcosphere(16), 1);
	std::vector<Index> group(level.table.vertexCount, kNone);
	for (const std::size_t v : {3u, 10u, 11u})
		group[v] = 0;
	const Glue glue    = glueOf(group);
	const auto middles = level.middles();
	for (const bool all : {false, true}) {
		if (all)
			level.parents.clear();
		const auto shown  = level.shown(glue);
		std::size_t moved = 0;
		for (std::size_t v = 0; v < shown.size(); ++v) {
			if (group[v] == 0) {
				EXPECT_EQ(shown[v], middles[v]) << v;
			}
			moved += shown[v] != middles[v];
		}
		EXPECT_GT(moved, shown.size() / 2);
	}
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
