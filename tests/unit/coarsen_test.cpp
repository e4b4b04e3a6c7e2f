// SPDX-License-Identifier: GPL-3.0-or-later
// Inverse irregular subdivision, one step and all of them.
#include "mesh_check.h"
#include "multires/quadrics.h"
#include "multires/refine.h"
#include "stage_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wavemesh::test {
namespace {

/// Every fine vertex is kept, or is the child of one coarse edge, or the centre of one coarse face.
std::string whatIsNotAccountedFor(const Coarsening& c, Index fineVertices)
{
	std::vector<int> role(fineVertices, 0);
	for (std::size_t i = 0; i < c.fineVertex.size(); ++i) {
		++role[c.fineVertex[i]];
		if (i > 0 && c.fineVertex[i] <= c.fineVertex[i - 1])
			return "kept vertices are not increasing";
	}
	for (Index k = 0; k < c.coarse.cornerCount(); ++k) {
		const Index d = c.coarse.opposite[k];
		if (d != kNone && c.childOnEdge[d] != c.childOnEdge[k])
			return "the two sides of an edge have different children";
		if (c.childOnEdge[k] != kNone && (d == kNone || k < d))
			++role[c.childOnEdge[k]];
	}
	for (const Index v : c.centre)
		if (v != kNone)
			++role[v];
	for (Index v = 0; v < fineVertices; ++v)
		if (role[v] != 1)
			return "vertex " + std::to_string(v) + " has " + std::to_string(role[v]) + " roles";
	return {};
}

/// Refines the coarse mesh as the decoder does and compares with the fine one, face by face.
std::string whatRefineDoesNotUndo(const Coarsening& step, const CornerTable& fine)
{
	std::vector<Index> source(step.coarse.vertexCount);
	std::iota(source.begin(), source.end(), 0u);
	const Replay back = replay({step}, step.coarse, std::move(source));
	if (back.finest.vertexCount != fine.vertexCount)
		return "another number of vertices";
	auto faces = facesOf(back.finest);
	for (auto& t : faces)
		for (auto& v : t)
			v = back.source[v];
	if (sortedFaces(std::move(faces)) != sortedFaces(facesOf(fine)))
		return "other faces";
	return whatIsNotLinked(back.finest);
}

/// Coarsens to the end; empty if every step keeps what a step must keep.
/// @param share  ErrorCriterion::share; 0: not active
std::string
whatAStepBreaks(const MeshData& mesh, const GeometricalCriterion& criterion, double share = 0)
{
	Topology expected;
	if (std::string s = whatIsNotManifold(mesh, &expected); !s.empty())
		return s;
	StageMesh level = stageMesh(mesh);
	Quadrics quadrics(level.table, level.positions);
	for (int depth = 0;; ++depth) {
		const std::string where = "step " + std::to_string(depth) + ": ";
		const Coarsening step   = coarsen(
		      level.table, level.positions, criterion, {}, {share > 0 ? &quadrics : nullptr, share});
		Topology found;
		if (std::string s = whatIsNotManifold(meshOf(step.coarse, {}), &found); !s.empty())
			return where + s;
		if (found.euler != expected.euler || found.boundaryLoops != expected.boundaryLoops ||
		    found.components != expected.components)
			return where + "the topology changes";
		if (std::string s = whatIsNotLinked(step.coarse); !s.empty())
			return where + s;
		if (std::string s = whatIsNotAccountedFor(step, level.table.vertexCount); !s.empty())
			return where + s;
		if (std::string s = whatRefineDoesNotUndo(step, level.table); !s.empty())
			return where + s;
		if (step.coarse.vertexCount == level.table.vertexCount)
			return sortedFaces(facesOf(step.coarse)) == sortedFaces(facesOf(level.table))
			           ? ""
			           : where + "nothing was merged, but the faces are others";
		quadrics.carry(step, level.positions);
		level.positions = pickedPositions(level.positions, step.fineVertex);
		level.table     = step.coarse;
	}
}

class CoarsenFamily : public testing::TestWithParam<NamedMesh>
{
};

TEST_P(CoarsenFamily, EveryStep_IsManifoldOfTheSameTopologyAndRefineUndoesIt)
{
	EXPECT_EQ(whatAStepBreaks(GetParam().mesh, {}), "");
}

TEST_P(CoarsenFamily, EveryStepUnderTheGeometricalCriterion_IsManifoldAndRefineUndoesIt)
{
	EXPECT_EQ(whatAStepBreaks(GetParam().mesh, {true, 0.3, 0.25}), "");
	EXPECT_EQ(whatAStepBreaks(GetParam().mesh, {true, 0.05, 0.02}), "");
}

TEST_P(CoarsenFamily, EveryStepByItsError_IsManifoldAndRefineUndoesIt)
{
	EXPECT_EQ(whatAStepBreaks(GetParam().mesh, {}, 0.5), "");
	EXPECT_EQ(whatAStepBreaks(GetParam().mesh, {}, 0.9), "");
}

TEST_P(CoarsenFamily, ClosedGenus0_EndsAtTenVerticesOrFewer)
{
	Topology t;
	ASSERT_EQ(whatIsNotManifold(GetParam().mesh, &t), "");
	if (t.boundaryLoops != 0 || t.genus != 0)
		return;
	for (const Steering& steering :
	     {Steering {}, Steering {1, 0.65, 0.5}, Steering {0, 0.4, 0.4}}) {
		const Levels levels = makeLevels(GetParam().mesh, {}, 12, steering);
		const CornerTable& base =
		    levels.replay.levels.empty() ? levels.replay.finest : levels.replay.levels[0].parent;
		EXPECT_LE(base.vertexCount, 10 * t.components) << steering.freeSteps;
	}
}

TEST_P(CoarsenFamily, ReplayFromTheBase_EndsWithTheOriginal)
{
	const MeshData& mesh = GetParam().mesh;
	for (const bool active : {false, true}) {
		const Levels levels = makeLevels(mesh, {active, 0.3, 0.25});
		auto faces          = facesOf(levels.replay.finest);
		for (auto& t : faces)
			for (auto& v : t)
				v = levels.replay.source[v];
		EXPECT_EQ(sortedFaces(std::move(faces)), sortedFaces(mesh.triangles));
	}
}

INSTANTIATE_TEST_SUITE_P(
    Coarsen, CoarsenFamily, testing::ValuesIn(allFamilies()), [](const auto& family) {
	    return family.param.name;
    });

std::vector<Index> vertexCounts(const MeshData& mesh, const Steering& steering)
{
	const Levels levels = makeLevels(mesh, {}, 12, steering);
	std::vector<Index> counts;
	for (const ReplayedLevel& level : levels.replay.levels)
		counts.push_back(level.parent.vertexCount);
	return counts;
}

/// Of the finest splits, one after the other: how many are regular.
std::size_t regularSplits(std::vector<Index> counts, Index finest)
{
	std::size_t n = 0;
	for (; !counts.empty() && isRegularSplit(counts.back(), finest); ++n) {
		finest = counts.back();
		counts.pop_back();
	}
	return n;
}

TEST(Steering, RegularSplitsFromTheFinestOnAreLeftToConnectivity)
{
	const std::pair<MeshData, bool> meshes[] = {
	    {makeTorus(64, 32), true},
	    {makeTorus(54, 30), true},
	    {makeIcosphere(16), true},
	    {makeBumpySphere(900, 1), false}};
	for (const auto& [mesh, isRegular] : meshes) {
		const auto finest = Index(mesh.positions.size());
		auto steered = vertexCounts(mesh, {0, 0.5, 0.5}), free = vertexCounts(mesh, {});
		const std::size_t regular = regularSplits(free, finest);
		ASSERT_EQ(regular > 0, isRegular) << finest;
		for (std::size_t i = 0; i < regular; ++i, free.pop_back(), steered.pop_back())
			ASSERT_EQ(steered.back(), free.back()) << finest << ": split " << i;
		EXPECT_NE(steered, free) << finest << ": others are by error";
	}
}

// ---- the paper's criterion, computed anew -------------------------------------------------------

using Vector = std::array<double, 3>;

Vector minus(const LatticePoint& a, const LatticePoint& b)
{
	return {double(a[0]) - b[0], double(a[1]) - b[1], double(a[2]) - b[2]};
}
Vector cross(const Vector& a, const Vector& b)
{
	return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double norm(const Vector& a)
{
	return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

std::vector<bool> sharpVertices(const StageMesh& m, double threshold)
{
	std::vector<bool> sharp(m.table.vertexCount, false);
	const auto normal = [&](Index f) {
		const auto at       = [&](Index k) { return m.positions[m.table.vertex[3 * f + k]]; };
		Vector n            = cross(minus(at(1), at(0)), minus(at(2), at(0)));
		const double length = norm(n);
		for (double& x : n)
			x = length > 0 ? x / length : 0;
		return n;
	};
	for (Index c = 0; c < m.table.cornerCount(); ++c) {
		const Index d = m.table.opposite[c];
		if (d == kNone || norm(cross(normal(c / 3), normal(d / 3))) > threshold * (1 + 1e-9))
			sharp[m.table.vertex[nextCorner(c)]] = sharp[m.table.vertex[prevCorner(c)]] = true;
	}
	return sharp;
}

TEST(GeometricalCriterion, NoSharpVertexBecomesAChildFarFromItsEdge)
{
	int sharpChildren = 0;
	for (const NamedMesh& m : allFamilies())
		for (const auto& [sharpness, deviation] : {std::pair {0.3, 0.25}, std::pair {0.1, 0.05}}) {
			const StageMesh fine = stageMesh(m.mesh, 10);
			const auto sharp     = sharpVertices(fine, sharpness);
			const Coarsening coarse =
			    coarsen(fine.table, fine.positions, {true, sharpness, deviation});
			for (Index c = 0; c < coarse.coarse.cornerCount(); ++c) {
				const Index child = coarse.childOnEdge[c];
				if (child == kNone || !sharp[child])
					continue;
				++sharpChildren;
				const auto& v = fine.positions[child];
				const auto& a =
				    fine.positions[coarse.fineVertex[coarse.coarse.vertex[nextCorner(c)]]];
				const auto& b =
				    fine.positions[coarse.fineVertex[coarse.coarse.vertex[prevCorner(c)]]];
				const Vector edge = minus(a, b), va = minus(v, a), vb = minus(v, b);
				const Vector detail = {
				    (va[0] + vb[0]) / 2, (va[1] + vb[1]) / 2, (va[2] + vb[2]) / 2};
				const double ratio = norm(cross(detail, edge)) / (norm(edge) * norm(edge));
				ASSERT_LT(ratio, deviation * (1 + 1e-9)) << m.name << " vertex " << child;
			}
			for (const Index v : coarse.centre)
				if (v != kNone) {
					ASSERT_FALSE(sharp[v]) << m.name << " vertex " << v;
				}
		}
	EXPECT_GT(sharpChildren, 100) << "the test saw too little";
}

TEST(GeometricalCriterion, OnASmoothClosedMesh_ChangesNothing)
{
	const StageMesh fine   = stageMesh(makeIcosphere(15), 16);
	const Coarsening blind = coarsen(fine.table, fine.positions, {});
	const Coarsening aware = coarsen(fine.table, fine.positions, {true, 0.3, 0.25});
	EXPECT_EQ(aware.fineVertex, blind.fineVertex);
	EXPECT_EQ(aware.coarse.vertex, blind.coarse.vertex);
}

TEST(Coarsen, UndoesRegularSubdivision)
{
	const StageMesh fine    = stageMesh(makeIcosphere(8));
	const Coarsening coarse = coarsen(fine.table, fine.positions, {});
	EXPECT_EQ(coarse.coarse.vertexCount, 10u * 4 * 4 + 2) << "4:1 everywhere";
}

/// Two tori in one: all vertices have six neighbours but the three at the seam, which have ten.
MeshData makeDoubleTorus()
{
	MeshData mesh   = makeTorus(5, 5);
	const auto one  = mesh;
	const auto many = static_cast<std::uint32_t>(one.positions.size());
	const auto seam = one.triangles[0];
	mesh            = joined({one, moved(one, 9, 0, 0)});
	mesh.triangles.erase(
	    mesh.triangles.begin() + static_cast<std::ptrdiff_t>(one.triangles.size()));
	mesh.triangles.erase(mesh.triangles.begin());
	// The second one's seam, turned round, becomes the first one's; the gaps close behind it.
	std::vector<std::uint32_t> name(2 * many);
	std::iota(name.begin(), name.end(), 0u);
	const std::uint32_t at[3] = {seam[0], seam[2], seam[1]};
	std::vector<std::array<double, 3>> positions(
	    mesh.positions.begin(), mesh.positions.begin() + many);
	for (std::uint32_t v = 0; v < many; ++v) {
		const auto k = std::find(seam.begin(), seam.end(), v) - seam.begin();
		if (k < 3)
			name[many + v] = at[k];
		else {
			name[many + v] = static_cast<std::uint32_t>(positions.size());
			positions.push_back(mesh.positions[many + v]);
		}
	}
	for (auto& t : mesh.triangles)
		for (auto& v : t)
			v = name[v];
	mesh.positions = positions;
	return mesh;
}

TEST(Coarsen, UndoesRegularSubdivisionWhereAllExtraordinaryVerticesAreHubs)
{
	const StageMesh coarse = stageMesh(makeDoubleTorus());
	Refinement all;
	all.parentVertices = all.childVertices = coarse.table.vertexCount;
	all.childOnEdge.assign(coarse.table.cornerCount(), kNone);
	all.faceCode.assign(coarse.table.faceCount(), kFaceNone);
	for (Index c = 0; c < coarse.table.cornerCount(); ++c) {
		const Index d      = coarse.table.opposite[c];
		all.childOnEdge[c] = d < c ? all.childOnEdge[d] : all.childVertices++;
	}
	const CornerTable fine = refine(coarse.table, all);
	const MeshData mesh    = meshOf(fine, std::vector<LatticePoint>(fine.vertexCount));
	for (const std::uint64_t seed : {61u, 62u, 63u}) {
		const auto shuffledFine =
		    buildCornerTable(shuffled(mesh, seed).triangles, fine.vertexCount);
		ASSERT_TRUE(shuffledFine.ok());
		const std::vector<LatticePoint> positions(fine.vertexCount);
		EXPECT_EQ(
		    coarsen(*shuffledFine, positions, {}).coarse.vertexCount, coarse.table.vertexCount)
		    << "4:1 everywhere, seed " << seed;
	}
}

TEST(Coarsen, ShrinksIrregularMeshesByNearlyTwoOnAverage)
{
	for (const MeshData& mesh : {makeBumpySphere(2500, 51), makeTerrain(2500, 52)}) {
		const Levels levels = makeLevels(mesh);
		ASSERT_GE(levels.replay.levels.size(), 4u);
		const auto& fourth = levels.replay.levels[levels.replay.levels.size() - 4].parent;
		EXPECT_GE(std::pow(double(mesh.positions.size()) / fourth.vertexCount, 0.25), 1.85);
	}
}

TEST(Coarsen, DoesNotDependOnAnythingButItsInput)
{
	const StageMesh fine = stageMesh(makeFlippedSphere(500, 53));
	const Coarsening a   = coarsen(fine.table, fine.positions, {}),
	                 b   = coarsen(fine.table, fine.positions, {});
	EXPECT_EQ(a.coarse.vertex, b.coarse.vertex);
	EXPECT_EQ(a.childOnEdge, b.childOnEdge);
	EXPECT_EQ(a.faceCode, b.faceCode);
}

TEST(CoarsenAll, StopsWhenAsked)
{
	const StageMesh fine = stageMesh(makeIcosphere(15));
	int calls            = 0;
	const auto steps =
	    coarsenAll(fine.table, fine.positions, {}, {}, [&](double) { return ++calls < 2; });
	EXPECT_EQ(calls, 2);
	EXPECT_EQ(steps.size(), 2u);
}

} // namespace
} // namespace wavemesh::test
