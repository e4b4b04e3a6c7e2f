// SPDX-License-Identifier: GPL-3.0-or-later
// Error quadrics, the errors of removals, and what coarsening by them keeps of a shape.
#include "multires/quadrics.h"
#include "multires/removal_error.h"
#include "stage_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace wavemesh::test {
namespace {

/// Area-weighted squared distances of a point to the planes of the faces at a vertex, and to those
/// through its boundary edges: what its quadric is said to be.
double expectedError(const StageMesh& m, Index vertex, const Vector3& x)
{
	double sum        = 0;
	const auto square = [&](const Vector3& normal) {
		return dot(normal, x) * dot(normal, x) / squaredNorm(normal);
	};
	for (Index c = 0; c < m.table.cornerCount(); ++c) {
		const auto at = [&](Index corner) { return m.positions[m.table.vertex[corner]]; };
		const Vector3 normal =
		    cross(difference(at(nextCorner(c)), at(c)), difference(at(prevCorner(c)), at(c)));
		if (squaredNorm(normal) == 0)
			continue;
		if (m.table.vertex[c] == vertex)
			sum += std::sqrt(squaredNorm(normal)) / 6 * square(normal);
		const Index a = m.table.vertex[nextCorner(c)], b = m.table.vertex[prevCorner(c)];
		if (m.table.opposite[c] == kNone && (a == vertex || b == vertex)) {
			const Vector3 edge = difference(m.positions[a], m.positions[b]);
			sum += squaredNorm(edge) / 2 * square(cross(edge, normal));
		}
	}
	return sum;
}

TEST(Quadrics, AreAreaWeightedSquaredDistancesToThePlanesAround)
{
	Rng rng(1);
	for (const MeshData& mesh : {makeBumpySphere(200, 1), makeTerrain(200, 2), makeTriangle()}) {
		const StageMesh m = stageMesh(mesh, 12);
		const Quadrics quadrics(m.table, m.positions);
		for (Index v = 0; v < m.table.vertexCount; v += 1 + v / 8) {
			Vector3 x;
			for (double& k : x)
				k = double(rng.below(400)) - 200;
			const double expected = expectedError(m, v, x);
			EXPECT_NEAR(quadrics.of(v).at(x), expected, 1e-9 * expected) << v;
		}
	}
}

TEST(Quadrics, OfAllLevelsSayTheSameTogether)
{
	// Children hand theirs on to their parents: at any point of space the sum stays.
	for (const MeshData& mesh : {makeBumpySphere(400, 3), makeKleetope(makeIcosphere(4))}) {
		const StageMesh m = stageMesh(mesh, 10);
		Quadrics quadrics(m.table, m.positions);
		std::vector<LatticePoint> points = m.positions;
		const LatticePoint places[]      = {{0, 0, 0}, {500, 400, 300}, {1023, 0, 1023}};
		const auto sums                  = [&] {
            std::array<double, 3> all {};
            for (Index v = 0; v < points.size(); ++v)
                for (std::size_t i = 0; i < 3; ++i)
                    all[i] += quadrics.of(v).at(difference(places[i], points[v]));
            return all;
		};
		const auto before = sums();
		for (const Coarsening& step :
		     coarsenAll(m.table, m.positions, {}, {0, 0.8, 0.6}, [](double) { return true; })) {
			quadrics.carry(step, points);
			points = pickedPositions(points, step.fineVertex);
			for (std::size_t i = 0; i < 3; ++i)
				ASSERT_NEAR(sums()[i], before[i], 1e-6 * before[i]);
		}
	}
}

TEST(Quadrics, FarFromTheOriginTheySayTheSame)
{
	const StageMesh near = stageMesh(makeBumpySphere(300, 4), 10);
	StageMesh far        = near;
	for (LatticePoint& p : far.positions)
		for (std::int32_t& x : p)
			x += 1 << 29;
	const Quadrics a(near.table, near.positions), b(far.table, far.positions);
	for (Index v = 0; v < near.table.vertexCount; ++v)
		EXPECT_EQ(a.of(v).at({3, -4, 5}), b.of(v).at({3, -4, 5}));
}

/// A cube of 6 n^2 squares, cut along either diagonal; `corner[v]`: 0 inside a side, 1 on an edge
/// of the cube, 2 at one of its corners.
struct DividedCube
{
	StageMesh mesh;
	std::vector<int> rank;
};

DividedCube dividedCube(int n)
{
	MeshData m;
	std::vector<std::uint32_t> index(std::size_t((n + 1) * (n + 1) * (n + 1)), kNone);
	const auto vertex = [&](std::array<int, 3> p) {
		auto& i = index[std::size_t((p[0] * (n + 1) + p[1]) * (n + 1) + p[2])];
		if (i == kNone) {
			i = static_cast<std::uint32_t>(m.positions.size());
			m.positions.push_back({double(p[0]), double(p[1]), double(p[2])});
		}
		return i;
	};
	Rng rng(5);
	for (std::size_t axis = 0; axis < 3; ++axis)
		for (int side : {0, n})
			for (int i = 0; i < n; ++i)
				for (int k = 0; k < n; ++k) {
					const auto at = [&](int u, int w) {
						std::array<int, 3> p;
						p[axis]           = side;
						p[(axis + 1) % 3] = u;
						p[(axis + 2) % 3] = w;
						return vertex(p);
					};
					std::uint32_t q[4] = {at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)};
					if (side == 0)
						std::swap(q[1], q[3]);
					if (rng.below(2))
						std::rotate(q, q + 1, q + 4);
					m.triangles.push_back({q[0], q[1], q[2]});
					m.triangles.push_back({q[0], q[2], q[3]});
				}
	DividedCube cube {stageMesh(m, 10), {}};
	for (const auto& p : m.positions) {
		int onSides = -1;
		for (const double x : p)
			onSides += x == 0 || x == n;
		cube.rank.push_back(onSides);
	}
	return cube;
}

TEST(CoarsenByError, KeepsTheCornersAndEdgesOfACubeDownToAThirtiethOfItsVertices)
{
	const DividedCube cube = dividedCube(12);
	const auto steps       = coarsenAll(
	          cube.mesh.table, cube.mesh.positions, {}, {0, 0.8, 0.6}, [](double) { return true; });
	std::vector<int> rank = cube.rank;
	for (const Coarsening& step : steps) {
		if (30 * rank.size() <= cube.rank.size())
			break;
		const CornerTable& coarse = step.coarse;
		for (Index c = 0; c < coarse.cornerCount(); ++c) {
			const Index child = step.childOnEdge[c];
			if (child == kNone)
				continue;
			EXPECT_NE(rank[child], 2) << "a corner is gone";
			if (rank[child] == 1) {
				const Index a = coarse.vertex[nextCorner(c)], b = coarse.vertex[prevCorner(c)];
				EXPECT_GE(rank[step.fineVertex[a]], 1) << "an edge is cut off";
				EXPECT_GE(rank[step.fineVertex[b]], 1) << "an edge is cut off";
			}
		}
		if (testing::Test::HasFailure())
			return;
		std::vector<int> kept;
		for (const Index v : step.fineVertex)
			kept.push_back(rank[v]);
		rank = kept;
	}
	EXPECT_LE(30 * rank.size(), cube.rank.size()) << "the steps removed too little";
}

TEST(CoarsenByError, LeavesTheOutlineOfAFlatGridStraight)
{
	const StageMesh m = stageMesh(makeFlatGrid(17, 13), 10);
	const auto steps =
	    coarsenAll(m.table, m.positions, {}, {0, 0.8, 0.6}, [](double) { return true; });
	std::vector<LatticePoint> points = m.positions;
	for (const Coarsening& step : steps)
		if (points.size() > 24)
			points = pickedPositions(points, step.fineVertex);
	LatticePoint low = m.positions[0], high = low;
	for (const LatticePoint& p : m.positions)
		for (std::size_t k = 0; k < 3; ++k) {
			low[k]  = std::min(low[k], p[k]);
			high[k] = std::max(high[k], p[k]);
		}
	for (const std::int32_t x : {low[0], high[0]})
		for (const std::int32_t y : {low[1], high[1]})
			EXPECT_EQ(std::count(points.begin(), points.end(), LatticePoint {x, y, 0}), 1)
			    << "corner " << x << " " << y;
	EXPECT_LE(points.size(), 24u);
}

TEST(CoarsenByError, RemovesNothingOverTheLimitOfTheStep)
{
	for (const MeshData& mesh :
	     {makeBumpySphere(900, 6), makeTerrain(900, 7), makeStarPrism(12, 10)}) {
		const StageMesh m = stageMesh(mesh, 12);
		const Quadrics quadrics(m.table, m.positions);
		const CoarsenState before(m.table);
		const ErrorCriterion criterion {&quadrics, 0.6};
		const RemovalError error(before, m.positions, criterion);
		const Coarsening step = coarsen(m.table, m.positions, {}, {}, criterion);
		ASSERT_LT(step.fineVertex.size(), m.table.vertexCount);
		for (Index c = 0; c < step.coarse.cornerCount(); ++c)
			if (step.childOnEdge[c] != kNone) {
				const auto kept = [&](Index corner) {
					return step.fineVertex[step.coarse.vertex[corner]];
				};
				EXPECT_TRUE(error.allows(
				    {step.childOnEdge[c], kept(nextCorner(c)), kept(prevCorner(c))}, true));
			}
	}
}

TEST(CoarsenByError, AFreeStepIsInExcessOnPlanesAndEdgesOnly)
{
	const auto excess = [](const MeshData& mesh) {
		const StageMesh m = stageMesh(mesh, 12);
		return excessError(
		    m.table, m.positions, Quadrics(m.table, m.positions),
		    coarsen(m.table, m.positions, {}, {}, {}));
	};
	for (const MeshData& mesh :
	     {makeBumpySphere(2500, 51), makeTerrain(2500, 52), makeCollapsedSphere(2500, 53)}) {
		EXPECT_GE(excess(mesh), 1);
		EXPECT_LT(excess(mesh), 9);
	}
	EXPECT_GT(excess(makeStarPrism(20, 30)), 13);
	EXPECT_GT(excess(makeHoledPlate(3, 20)), 13);
	EXPECT_EQ(excess(makeFlatGrid(30, 30)), 1) << "nothing to lose";
}

TEST(CoarsenByError, RemovesAThirdOfTheVerticesInTheMean)
{
	for (const MeshData& mesh : {makeBumpySphere(2500, 51), makeTerrain(2500, 52)}) {
		const Levels levels = makeLevels(mesh, {}, 12, {0, 0.8, 0.6});
		ASSERT_GE(levels.replay.levels.size(), 6u);
		const auto& sixth = levels.replay.levels[levels.replay.levels.size() - 6].parent;
		EXPECT_GE(std::pow(double(mesh.positions.size()) / sixth.vertexCount, 1.0 / 6), 1.4);
	}
}

} // namespace
} // namespace wavemesh::test
