// SPDX-License-Identifier: GPL-3.0-or-later
// The equaliser: what stays, what goes, and what it does to noise.
#include "mesh_families.h"
#include "rng.h"

#include <wavemesh/detail_pyramid.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace wavemesh::test {
namespace {

DetailPyramid pyramidOf(const MeshData& mesh)
{
	auto pyramid = DetailPyramid::of(mesh);
	EXPECT_TRUE(pyramid.ok()) << pyramid.status().what;
	return *pyramid;
}

Equaliser gains(const DetailPyramid& pyramid, double gain)
{
	Equaliser equaliser;
	equaliser.gains.assign(std::size_t(pyramid.finestLevel()) + 1, gain);
	return equaliser;
}

double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b)
{
	double most = 0;
	for (std::size_t v = 0; v < a.size(); ++v)
		for (std::size_t k = 0; k < 3; ++k)
			most = std::max(most, std::fabs(a[v][k] - b[v][k]));
	return most;
}

/// Root mean square distance of the vertices from the unit sphere.
double roughness(const std::vector<Vec3>& positions)
{
	double sum = 0;
	for (const Vec3& p : positions)
		sum += std::pow(std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - 1, 2);
	return std::sqrt(sum / double(positions.size()));
}

MeshData noisySphere(double amount)
{
	MeshData mesh = makeIcosphere(20);
	Rng rng(7);
	for (Vec3& p : mesh.positions) {
		const double radius = 1 + rng.between(-amount, amount);
		for (double& x : p)
			x *= radius;
	}
	return mesh;
}

} // namespace

TEST(DetailPyramid, GainsOfOneGiveThePositionsBackBitForBit)
{
	for (NamedMesh m : allFamilies()) {
		SCOPED_TRACE(m.name);
		for (Vec3& p : m.mesh.positions)
			for (double& x : p)
				x = x == 0 ? -0.0 : x / 3; // not exact in binary, and both zeros
		const DetailPyramid pyramid = pyramidOf(m.mesh);
		for (const bool normalOnly : {false, true}) {
			Equaliser same  = gains(pyramid, 1);
			same.normalOnly = normalOnly;
			const auto out  = pyramid.equalise(same);
			ASSERT_EQ(out.size(), m.mesh.positions.size());
			EXPECT_EQ(
			    std::memcmp(out.data(), m.mesh.positions.data(), out.size() * sizeof(Vec3)), 0);
		}
	}
}

TEST(DetailPyramid, ChangesAreProportionalToGainsAndFinite)
{
	for (const NamedMesh& m : allFamilies()) {
		SCOPED_TRACE(m.name);
		const DetailPyramid pyramid = pyramidOf(m.mesh);
		const auto twice            = pyramid.equalise(gains(pyramid, 2));
		const auto none             = pyramid.equalise(gains(pyramid, 0));
		double most                 = 0;
		for (std::size_t v = 0; v < twice.size(); ++v)
			for (std::size_t k = 0; k < 3; ++k) {
				ASSERT_TRUE(std::isfinite(twice[v][k]));
				most = std::max(
				    most, std::fabs(twice[v][k] + none[v][k] - 2 * m.mesh.positions[v][k]));
			}
		const std::vector<Vec3> zeros(twice.size(), {0, 0, 0});
		EXPECT_LE(most, 1e-9 * farthest(m.mesh.positions, zeros));
	}
}

TEST(DetailPyramid, AFlatMeshStaysFlatAndInPlace)
{
	MeshData mesh = makeFlatGrid(25, 25);
	Rng rng(3);
	for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
		const std::size_t x = i % 25, y = i / 25;
		if (x > 0 && x < 24 && y > 0 && y < 24) // vertices spread unevenly, the boundary kept
			for (std::size_t k = 0; k < 2; ++k)
				mesh.positions[i][k] +=
				    rng.between(-0.2, 0.2) * std::fabs(mesh.positions[1][0] - mesh.positions[0][0]);
	}
	const DetailPyramid pyramid = pyramidOf(mesh);
	Equaliser finest            = gains(pyramid, 1);
	finest.gains.back()         = 0;
	const auto out              = pyramid.equalise(finest);
	const double spacing        = std::fabs(mesh.positions[1][0] - mesh.positions[0][0]);
	for (std::size_t i = 0; i < out.size(); ++i) {
		EXPECT_EQ(out[i][2], 0);
		const std::size_t x = i % 25, y = i / 25;
		if (x > 3 && x < 21 && y > 3 && y < 21) { // corners of the boundary get rounder
			EXPECT_NEAR(out[i][0], mesh.positions[i][0], 0.05 * spacing);
			EXPECT_NEAR(out[i][1], mesh.positions[i][1], 0.05 * spacing);
		}
	}
}

TEST(DetailPyramid, WithoutItsFinestDetailsANoisySphereIsSmoother)
{
	const MeshData mesh         = noisySphere(0.02);
	const DetailPyramid pyramid = pyramidOf(mesh);
	Equaliser smooth            = gains(pyramid, 1);
	smooth.gains.back()         = 0;
	EXPECT_LT(roughness(pyramid.equalise(smooth)), 0.8 * roughness(mesh.positions));
	Equaliser strong    = gains(pyramid, 1);
	strong.gains.back() = 2;
	EXPECT_GT(roughness(pyramid.equalise(strong)), 1.2 * roughness(mesh.positions));
}

TEST(DetailPyramid, TheThresholdTakesNoiseOffASphere)
{
	const MeshData mesh         = noisySphere(0.02);
	const DetailPyramid pyramid = pyramidOf(mesh);
	Equaliser denoise;
	denoise.threshold       = 0.03;
	denoise.thresholdLevels = 2;
	EXPECT_LT(roughness(pyramid.equalise(denoise)), 0.7 * roughness(mesh.positions));
	denoise.threshold = 1e-9;
	EXPECT_NEAR(roughness(pyramid.equalise(denoise)), roughness(mesh.positions), 1e-6);
}

TEST(DetailPyramid, RefusesWhatTheEncoderRefuses)
{
	EXPECT_EQ(DetailPyramid::of({}).status().code, StatusCode::Unsupported);
	MultiresolutionOptions stop;
	stop.progress = [](double) { return false; };
	EXPECT_EQ(
	    DetailPyramid::of(makeBumpySphere(300, 1), stop).status().code, StatusCode::Cancelled);
}

} // namespace wavemesh::test
