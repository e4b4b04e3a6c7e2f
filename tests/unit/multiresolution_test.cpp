// SPDX-License-Identifier: GPL-3.0-or-later
// The hierarchy in the mesh's own numbering, and what filters do with it.
#include "mesh_families.h"

#include <wavemesh/multiresolution.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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
			options.mode       = Mode::Classic;
			options.optimize   = Optimize::Size;
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
