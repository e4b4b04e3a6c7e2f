// SPDX-License-Identifier: GPL-3.0-or-later
// The integer filter bank: exact inversion, and equations (13)-(15), (23)-(25) computed anew.
#include "stage_meshes.h"
#include "wavelet/lifting.h"

#include <wavemesh/codec.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace wavemesh::test {
namespace {

/// A parent level and a split of it.
struct Step
{
	CornerTable parent;
	Refinement refinement;
};

/// Splits as coarsening gives them, and random ones.
std::vector<Step> manySteps()
{
	std::vector<Step> steps;
	for (const MeshData& m :
	     {makeFlippedSphere(120, 1), makeTerrain(120, 2), makeKleetope(makeIcosahedron()),
	      makeHoledPlate(1, 2), makeBipyramid(40), makeTwoTriangles()})
		for (const ReplayedLevel& l : makeLevels(m).replay.levels)
			steps.push_back({l.parent, l.refinement});
	Rng rng(91);
	for (const NamedMesh& m : smallFamilies(60)) {
		Step s {stageMesh(m.mesh).table, {}};
		s.refinement = randomRefinement(s.parent, rng);
		steps.push_back(std::move(s));
	}
	return steps;
}

enum class Range { Small, Lattice, Extreme };

std::vector<LatticePoint> randomPositions(Index count, Range range, Rng& rng)
{
	constexpr std::int32_t kLow   = std::numeric_limits<std::int32_t>::min();
	constexpr std::int32_t kHigh  = std::numeric_limits<std::int32_t>::max();
	const std::int32_t extremes[] = {kLow, kHigh, kLow + 1, kHigh - 1, 0, -1, 1};
	std::vector<LatticePoint> out(count);
	for (LatticePoint& p : out)
		for (std::int32_t& x : p) {
			const auto any = static_cast<std::int32_t>(static_cast<std::uint32_t>(rng.next()));
			if (range == Range::Small)
				x = any >> 28;
			else if (range == Range::Lattice)
				x = any >> 8;
			else
				x = rng.below(2) ? any : extremes[rng.below(7)];
		}
	return out;
}

TEST(Lifting, SynthesiseUndoesAnalyse_ForAnyIntegersAndEveryDisc)
{
	Rng rng(92);
	for (const Step& s : manySteps()) {
		const Parents parents = parentsOf(s.parent, s.refinement);
		for (int disc : {kLiftingOff, 0, 1, 2}) {
			const UpdateWeights weights = updateWeights(s.parent, s.refinement, parents, disc);
			for (Range range : {Range::Small, Range::Lattice, Range::Extreme}) {
				const auto original = randomPositions(s.refinement.childVertices, range, rng);
				auto positions      = original;
				const auto details  = analyse(parents, weights, positions);
				ASSERT_EQ(details.size(), parents.size());
				positions.resize(s.refinement.parentVertices);
				synthesise(parents, weights, details, positions);
				ASSERT_EQ(positions, original) << "disc " << disc;
			}
		}
	}
}

TEST(Lifting, AnalyseUndoesSynthesise_ForAnyDetails)
{
	// What a damaged file may say: every detail is possible, none may overflow.
	Rng rng(93);
	for (const Step& s : manySteps()) {
		const Parents parents = parentsOf(s.parent, s.refinement);
		for (int disc : {kLiftingOff, 0, 2}) {
			const UpdateWeights weights = updateWeights(s.parent, s.refinement, parents, disc);
			const auto coarse = randomPositions(s.refinement.parentVertices, Range::Extreme, rng);
			const auto details =
			    randomPositions(static_cast<Index>(parents.size()), Range::Extreme, rng);
			auto positions = coarse;
			synthesise(parents, weights, details, positions);
			ASSERT_EQ(analyse(parents, weights, positions), details);
			positions.resize(coarse.size());
			ASSERT_EQ(positions, coarse);
		}
	}
}

TEST(Parents, AreTheEndsOfTheEdgeOrTheCornersOfTheFace)
{
	for (const Step& s : manySteps()) {
		const Parents parents = parentsOf(s.parent, s.refinement);
		ASSERT_EQ(parents.size(), s.refinement.childVertices - s.refinement.parentVertices);
		std::vector<int> seen(parents.size(), 0);
		for (Index c = 0; c < s.parent.cornerCount(); ++c) {
			const Index child = s.refinement.childOnEdge[c];
			if (child == kNone)
				continue;
			const auto& p = parents[child - s.refinement.parentVertices];
			const Index a = s.parent.vertex[nextCorner(c)], b = s.parent.vertex[prevCorner(c)];
			ASSERT_TRUE((p[0] == a && p[1] == b) || (p[0] == b && p[1] == a));
			ASSERT_EQ(p[2], kNone);
			seen[child - s.refinement.parentVertices] = 1;
		}
		std::size_t centre = 0;
		for (const int x : seen)
			centre += static_cast<std::size_t>(x); // centres come last
		for (Index f = 0; f < s.parent.faceCount(); ++f)
			if (s.refinement.faceCode[f] == kFaceCentre) {
				const auto& p = parents[centre++];
				for (std::size_t k = 0; k < 3; ++k)
					ASSERT_EQ(p[k], s.parent.vertex[3 * f + k]);
			}
		ASSERT_EQ(centre, parents.size());
	}
}

/// floor(a / b), b > 0.
std::int64_t floorDivide(std::int64_t a, std::int64_t b)
{
	return a / b - (a % b < 0);
}

/// Row of B_lazy times C, times the number of parents: n child - sum of parents.
std::int64_t lazyDetail(
    const std::vector<LatticePoint>& c,
    std::size_t child,
    const std::array<Index, 3>& parents,
    std::size_t k,
    int& n)
{
	n                = 0;
	std::int64_t sum = 0;
	for (const Index p : parents)
		if (p != kNone) {
			sum += c[p][k];
			++n;
		}
	return n * std::int64_t {c[child][k]} - sum;
}

TEST(Lifting, Analyse_IsEquations13And14WithoutUpdateAnd23And24With)
{
	Rng rng(94);
	for (const Step& s : manySteps()) {
		const Parents parents   = parentsOf(s.parent, s.refinement);
		const Index coarseCount = s.refinement.parentVertices;
		for (int disc : {kLiftingOff, 0, 1, 2}) {
			const UpdateWeights w = updateWeights(s.parent, s.refinement, parents, disc);
			const auto fine = randomPositions(s.refinement.childVertices, Range::Lattice, rng);
			auto coarse     = fine;
			const auto d    = analyse(parents, w, coarse);
			for (std::size_t i = 0; i < parents.size(); ++i)
				for (std::size_t k = 0; k < 3; ++k) {
					int n                  = 0;
					const std::int64_t sum = lazyDetail(fine, coarseCount + i, parents[i], k, n);
					ASSERT_EQ(d[i][k], floorDivide(sum, n)) << "D = floor(B C), (14), (23)";
				}
			ASSERT_EQ(w.begin.empty(), disc == kLiftingOff);
			std::vector<std::array<std::int64_t, 3>> alphaD(coarseCount, {0, 0, 0});
			for (std::size_t i = 0; !w.begin.empty() && i < parents.size(); ++i)
				for (Index e = w.begin[i]; e < w.begin[i + 1]; ++e)
					for (std::size_t k = 0; k < 3; ++k)
						alphaD[w.vertex[e]][k] += std::int64_t {w.alpha[e]} * d[i][k];
			for (Index v = 0; v < coarseCount; ++v)
				for (std::size_t k = 0; k < 3; ++k)
					ASSERT_EQ(coarse[v][k], fine[v][k] + floorDivide(alphaD[v][k], 65536))
					    << "C' = A C + floor(alpha D), (13), (24)";
		}
	}
}

TEST(Lifting, Synthesise_IsEquation15WithoutUpdateAnd25With)
{
	Rng rng(95);
	for (const Step& s : manySteps()) {
		const Parents parents   = parentsOf(s.parent, s.refinement);
		const Index coarseCount = s.refinement.parentVertices;
		for (int disc : {kLiftingOff, 0, 1, 2}) {
			const UpdateWeights w = updateWeights(s.parent, s.refinement, parents, disc);
			const auto coarse     = randomPositions(coarseCount, Range::Lattice, rng);
			const auto d = randomPositions(static_cast<Index>(parents.size()), Range::Small, rng);
			auto fine    = coarse;
			synthesise(parents, w, d, fine);
			std::vector<std::array<std::int64_t, 3>> alphaD(coarseCount, {0, 0, 0});
			for (std::size_t i = 0; !w.begin.empty() && i < parents.size(); ++i)
				for (Index e = w.begin[i]; e < w.begin[i + 1]; ++e)
					for (std::size_t k = 0; k < 3; ++k)
						alphaD[w.vertex[e]][k] += std::int64_t {w.alpha[e]} * d[i][k];
			for (Index v = 0; v < coarseCount; ++v)
				for (std::size_t k = 0; k < 3; ++k)
					ASSERT_EQ(fine[v][k], coarse[v][k] - floorDivide(alphaD[v][k], 65536));
			for (std::size_t i = 0; i < parents.size(); ++i)
				for (std::size_t k = 0; k < 3; ++k) {
					// ceil(P (C - floor(alpha D)) + Q D), P the mean of the parents, Q one.
					int n                   = 0;
					const std::int64_t lazy = lazyDetail(fine, coarseCount + i, parents[i], k, n);
					const std::int64_t sum  = n * std::int64_t {fine[coarseCount + i][k]} - lazy;
					ASSERT_EQ(fine[coarseCount + i][k], -floorDivide(-sum, n) + d[i][k]);
				}
		}
	}
}

TEST(Lifting, OfAFunctionLinearAlongTheEdges_GivesZeroDetailsAndMovesNothing)
{
	for (const Step& s : manySteps()) {
		const Parents parents = parentsOf(s.parent, s.refinement);
		Rng rng(96);
		auto positions = randomPositions(s.refinement.parentVertices, Range::Lattice, rng);
		for (LatticePoint& p : positions)
			for (std::int32_t& x : p)
				x = x / 8 * 6; // halves and thirds are whole
		const auto coarse = positions;
		for (const auto& p : parents)
			positions.push_back(middle(positions, p));
		const auto details =
		    analyse(parents, updateWeights(s.parent, s.refinement, parents, 1), positions);
		for (const LatticePoint& d : details)
			ASSERT_EQ(d, (LatticePoint {0, 0, 0}));
		positions.resize(coarse.size());
		ASSERT_EQ(positions, coarse);
	}
}

} // namespace
} // namespace wavemesh::test
