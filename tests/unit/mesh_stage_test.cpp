// SPDX-License-Identifier: GPL-3.0-or-later
// Quantisation, corner table and shared integer arithmetic.
#include "mesh/integer_math.h"
#include "mesh/quantization.h"
#include "mesh_families.h"
#include "rng.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

namespace wavemesh::test {
namespace {

using Positions = std::vector<std::array<double, 3>>;

constexpr double kNaN      = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Quantise, GivesTheNearestPointOfTheLattice)
{
	for (int bits : {1, 2, 8, 12, 20, 24}) {
		const Positions positions = jittered(makeBumpySphere(200, 5), 0.3, 6).positions;
		const auto lattice        = makeLattice(positions, bits, 0);
		ASSERT_TRUE(lattice.ok());
		EXPECT_EQ(lattice->bits, bits);
		const auto points    = quantise(positions, *lattice);
		std::int32_t largest = 0;
		for (std::size_t v = 0; v < points.size(); ++v)
			for (std::size_t k = 0; k < 3; ++k) {
				ASSERT_GE(points[v][k], 0);
				ASSERT_LT(points[v][k], 1 << bits);
				largest = std::max(largest, points[v][k]);
				ASSERT_LE(
				    std::abs(lattice->position(points[v])[k] - positions[v][k]),
				    0.5 * lattice->step * (1 + 1e-9));
			}
		EXPECT_EQ(largest, (1 << bits) - 1) << "the largest extent takes the whole range";
	}
}

TEST(Quantise, IsIdempotent)
{
	const Positions positions = makeTerrain(200, 7).positions;
	const auto lattice        = makeLattice(positions, 12, 0);
	const auto points         = quantise(positions, *lattice);
	Positions snapped;
	for (const LatticePoint& p : points)
		snapped.push_back(lattice->position(p));
	EXPECT_EQ(quantise(snapped, *lattice), points);
}

TEST(Quantise, FarFromTheOriginAndTinyAndHuge)
{
	for (const double scale : {1e-300, 1e-30, 1.0, 1e30, 1e300})
		for (const double offset : {0.0, 1.0, 1e6}) {
			Positions positions;
			for (int i = 0; i <= 16; ++i)
				positions.push_back({(offset + i) * scale, offset * scale, (offset - i) * scale});
			const auto lattice = makeLattice(positions, 4, 0);
			ASSERT_TRUE(lattice.ok()) << scale << ' ' << lattice.status().what;
			const auto points = quantise(positions, *lattice);
			EXPECT_EQ(points.front()[0], 0) << scale << ' ' << offset;
			EXPECT_EQ(points.back()[0], 15) << scale << ' ' << offset;
		}
}

TEST(Quantise, AmongTheDenormals_KeepsEveryPointWithinHalfAStep)
{
	const double unit = std::numeric_limits<double>::denorm_min();
	for (const double extent : {1.0, 7.0, 2047.0, 4095.0, 4097.0, 6141.0, 6143.0, 530060.0, 1e9}) {
		const Positions positions {
		    {0, 0, 0}, {extent * unit, 0, 0}, {0, std::floor(extent / 3) * unit, 0}};
		const auto lattice = makeLattice(positions, 12, 0);
		ASSERT_TRUE(lattice.ok());
		const auto points = quantise(positions, *lattice);
		for (std::size_t v = 0; v < points.size(); ++v)
			for (std::size_t k = 0; k < 3; ++k)
				EXPECT_LE(
				    std::abs(lattice->position(points[v])[k] - positions[v][k]) / unit,
				    0.5 * lattice->step / unit)
				    << extent;
	}
}

TEST(MakeLattice, OfOnePoint_HasAPositiveStep)
{
	const auto lattice = makeLattice({{1, 2, 3}, {1, 2, 3}}, 12, 0);
	ASSERT_TRUE(lattice.ok());
	EXPECT_GT(lattice->step, 0);
	EXPECT_EQ(
	    lattice->position(quantise({{1, 2, 3}}, *lattice)[0]), (std::array<double, 3> {1, 2, 3}));
}

TEST(MakeLattice, KeepsAStepInModelUnitsAndCountsItsBits)
{
	const Positions positions {{0, 0, 0}, {10, 1, 2}};
	const std::pair<double, int> cases[] = {{10, 1}, {5, 2}, {1, 4}, {0.01, 10}, {1e-6, 24}};
	for (const auto& [step, bits] : cases) {
		const auto lattice = makeLattice(positions, 12, step);
		ASSERT_TRUE(lattice.ok()) << step;
		EXPECT_EQ(lattice->step, step);
		EXPECT_EQ(lattice->bits, bits) << step;
	}
}

TEST(MakeLattice, RefusesWhatIsOutOfRange)
{
	const Positions good {{0, 0, 0}, {1, 1, 1}};
	const auto code = [](const Positions& p, int bits, double step) {
		return makeLattice(p, bits, step).status().code;
	};
	for (const int bits : {0, -1, 25, 1000})
		EXPECT_EQ(code(good, bits, 0), StatusCode::InvalidArgument) << bits;
	for (const double step : {-1.0, kNaN, kInfinity, 1.0 / (1 << 24), 1e-300})
		EXPECT_EQ(code(good, 12, step), StatusCode::InvalidArgument) << step;
	EXPECT_EQ(code(good, 12, 1.0 / ((1 << 24) - 1)), StatusCode::Ok);
	for (const double x : {kNaN, kInfinity, -kInfinity})
		for (std::size_t k = 0; k < 3; ++k) {
			Positions bad = good;
			bad[1][k]     = x;
			EXPECT_EQ(code(bad, 12, 0), StatusCode::InvalidArgument);
			EXPECT_NE(makeLattice(bad, 12, 0).status().what.find("vertex 1"), std::string::npos);
		}
	EXPECT_EQ(code({{-1.7e308, 0, 0}, {1.7e308, 0, 0}}, 12, 0), StatusCode::InvalidArgument);
}

TEST(CornerTable, OfEveryFamily_IsConsistent)
{
	for (const NamedMesh& m : allFamilies()) {
		const auto t =
		    buildCornerTable(m.mesh.triangles, static_cast<Index>(m.mesh.positions.size()));
		ASSERT_TRUE(t.ok()) << m.name << ": " << t.status().what;
		std::map<std::pair<Index, Index>, Index> facing; // directed edge -> corner that faces it
		for (Index c = 0; c < t->cornerCount(); ++c) {
			ASSERT_EQ(t->vertex[c], m.mesh.triangles[c / 3][c % 3]);
			facing[{t->vertex[nextCorner(c)], t->vertex[prevCorner(c)]}] = c;
		}
		for (const auto& [edge, c] : facing) {
			const auto across = facing.find({edge.second, edge.first});
			ASSERT_EQ(t->opposite[c], across == facing.end() ? kNone : across->second) << m.name;
		}
	}
}

TEST(CornerTable, FansAndValences_AreThoseOfTheEdges)
{
	for (const NamedMesh& m : allFamilies()) {
		const auto t =
		    buildCornerTable(m.mesh.triangles, static_cast<Index>(m.mesh.positions.size()));
		std::vector<std::map<Index, int>> neighbours(t->vertexCount);
		std::vector<Index> faces(t->vertexCount, 0);
		for (const auto& f : m.mesh.triangles)
			for (std::size_t k = 0; k < 3; ++k) {
				++faces[f[k]];
				neighbours[f[k]][f[(k + 1) % 3]] = neighbours[f[k]][f[(k + 2) % 3]] = 1;
			}
		const auto valence = valences(*t), first = firstCorners(*t);
		for (Index v = 0; v < t->vertexCount; ++v) {
			ASSERT_EQ(valence[v], neighbours[v].size()) << m.name;
			Index seen = 0, c = first[v];
			do {
				ASSERT_EQ(t->vertex[c], v);
				++seen;
				c = t->swingLeft(c);
			} while (c != kNone && c != first[v]);
			ASSERT_EQ(seen, faces[v]) << m.name;
		}
	}
}

void expectRefused(
    const std::vector<std::array<std::uint32_t, 3>>& triangles,
    Index vertices,
    StatusCode code,
    const std::string& named)
{
	const auto t = buildCornerTable(triangles, vertices);
	EXPECT_EQ(t.status().code, code) << named;
	EXPECT_NE(t.status().what.find(named), std::string::npos) << t.status().what;
}

TEST(CornerTable, RefusesAndNamesWhatIsWrong)
{
	expectRefused({{0, 1, 5}}, 3, StatusCode::InvalidArgument, "vertex 5");
	expectRefused({{0, 1, 1}}, 2, StatusCode::Unsupported, "face 0");
	expectRefused({{0, 1, 2}}, 4, StatusCode::Unsupported, "vertex 3");
	// Two faces run along 0-1 in the same direction.
	expectRefused({{0, 1, 2}, {0, 1, 3}}, 4, StatusCode::Unsupported, "edge 0-1");
	// Three faces at the edge 0-1.
	expectRefused({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, 5, StatusCode::Unsupported, "edge 0-1");
	// The same face twice.
	expectRefused({{0, 1, 2}, {1, 2, 0}}, 3, StatusCode::Unsupported, "edge");
	// Two fans at vertex 0.
	expectRefused({{0, 1, 2}, {0, 3, 4}}, 5, StatusCode::Unsupported, "vertex 0");
	expectRefused(
	    {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}}, 7,
	    StatusCode::Unsupported, "vertex 0");
}

TEST(CheckCounts, RefusesMoreThanTheFormatHoldsAndSaysWhatToDo)
{
	constexpr std::size_t kMost = 715'827'882; // docs/wmc_format.md
	EXPECT_TRUE(checkCounts(0, 0).ok());
	EXPECT_TRUE(checkCounts(kMost, kMost).ok());
	EXPECT_EQ(checkCounts(kMost + 1, 0).code, StatusCode::LimitExceeded);
	EXPECT_EQ(
	    checkCounts(kMost + 1, 5).what,
	    "the mesh has 715827883 vertices, more than the 715827882 that a .wmc can hold: split it");
	EXPECT_EQ(
	    checkCounts(5, std::size_t(1) << 40).what,
	    "the mesh has 1099511627776 faces, more than the 715827882 that a .wmc can hold: split it");
}

TEST(CornerTable, TwoTetrahedraJoinedAtAVertex_AreRefused)
{
	MeshData m = joined({makeTetrahedron(), makeTetrahedron()});
	for (auto& t : m.triangles)
		for (auto& v : t)
			v = v == 4 ? 0 : v > 4 ? v - 1 : v;
	expectRefused(m.triangles, 7, StatusCode::Unsupported, "vertex 0");
}

TEST(IntegerMath, Log2Quarters_IsMonotoneAndCloseToTheLogarithm)
{
	EXPECT_EQ(log2Quarters(0), 0);
	int before = 0;
	for (std::uint64_t x = 1; x < (std::uint64_t {1} << 62); x += 1 + x / 50) {
		const int q = log2Quarters(x);
		EXPECT_GE(q, before);
		EXPECT_NEAR(q, 4 * std::log2(static_cast<double>(x)), 1.35) << x;
		before = q;
	}
}

TEST(IntegerMath, Extremes_DoNotOverflow)
{
	constexpr std::int32_t kLow  = std::numeric_limits<std::int32_t>::min(),
	                       kHigh = std::numeric_limits<std::int32_t>::max();
	EXPECT_EQ(wrappingAdd(kHigh, 1), kLow);
	EXPECT_EQ(wrappingSubtract(kLow, 1), kHigh);
	EXPECT_EQ(wrappingAdd(wrappingSubtract(kLow, kHigh), kHigh), kLow);
	EXPECT_EQ(
	    squaredDistance({kLow, kLow, kLow}, {kHigh, kHigh, kHigh}),
	    3 * std::uint64_t {0x7fffffff} * 0x7fffffff);
	EXPECT_EQ(squaredDistance({3, 0, 0}, {0, -4, 12}), 169u);
}

} // namespace
} // namespace wavemesh::test
