// SPDX-License-Identifier: GPL-3.0-or-later
// Linear prediction that learns its weights.
#include "predict/least_squares.h"
#include "rng.h"

#include <gtest/gtest.h>

#include <cmath>

namespace wavemesh::test {
namespace {

constexpr std::size_t kFeatures     = 5;
using Weights                       = std::array<double, kFeatures>;
using Fit                           = LeastSquares<kFeatures>;
constexpr std::int32_t kHalfLargest = Fit::kLargest / 2;

Fit::Features randomFeatures(Rng& rng)
{
	Fit::Features f;
	for (auto& x : f)
		x = static_cast<std::int32_t>(rng.below(2 * kHalfLargest)) - kHalfLargest;
	return f;
}

std::int32_t targetOf(const Weights& w, const Fit::Features& f)
{
	double sum = 0;
	for (std::size_t i = 0; i < kFeatures; ++i)
		sum += w[i] * f[i];
	return static_cast<std::int32_t>(std::lround(sum));
}

void teach(Fit& fit, const Weights& w, Rng& rng, int vertices, std::int32_t importance)
{
	for (int i = 0; i < vertices; ++i) {
		for (int k = 0; k < 3; ++k) {
			const Fit::Features f = randomFeatures(rng);
			fit.observe<1>({f}, {targetOf(w, f)}, {importance});
		}
		fit.endOfVertex();
	}
}

double meanError(const Fit& fit, const Weights& w, Rng& rng)
{
	double sum = 0;
	for (int i = 0; i < 500; ++i) {
		const Fit::Features f = randomFeatures(rng);
		sum += std::abs(double(fit.predict(f)) - targetOf(w, f));
	}
	return sum / 500;
}

TEST(LeastSquares, KnowsNothingAtFirst)
{
	Rng rng(701);
	for (int i = 0; i < 20; ++i)
		EXPECT_EQ(Fit().predict(randomFeatures(rng)), 0);
}

TEST(LeastSquares, FindsTheWeightsOfALinearRelation)
{
	for (const Weights& w :
	     {Weights {0.5, 0.25, -0.25, 0.125, 0}, Weights {0, 0, 0, 0, 1}, Weights {1, -1, 1, -1, 1},
	      Weights {0.1, 0.2, 0.3, 0.2, 0.1}}) {
		Rng rng(702);
		Fit fit;
		teach(fit, w, rng, 200, 64);
		EXPECT_LT(meanError(fit, w, rng), 20) << "of targets up to 8192";
	}
}

TEST(LeastSquares, FollowsARelationThatChanges)
{
	Rng rng(703);
	Fit fit;
	const Weights before {1, 0, 0, 0, 0}, after {0, 0, 0.5, 0, -0.5};
	teach(fit, before, rng, 500, 64);
	EXPECT_LT(meanError(fit, before, rng), 20);
	teach(fit, after, rng, 2000, 64);
	EXPECT_LT(meanError(fit, after, rng), 20);
}

TEST(LeastSquares, ListensMoreToWhatIsImportant)
{
	Rng rng(704);
	Fit fit;
	const Weights weighty {1, 0, 0, 0, 0}, light {0, 1, 0, 0, 0};
	for (int i = 0; i < 500; ++i) {
		teach(fit, weighty, rng, 1, 1000);
		teach(fit, light, rng, 1, 10);
	}
	EXPECT_LT(4 * meanError(fit, weighty, rng), meanError(fit, light, rng));
}

/// Everything as large as it may be, in all combinations of signs that do not cancel: the sanitizer
/// sees what overflows.
template <std::size_t N>
void teachExtremes()
{
	constexpr std::int32_t kMost = LeastSquares<N>::kLargest;
	for (int pattern = 0; pattern < 16; ++pattern) {
		LeastSquares<N> fit;
		typename LeastSquares<N>::Features f;
		for (std::size_t i = 0; i < N; ++i)
			f[i] = (pattern >> (i % 4)) & 1 ? kMost : -kMost;
		for (int i = 0; i < 3000; ++i) {
			for (int k = 0; k < 3; ++k)
				fit.template observe<1>({f}, {pattern & 1 ? kMost : -kMost}, {1024});
			fit.endOfVertex();
		}
		const std::int64_t most = std::int64_t(N) * 4 * kMost;
		EXPECT_LE(std::abs(std::int64_t(fit.predict(f))), most);
		EXPECT_NEAR(fit.predict(f), pattern & 1 ? kMost : -kMost, kMost / 8);
	}
}

TEST(LeastSquares, OfExtremesNeverOverflows)
{
	teachExtremes<7>();
	teachExtremes<9>();
}

TEST(LeastSquares, OfExtremesThatContradictNeverOverflows)
{
	constexpr std::int32_t kMost = LeastSquares<9>::kLargest;
	Rng rng(705);
	LeastSquares<9> fit;
	for (int i = 0; i < 20000; ++i) {
		for (int k = 0; k < 3; ++k) {
			LeastSquares<9>::Features f;
			for (auto& x : f)
				x = static_cast<std::int32_t>(rng.below(3)) * kMost - kMost;
			fit.observe<1>(
			    {f}, {rng.below(2) ? kMost : -kMost}, {1 + static_cast<int>(rng.below(1024))});
			ASSERT_LE(std::abs(std::int64_t(fit.predict(f))), std::int64_t(36) * kMost);
		}
		fit.endOfVertex();
	}
}

TEST(LeastSquares, OfAllZerosStaysZero)
{
	Fit fit;
	for (int i = 0; i < 5000; ++i) {
		for (int k = 0; k < 3; ++k)
			fit.observe<1>({Fit::Features {}}, {Fit::kLargest}, {1024});
		fit.endOfVertex();
	}
	EXPECT_EQ(fit.predict({1000, 1000, 1000, 1000, 1000}), 0);
}

} // namespace
} // namespace wavemesh::test
