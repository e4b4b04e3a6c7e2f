// SPDX-License-Identifier: GPL-3.0-or-later
#include <metrics/surface_distance.h>

#include "mesh_families.h"
#include "rng.h"
#include <metrics/closest_point.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wavemesh::test {

TEST(SurfaceDistance, IsZeroToItself)
{
	for (const MeshData& mesh : {makeBumpySphere(500, 1), makeTerrain(300, 1), makeTriangle()}) {
		const metrics::DistanceMeter meter(mesh, 2000);
		const auto d = meter.measure(mesh);
		EXPECT_LT(d.max, 1e-12);
		EXPECT_LE(d.rms, d.max);
	}
}

TEST(SurfaceDistance, OfTwoParallelPlanesIsTheirDistance)
{
	const MeshData plane = makeFlatGrid(12, 9);
	const metrics::DistanceMeter meter(plane, 3000);
	const auto d = meter.measure(moved(makeFlatGrid(12, 9), 0, 0, 0.25));
	EXPECT_NEAR(d.rms, 0.25, 1e-12);
	EXPECT_NEAR(d.max, 0.25, 1e-12);
}

TEST(SurfaceDistance, LooksBothWays)
{
	// All of the small one lies in the large one, whose far corner is 3 away from it.
	MeshData small = makeTwoTriangles(), large = small;
	small.positions = large.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
	large.positions[2][0] = large.positions[3][0] = 4;
	for (auto pair : {std::pair(small, large), std::pair(large, small)}) {
		const metrics::DistanceMeter meter(pair.first, 200000);
		const auto d = meter.measure(pair.second);
		EXPECT_NEAR(d.max, 3, 1e-9);
		// Over the unit square 0, over three more x^2: sqrt((27 / 3) / 4).
		EXPECT_NEAR(d.rms, 1.5, 0.01);
	}
}

TEST(SurfaceDistance, OfTwoSpheresIsTheDifferenceOfTheirRadii)
{
	const MeshData sphere = makeIcosphere(20);
	const metrics::DistanceMeter meter(sphere, 20000);
	EXPECT_NEAR(meter.measure(scaled(sphere, 1.1, 1.1, 1.1)).rms, 0.1, 0.002);
	EXPECT_NEAR(meter.diagonal(), 2 * std::sqrt(3.0), 0.05);
}

TEST(ClosestPoint, IsTheNearestOfAllFaces)
{
	Rng rng(1);
	for (const MeshData& mesh :
	     {makeBumpySphere(300, 1), makeTerrain(200, 1), makeTetrahedron(), makeTriangle(),
	      scaled(makeIcosphere(3), 1, 0, 0)}) {
		const metrics::ClosestPoint closest(mesh);
		for (int i = 0; i < 500; ++i) {
			const metrics::Vec3 p = {rng.between(-2, 2), rng.between(-2, 2), rng.between(-2, 2)};
			double best           = 1e300;
			for (const auto& t : mesh.triangles)
				best = std::min(
				    best, metrics::squaredDistance(
				              p, mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]));
			EXPECT_EQ(closest.distance(p), std::sqrt(best));
		}
	}
}

TEST(ClosestPoint, OfATriangleIsItsInsideAnEdgeOrACorner)
{
	const metrics::Vec3 a = {0, 0, 0}, b = {4, 0, 0}, c = {0, 4, 0};
	EXPECT_DOUBLE_EQ(metrics::squaredDistance({1, 1, 3}, a, b, c), 9);
	EXPECT_DOUBLE_EQ(metrics::squaredDistance({1, 1, -3}, a, b, c), 9);
	EXPECT_DOUBLE_EQ(metrics::squaredDistance({1, -2, 0}, a, b, c), 4);
	EXPECT_DOUBLE_EQ(metrics::squaredDistance({-3, -4, 0}, a, b, c), 25);
	EXPECT_DOUBLE_EQ(metrics::squaredDistance({4, 4, 0}, a, b, c), 8);
	EXPECT_DOUBLE_EQ(metrics::squaredDistance({7, 0, 4}, a, b, c), 25);
	EXPECT_DOUBLE_EQ(metrics::squaredDistance({2, 0, 3}, a, b, b), 9);
	EXPECT_DOUBLE_EQ(metrics::squaredDistance({3, 4, 0}, a, a, a), 25);
}

TEST(SurfaceDistance, TakesMeshesWithoutArea)
{
	const MeshData point = scaled(makeIcosphere(2), 0, 0, 0);
	const metrics::DistanceMeter meter(makeIcosphere(4), 1000);
	EXPECT_NEAR(meter.measure(point).max, 1, 0.1);
	const metrics::DistanceMeter none(point, 1000);
	EXPECT_EQ(none.measure(point).max, 0);
	EXPECT_EQ(none.diagonal(), 1);
}

} // namespace wavemesh::test
