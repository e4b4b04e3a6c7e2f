// SPDX-License-Identifier: GPL-3.0-or-later
// The weights of the update against a dense least-squares solve in doubles, from the definition in
// lifting.h: minimise |I[T,H] alpha - b|.
#include "multires/refine.h"
#include "stage_meshes.h"
#include "wavelet/lifting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>

namespace wavemesh::test {
namespace {

using Matrix = std::vector<std::vector<double>>;

/// One split, with dense matrices over the parent's vertices; each descendant has the area 1.
class DenseProblem
{
public:
	DenseProblem(const CornerTable& parent, const Refinement& r) :
	        parent_(parent), r_(r), parents_(parentsOf(parent, r)),
	        gram_(parent.vertexCount, std::vector<double>(parent.vertexCount, 0)),
	        neighbours_(parent.vertexCount)
	{
		// Descendants before flips.
		plain_ = r;
		for (FaceCode& code : plain_.faceCode)
			if (code == kFaceFlip1 || code == kFaceFlip2)
				code = kFaceNone;
		fine_    = refine(parent, plain_);
		Index at = 0;
		for (Index f = 0; f < parent.faceCount(); ++f) {
			const int splits = faceShape(r.childOnEdge, f).splits;
			const int n      = r.faceCode[f] == kFaceCentre ? 3 : splits + 1;
			for (int i = 0; i < n; ++i)
				parentFace_.push_back(f);
			at += static_cast<Index>(n);
			for (std::size_t i = 0; i < 3; ++i)
				for (std::size_t k = 0; k < 3; ++k) {
					const Index a = parent.vertex[3 * f + i], b = parent.vertex[3 * f + k];
					gram_[a][b] += n * (i == k ? 1.0 / 6 : 1.0 / 12);
					if (i != k)
						neighbours_[a].insert(b);
				}
		}
	}

	const Parents& parents() const { return parents_; }

	std::set<Index> support(std::size_t child, int disc) const
	{
		std::set<Index> h {parents_[child][0], parents_[child][1]};
		for (int k = 0; k < disc; ++k) {
			std::set<Index> wider = h;
			for (const Index v : h)
				wider.insert(neighbours_[v].begin(), neighbours_[v].end());
			h = wider;
		}
		return h;
	}

	/// Inner products of the child's fine hat with every coarse hat: 1, 1/2 or 0 at the corners of
	/// each descendant.
	std::vector<double> target(std::size_t child) const
	{
		std::vector<double> b(parent_.vertexCount, 0);
		const Index m = r_.parentVertices + static_cast<Index>(child);
		for (Index f = 0; f < fine_.faceCount(); ++f) {
			const Index* t = &fine_.vertex[3 * f];
			if (t[0] != m && t[1] != m && t[2] != m)
				continue;
			for (Index k = 0; k < 3; ++k) {
				const Index hat = parent_.vertex[3 * parentFace_[f] + k];
				double sum      = coarseHat(hat, m);
				for (Index i = 0; i < 3; ++i)
					sum += coarseHat(hat, t[i]);
				b[hat] += sum / 12;
			}
		}
		return b;
	}

	double residual(const std::vector<double>& alpha, const std::vector<double>& b) const
	{
		double sum = 0;
		for (std::size_t i = 0; i < b.size(); ++i) {
			double x = -b[i];
			for (std::size_t k = 0; k < b.size(); ++k)
				x += gram_[i][k] * alpha[k];
			sum += x * x;
		}
		return std::sqrt(sum);
	}

	/// Least squares by the normal equations and Gaussian elimination. T = H and its neighbours
	/// holds every row that is not zero, so all rows may take part.
	std::vector<double> solve(const std::set<Index>& support, const std::vector<double>& b) const
	{
		const std::vector<Index> h(support.begin(), support.end());
		const std::size_t n = h.size();
		Matrix m(n, std::vector<double>(n + 1, 0));
		for (std::size_t i = 0; i < n; ++i)
			for (std::size_t row = 0; row < b.size(); ++row) {
				for (std::size_t k = 0; k < n; ++k)
					m[i][k] += gram_[row][h[i]] * gram_[row][h[k]];
				m[i][n] += gram_[row][h[i]] * b[row];
			}
		for (std::size_t i = 0; i < n; ++i)
			for (std::size_t row = 0; row < n; ++row) {
				if (row == i)
					continue;
				const double factor = m[row][i] / m[i][i];
				for (std::size_t k = i; k <= n; ++k)
					m[row][k] -= factor * m[i][k];
			}
		std::vector<double> alpha(b.size(), 0);
		for (std::size_t i = 0; i < n; ++i)
			alpha[h[i]] = m[i][n] / m[i][i];
		return alpha;
	}

private:
	double coarseHat(Index hat, Index at) const
	{
		if (at < r_.parentVertices)
			return at == hat ? 1 : 0;
		const auto& p = parents_[at - r_.parentVertices];
		return p[0] == hat || p[1] == hat ? 0.5 : 0;
	}

	const CornerTable& parent_;
	const Refinement& r_;
	Refinement plain_;
	CornerTable fine_;
	Parents parents_;
	std::vector<Index> parentFace_; ///< #fine faces
	Matrix gram_;
	std::vector<std::set<Index>> neighbours_;
};

std::vector<double> weightsOf(const UpdateWeights& w, std::size_t child, Index count)
{
	std::vector<double> alpha(count, 0);
	for (Index e = w.begin[child]; e < w.begin[child + 1]; ++e)
		alpha[w.vertex[e]] += w.alpha[e] / 65536.0;
	return alpha;
}

template <class Check>
void forManySplits(const Check& check)
{
	for (const MeshData& m :
	     {makeFlippedSphere(100, 1), makeTerrain(100, 2), makeIcosphere(3), makeHoledPlate(1, 2),
	      makeTorus(7, 5), makeFan(9), makeStrip(9), makeTwoTriangles()})
		for (const ReplayedLevel& l : makeLevels(m).replay.levels)
			check(l.parent, l.refinement);
	Rng rng(97);
	for (const NamedMesh& m : smallFamilies(40)) {
		const CornerTable parent = stageMesh(m.mesh).table;
		check(parent, randomRefinement(parent, rng));
	}
}

/// What 16 sweeps of Gauss-Seidel leave on a face that stands alone, where they are the slowest.
constexpr double kTolerance = 0.0025;

TEST(UpdateWeights, Of0Disc_AreTheLeastSquaresSolution)
{
	std::size_t children = 0;
	forManySplits([&](const CornerTable& parent, const Refinement& r) {
		const DenseProblem dense(parent, r);
		const UpdateWeights w = updateWeights(parent, r, dense.parents(), 0);
		ASSERT_EQ(w.begin.size(), dense.parents().size() + 1);
		for (std::size_t i = 0; i < dense.parents().size(); ++i) {
			if (dense.parents()[i][2] != kNone) {
				ASSERT_EQ(w.begin[i], w.begin[i + 1]) << "centres update nothing";
				continue;
			}
			const auto expected = dense.solve(dense.support(i, 0), dense.target(i));
			const auto found    = weightsOf(w, i, parent.vertexCount);
			for (Index v = 0; v < parent.vertexCount; ++v)
				ASSERT_NEAR(found[v], expected[v], kTolerance) << "child " << i << " vertex " << v;
			++children;
		}
	});
	EXPECT_GT(children, 500u);
}

TEST(UpdateWeights, OfWiderDiscs_AreNearlyAsGoodAsTheLeastSquaresSolution)
{
	forManySplits([](const CornerTable& parent, const Refinement& r) {
		const DenseProblem dense(parent, r);
		for (int disc : {1, 2}) {
			const UpdateWeights w = updateWeights(parent, r, dense.parents(), disc);
			for (std::size_t i = 0; i < dense.parents().size(); i += 3) {
				const auto support = dense.support(i, disc);
				if (dense.parents()[i][2] != kNone || support.size() > 40)
					continue;
				const auto b        = dense.target(i);
				const auto expected = dense.solve(support, b),
				           found    = weightsOf(w, i, parent.vertexCount);
				for (Index v = 0; v < parent.vertexCount; ++v)
					if (support.count(v) == 0) {
						ASSERT_EQ(found[v], 0) << "outside the disc";
					}
				const double best = dense.residual(expected, b),
				             zero = dense.residual({std::vector<double>(b.size(), 0)}, b);
				ASSERT_LE(dense.residual(found, b), best + 0.03 * zero) << "disc " << disc;
			}
		}
	});
}

TEST(UpdateWeights, OnRegularSubdivision_AreSymmetric)
{
	const auto levels      = makeLevels(makeIcosphere(8));
	const ReplayedLevel& l = levels.replay.levels.back();
	const Parents parents  = parentsOf(l.parent, l.refinement);
	const UpdateWeights w  = updateWeights(l.parent, l.refinement, parents, 0);
	const auto valence     = valences(l.parent);
	for (std::size_t i = 0; i < parents.size(); ++i) {
		ASSERT_EQ(w.begin[i + 1] - w.begin[i], 2u);
		if (valence[parents[i][0]] == 6 && valence[parents[i][1]] == 6) {
			EXPECT_NEAR(w.alpha[w.begin[i]], w.alpha[w.begin[i] + 1], 4);
		}
	}
}

TEST(UpdateWeights, NextToAHub_AreLeftOut)
{
	// One with thousands of neighbours would cost their square.
	const CornerTable parent = stageMesh(makeBipyramid(1000)).table;
	Refinement r;
	r.parentVertices = r.childVertices = parent.vertexCount;
	r.childOnEdge.assign(parent.cornerCount(), kNone);
	r.faceCode.assign(parent.faceCount(), kFaceNone);
	for (Index c = 0; c < parent.cornerCount(); ++c)
		if (r.childOnEdge[c] == kNone)
			r.childOnEdge[c] = r.childOnEdge[parent.opposite[c]] = r.childVertices++;
	const Parents parents = parentsOf(parent, r);
	const auto valence    = valences(parent);
	for (int disc : {0, 1, 2}) {
		const UpdateWeights w = updateWeights(parent, r, parents, disc);
		for (std::size_t i = 0; i < parents.size(); ++i)
			if (valence[parents[i][0]] > 256 || valence[parents[i][1]] > 256) {
				ASSERT_EQ(w.begin[i], w.begin[i + 1]);
			}
	}
}

} // namespace
} // namespace wavemesh::test
