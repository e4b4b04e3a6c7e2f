// SPDX-License-Identifier: GPL-3.0-or-later
// The hierarchy in the mesh's own numbering, and what filters do with it.
#include "mesh_families.h"
#include "rng.h"

#include <wavemesh/multiresolution.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace wavemesh::test {
namespace {

constexpr int kLiftings[] = {kLiftingOff, 0, 2};

Multiresolution levelsOfMesh(const MeshData& mesh, int lifting = 0, Wgc wgc = Wgc::On)
{
	MultiresolutionOptions options;
	options.lifting = lifting;
	options.wgc     = wgc;
	auto levels     = Multiresolution::of(mesh, options);
	EXPECT_TRUE(levels.ok()) << levels.status().what;
	return *levels;
}

double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b)
{
	double most = 0;
	for (std::size_t v = 0; v < a.size(); ++v)
		for (std::size_t k = 0; k < 3; ++k)
			most = std::max(most, std::fabs(a[v][k] - b[v][k]));
	return most;
}

bool sameBits(const std::vector<Vec3>& a, const std::vector<Vec3>& b)
{
	return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

} // namespace

TEST(Multiresolution, HasTheLevelsThatTheEncoderMakes)
{
	for (const NamedMesh& m : allFamilies())
		for (const Wgc wgc : {Wgc::Off, Wgc::On}) {
			SCOPED_TRACE(m.name);
			EncodeOptions options;
			options.mode       = Mode::Classic; // a level for each split
			options.optimize   = Optimize::Size;
			options.bits       = 20;
			options.wgc        = wgc;
			const auto encoded = encode(m.mesh, options);
			ASSERT_TRUE(encoded.ok());
			const Multiresolution levels = levelsOfMesh(m.mesh, 0, wgc);
			ASSERT_EQ(levels.finestLevel(), encoded->info.finestLevel());
			for (int j = 0; j <= levels.finestLevel(); ++j)
				EXPECT_EQ(levels.vertexCount(j), encoded->info.levels[std::size_t(j)].vertices);
		}
}

TEST(Multiresolution, EveryVertexIsBornOnceAndAfterItsParents)
{
	for (const NamedMesh& m : allFamilies()) {
		SCOPED_TRACE(m.name);
		const Multiresolution levels = levelsOfMesh(m.mesh);
		ASSERT_EQ(levels.vertexCount(), m.mesh.positions.size());
		std::vector<std::size_t> born(std::size_t(levels.finestLevel()) + 1, 0);
		for (std::size_t v = 0; v < levels.vertexCount(); ++v) {
			const int birth = levels.birth()[v];
			++born[std::size_t(birth)];
			const auto& p = levels.parents()[v];
			EXPECT_EQ(birth == 0, p[0] == Multiresolution::kNoParent);
			for (const std::uint32_t parent : p)
				if (parent != Multiresolution::kNoParent) {
					EXPECT_LT(levels.birth()[parent], birth);
				}
		}
		std::size_t sum = 0;
		for (int j = 0; j <= levels.finestLevel(); ++j) {
			sum += born[std::size_t(j)];
			EXPECT_EQ(levels.vertexCount(j), sum);
		}
	}
}

TEST(Multiresolution, SynthesisUndoesAnalysis)
{
	for (const NamedMesh& m : allFamilies())
		for (const int lifting : kLiftings) {
			SCOPED_TRACE(m.name);
			const Multiresolution levels = levelsOfMesh(m.mesh, lifting);
			std::vector<Vec3> values     = m.mesh.positions;
			levels.analyse(values);
			levels.synthesise(values);
			const std::vector<Vec3> zeros(values.size(), {0, 0, 0});
			EXPECT_LT(
			    farthest(values, m.mesh.positions),
			    1e-13 * farthest(m.mesh.positions, zeros) + 1e-300);
		}
}

TEST(Multiresolution, ADetailIsTheDistanceFromTheMiddleOfTheParents)
{
	const MeshData mesh          = shuffled(makeTerrain(300, 5), 6);
	const Multiresolution levels = levelsOfMesh(mesh, kLiftingOff);
	const auto lengths           = measureDetails(levels, mesh.positions, DetailMeasure::Length);
	const auto births            = measureDetails(levels, mesh.positions, DetailMeasure::Birth);
	for (std::size_t v = 0; v < lengths.size(); ++v) {
		EXPECT_EQ(births[v], levels.birth()[v]);
		const auto& p = levels.parents()[v];
		if (levels.birth()[v] == 0) {
			EXPECT_EQ(lengths[v], 0);
			continue;
		}
		const double n = p[2] == Multiresolution::kNoParent ? 2 : 3;
		double squares = 0;
		for (std::size_t k = 0; k < 3; ++k) {
			double sum = 0;
			for (std::size_t i = 0; i < std::size_t(n); ++i)
				sum += mesh.positions[p[i]][k];
			squares += std::pow(mesh.positions[v][k] - sum / n, 2);
		}
		EXPECT_NEAR(lengths[v], std::sqrt(squares), 1e-12);
	}
}

TEST(Multiresolution, TheNormalComponentOfASphereIsOutwards)
{
	const MeshData mesh          = makeIcosphere(16);
	const Multiresolution levels = levelsOfMesh(mesh, kLiftingOff);
	const auto along             = measureDetails(levels, mesh.positions, DetailMeasure::Normal);
	for (std::size_t v = 0; v < along.size(); ++v)
		if (levels.birth()[v] > 0) {
			EXPECT_GT(along[v], 0) << "vertices of a convex surface lie outside of chords";
		}
}

TEST(Equalise, GainsOfOneGiveThePositionsBackBitForBit)
{
	for (NamedMesh m : allFamilies())
		for (const int lifting : kLiftings) {
			SCOPED_TRACE(m.name);
			for (Vec3& p : m.mesh.positions)
				for (double& x : p)
					x = x == 0 ? -0.0 : x / 3; // not exact in binary, and both zeros
			const Multiresolution levels = levelsOfMesh(m.mesh, lifting);
			for (const bool normalOnly : {false, true}) {
				Equaliser same;
				same.gains.assign(std::size_t(levels.finestLevel()) + 1, 1);
				same.normalOnly = normalOnly;
				EXPECT_TRUE(sameBits(equalise(levels, m.mesh.positions, same), m.mesh.positions));
			}
		}
}

TEST(Equalise, GainsOfZeroLeaveWhatTheBaseMeshPredicts)
{
	for (const int lifting : kLiftings) {
		const MeshData mesh          = makeBumpySphere(500, 3);
		const Multiresolution levels = levelsOfMesh(mesh, lifting);
		Equaliser none;
		none.gains.assign(std::size_t(levels.finestLevel()) + 1, 0);
		std::vector<Vec3> flat = equalise(levels, mesh.positions, none);
		EXPECT_GT(farthest(flat, mesh.positions), 0.01);
		levels.analyse(flat);
		for (std::size_t v = 0; v < flat.size(); ++v)
			if (levels.birth()[v] > 0) {
				EXPECT_LT(
				    std::fabs(flat[v][0]) + std::fabs(flat[v][1]) + std::fabs(flat[v][2]), 1e-9);
			}
	}
}

TEST(Equalise, AGainScalesTheDetailsOfItsLevelAndNoOthers)
{
	const MeshData mesh          = makeBumpySphere(800, 4);
	const Multiresolution levels = levelsOfMesh(mesh);
	ASSERT_GT(levels.finestLevel(), 2);
	const int level = levels.finestLevel() - 1;
	Equaliser twice;
	twice.gains.assign(std::size_t(levels.finestLevel()) + 1, 1);
	twice.gains[std::size_t(level)] = 2;
	std::vector<Vec3> before = mesh.positions, after = equalise(levels, mesh.positions, twice);
	levels.analyse(before);
	levels.analyse(after);
	for (std::size_t v = 0; v < before.size(); ++v)
		for (std::size_t k = 0; k < 3; ++k)
			EXPECT_NEAR(after[v][k], (levels.birth()[v] == level ? 2 : 1) * before[v][k], 1e-9);
}

TEST(Equalise, TheThresholdTakesNoiseOffAPlane)
{
	MeshData mesh = makeFlatGrid(33, 33);
	Rng rng(7);
	for (Vec3& p : mesh.positions)
		p[2] += rng.between(-0.02, 0.02);
	const Multiresolution levels = levelsOfMesh(mesh);
	Equaliser denoise;
	denoise.threshold    = 0.03;
	const auto after     = equalise(levels, mesh.positions, denoise);
	const auto roughness = [](const std::vector<Vec3>& positions) {
		double sum = 0;
		for (const Vec3& p : positions)
			sum += p[2] * p[2];
		return std::sqrt(sum / double(positions.size()));
	};
	EXPECT_LT(roughness(after), 0.6 * roughness(mesh.positions));
}

TEST(Multiresolution, RefusesWhatTheEncoderRefuses)
{
	const MeshData none;
	EXPECT_EQ(Multiresolution::of(none).status().code, StatusCode::Unsupported);
	MeshData bad        = makeTetrahedron();
	bad.positions[1][2] = std::nan("");
	EXPECT_EQ(Multiresolution::of(bad).status().code, StatusCode::InvalidArgument);
	MultiresolutionOptions wrong;
	wrong.lifting = 3;
	EXPECT_EQ(
	    Multiresolution::of(makeTetrahedron(), wrong).status().code, StatusCode::InvalidArgument);
	MultiresolutionOptions stop;
	stop.progress = [](double) { return false; };
	EXPECT_EQ(
	    Multiresolution::of(makeBumpySphere(300, 1), stop).status().code, StatusCode::Cancelled);
}

} // namespace wavemesh::test
