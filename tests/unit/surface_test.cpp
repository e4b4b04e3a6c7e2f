// SPDX-License-Identifier: GPL-3.0-or-later
// Normals, Laplacians and likely positions of what is known of a surface.
#include "predict/surface.h"
#include "stage_meshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace wavemesh::test {
namespace {

constexpr std::int64_t kUnit = 16384;

TEST(Normalised, HasUnitLengthAndTheSameDirection)
{
	Rng rng(801);
	for (int i = 0; i < 5000; ++i) {
		Vector n;
		for (auto& x : n)
			x = static_cast<std::int64_t>(rng.next()) >> (4 + rng.below(59));
		const UnitVector u = normalised(n);
		if (n == Vector {0, 0, 0}) {
			ASSERT_EQ(u, (UnitVector {0, 0, 0}));
			continue;
		}
		const double size = std::sqrt(
		    double(n[0]) * double(n[0]) + double(n[1]) * double(n[1]) +
		    double(n[2]) * double(n[2]));
		for (std::size_t k = 0; k < 3; ++k)
			ASSERT_NEAR(u[k], kUnit * double(n[k]) / size, 4) << n[0] << ' ' << n[1] << ' ' << n[2];
	}
}

TEST(Normalised, OfTheLargestVectorsIsRight)
{
	constexpr std::int64_t kMost = (std::int64_t(1) << 60) - 1;
	EXPECT_EQ(normalised({0, 0, 0}), (UnitVector {0, 0, 0}));
	EXPECT_NEAR(normalised({kMost, 0, 0})[0], kUnit, 1);
	EXPECT_NEAR(normalised({0, -kMost, 0})[1], -kUnit, 1);
	for (const std::int32_t x : normalised({kMost, kMost, -kMost}))
		EXPECT_NEAR(std::abs(x), kUnit / std::sqrt(3), 2);
	EXPECT_EQ(normalised({0, 0, 1}), (UnitVector {0, 0, kUnit}));
}

TEST(ClampedCross, IsTheCrossProductAndClampsWhatIsLong)
{
	EXPECT_EQ(clampedCross({1, 0, 0}, {0, 1, 0}), (Vector {0, 0, 1}));
	EXPECT_EQ(clampedCross({3, -5, 7}, {2, 11, -13}), (Vector {-12, 53, 43}));
	constexpr std::int64_t kMost = (1 << 20) - 1, kFar = std::int64_t(1) << 40;
	EXPECT_EQ(clampedCross({kFar, 0, 0}, {0, -kFar, 0}), (Vector {0, 0, -kMost * kMost}));
}

TEST(Along, IsTheLengthOverThePlane)
{
	EXPECT_EQ(along({5, 6, 7}, {0, 0, kUnit}), 7);
	EXPECT_EQ(along({5, 6, 7}, {-kUnit, 0, 0}), -5);
	EXPECT_EQ(along({1000, 1000, 0}, normalised({1, 1, 0})), 1414);
}

StageMesh sixteenths(const MeshData& mesh, int bits)
{
	StageMesh out = stageMesh(mesh, bits);
	for (auto& p : out.positions)
		for (auto& x : p)
			x *= 16;
	return out;
}

TEST(VertexNormals, OfAPlaneAreUpright)
{
	const StageMesh flat = sixteenths(makeFlatGrid(7, 6), 10);
	for (const UnitVector& n : vertexNormals(flat.table, flat.positions))
		EXPECT_EQ(n, (UnitVector {0, 0, kUnit}));
}

TEST(VertexNormals, OfASpherePointAwayFromItsMiddle)
{
	const MeshData sphere = makeIcosphere(6);
	const StageMesh fine  = sixteenths(sphere, 12);
	const auto normals    = vertexNormals(fine.table, fine.positions);
	for (std::size_t v = 0; v < normals.size(); ++v) {
		double cosine = 0;
		for (std::size_t k = 0; k < 3; ++k)
			cosine += double(normals[v][k]) / kUnit * sphere.positions[v][k];
		EXPECT_GT(cosine, 0.99) << v;
	}
}

TEST(VertexNormals, OfACubePointAlongItsDiagonals)
{
	const StageMesh cube = sixteenths(makeCube(), 8);
	const auto normals   = vertexNormals(cube.table, cube.positions);
	for (std::size_t v = 0; v < normals.size(); ++v)
		for (std::size_t k = 0; k < 3; ++k) {
			EXPECT_EQ(normals[v][k] > 0, cube.positions[v][k] > 0) << v;
			EXPECT_GT(std::abs(normals[v][k]), kUnit / 4) << v;
		}
}

TEST(VertexNormals, OfCollapsedFacesAreZero)
{
	StageMesh mesh = stageMesh(makeIcosphere(2));
	for (auto& p : mesh.positions)
		p = {7, 7, 7};
	for (const UnitVector& n : vertexNormals(mesh.table, mesh.positions))
		EXPECT_EQ(n, (UnitVector {0, 0, 0}));
}

TEST(Laplacians, OfAPlaneLieInIt)
{
	const StageMesh flat = sixteenths(makeFlatGrid(9, 7), 10);
	for (const LatticePoint& l : laplacians(flat.table, flat.positions))
		EXPECT_EQ(l[2], 0);
	// And in any other plane, up to rounding: x + 2 y + 3 z stays what it is.
	StageMesh tilted = flat;
	for (auto& p : tilted.positions)
		p = {3 * p[1], 3 * p[0], -p[1] - 2 * p[0]};
	for (const LatticePoint& l : laplacians(tilted.table, tilted.positions))
		EXPECT_LE(std::abs(l[0] + 2 * l[1] + 3 * l[2]), 6);
}

TEST(Laplacians, OfARegularVertexAreZeroAndOfATipPointBack)
{
	const MeshData fan = makeFan(8);
	StageMesh mesh     = sixteenths(fan, 10);
	const auto rows    = laplacians(mesh.table, mesh.positions);
	std::size_t middle = 0; // the vertex of all faces
	for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
		std::size_t faces = 0;
		for (const Index u : mesh.table.vertex)
			faces += u == v;
		if (faces == 8)
			middle = v;
	}
	auto flat = mesh.positions;
	for (auto& p : flat)
		p[2] = 0;
	const LatticePoint own = laplacians(mesh.table, flat)[middle];
	for (const std::int32_t x : own)
		EXPECT_LE(std::abs(x), 8);
	flat[middle][2] += 1600;
	EXPECT_EQ(laplacians(mesh.table, flat)[middle][2], -1600);
	EXPECT_EQ(rows.size(), mesh.positions.size());
}

TEST(MiddleOfCell, IsTheMeanOfItsParts)
{
	EXPECT_EQ(middleOfCell({3, 0, 5}, 0), (LatticePoint {48, 0, 80}));
	EXPECT_EQ(middleOfCell({3, 0, 5}, 1), (LatticePoint {96 + 8, 8, 160 + 8}));
	for (int bits = 0; bits <= 10; ++bits) {
		std::int64_t sum = 0;
		for (int i = 0; i < 1 << bits; ++i)
			sum += 16 * (std::int64_t(9) * (1 << bits) + i);
		EXPECT_EQ(middleOfCell({9, 9, 9}, bits)[1], sum / (1 << bits));
	}
}

/// Cells of 2^bits lattice units.
std::vector<LatticePoint> cellsOf(const std::vector<LatticePoint>& positions, int bits)
{
	std::vector<LatticePoint> cells = positions;
	for (auto& p : cells)
		for (auto& x : p)
			x >>= bits;
	return cells;
}

TEST(LikelyPositions, AreInsideTheirCellsForEveryMeshAndPrecision)
{
	for (const auto& family : allFamilies()) {
		const StageMesh mesh = stageMesh(family.mesh, 24);
		for (const int bits : {0, 1, 2, 8, 16, 23, 24}) {
			const auto cells  = cellsOf(mesh.positions, bits);
			const auto likely = likelyPositions(mesh.table, cells, bits, {});
			ASSERT_EQ(likely.size(), cells.size());
			for (std::size_t v = 0; v < cells.size(); ++v)
				for (std::size_t k = 0; k < 3; ++k) {
					const std::int64_t low  = (std::int64_t(cells[v][k]) << bits) * 16;
					const std::int64_t high = low + ((std::int64_t(1) << bits) - 1) * 16;
					ASSERT_GE(likely[v][k], low) << family.name << ' ' << bits;
					ASSERT_LE(likely[v][k], high) << family.name << ' ' << bits;
				}
		}
	}
}

TEST(LikelyPositions, OfWholeBitsAreThePositions)
{
	const StageMesh mesh = stageMesh(makeBumpySphere(200, 2), 12);
	const auto likely    = likelyPositions(mesh.table, mesh.positions, 0, {});
	for (std::size_t v = 0; v < likely.size(); ++v)
		for (std::size_t k = 0; k < 3; ++k)
			ASSERT_EQ(likely[v][k], 16 * mesh.positions[v][k]);
}

double
squaredErrorOf(const std::vector<LatticePoint>& guess, const std::vector<LatticePoint>& truth)
{
	double sum = 0;
	for (std::size_t v = 0; v < truth.size(); ++v)
		for (std::size_t k = 0; k < 3; ++k)
			sum += std::pow(guess[v][k] / 16.0 - truth[v][k], 2);
	return sum;
}

TEST(LikelyPositions, OfASmoothSurfaceAreCloserThanTheMiddles)
{
	const StageMesh mesh = stageMesh(makeIcosphere(14), 12);
	const auto cells     = cellsOf(mesh.positions, 7);
	std::vector<LatticePoint> middles;
	for (const auto& c : cells)
		middles.push_back(middleOfCell(c, 7));
	const auto likely = likelyPositions(mesh.table, cells, 7, {});
	EXPECT_LT(
	    squaredErrorOf(likely, mesh.positions), 0.9 * squaredErrorOf(middles, mesh.positions));
}

TEST(LikelyPositions, OfGluedVerticesAreTheMiddles)
{
	const StageMesh mesh = stageMesh(makeIcosphere(5), 12);
	const auto cells     = cellsOf(mesh.positions, 6);
	std::vector<Index> group(mesh.table.vertexCount, kNone);
	for (const std::size_t v : {3u, 10u, 11u})
		group[v] = 0;
	group[20]         = 1; // alone: moved like any other
	const Glue glue   = glueOf(group);
	const auto loose  = likelyPositions(mesh.table, cells, 6, {});
	const auto likely = likelyPositions(mesh.table, cells, 6, glue);
	for (std::size_t v = 0; v < cells.size(); ++v) {
		const bool glued = v == 3 || v == 10 || v == 11;
		EXPECT_EQ(likely[v], glued ? middleOfCell(cells[v], 6) : loose[v]) << v;
	}
}

} // namespace
} // namespace wavemesh::test
