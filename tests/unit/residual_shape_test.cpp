// SPDX-License-Identifier: GPL-3.0-or-later
// The learnt distribution of a predictor's errors.
#include "entropy/residual_shape.h"
#include "rng.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace wavemesh::test {
namespace {

constexpr std::int64_t kBeyondAll = std::int64_t(1) << 40;

/// Points on both sides, dense in the middle.
std::vector<std::int64_t> points()
{
	std::vector<std::int64_t> out;
	for (std::int64_t u = -(std::int64_t(1) << 23); u < -1000; u += -u / 50)
		out.push_back(u);
	for (std::int64_t u = -1000; u <= 1000; ++u)
		out.push_back(u);
	for (std::int64_t u = 1001; u < (std::int64_t(1) << 23); u += u / 50)
		out.push_back(u);
	return out;
}

void expectIsADistribution(const ResidualShape& shape)
{
	std::int32_t before = 0;
	for (const std::int64_t u : points()) {
		const std::int32_t mass = shape.below(u);
		ASSERT_GE(mass, before) << u;
		ASSERT_LE(mass, ResidualShape::kTotal) << u;
		before = mass;
	}
	// What lies outside of all bins counts as inside the outermost.
	EXPECT_GE(shape.below(-kBeyondAll), 0);
	EXPECT_LT(shape.below(-kBeyondAll), 64);
	EXPECT_GT(shape.below(kBeyondAll), ResidualShape::kTotal - 20000);
	EXPECT_LE(shape.below(kBeyondAll), ResidualShape::kTotal);
}

TEST(ResidualShape, IsADistributionBeforeAndAfterLearning)
{
	ResidualShape shape;
	expectIsADistribution(shape);
	Rng rng(401);
	for (int round = 0; round < 40; ++round) {
		for (int i = 0; i < 150; ++i)
			shape.learn((std::int64_t(rng.below(2000)) - 1000) >> rng.below(10));
		ASSERT_NO_FATAL_FAILURE(expectIsADistribution(shape)) << round;
	}
}

TEST(ResidualShape, IsEvenAtFirst)
{
	const ResidualShape shape;
	EXPECT_NEAR(shape.below(0), ResidualShape::kTotal / 2, 1);
	for (const std::int64_t u : points())
		ASSERT_NEAR(shape.below(u) + shape.below(-u), ResidualShape::kTotal, 2) << u;
}

TEST(ResidualShape, EveryBinKeepsSomeMassWhateverWasLearnt)
{
	ResidualShape shape;
	for (int i = 0; i < 100000; ++i)
		shape.learn(3);
	// Bins: 8 wide up to 128, then four to an octave.
	for (std::int64_t u = 0; u < 128; u += 8) {
		EXPECT_GE(shape.below(u + 8) - shape.below(u), 4) << u;
		EXPECT_GE(shape.below(-u) - shape.below(-u - 8), 4) << u;
	}
	for (std::int64_t width = 32; width < (std::int64_t(1) << 18); width *= 2)
		for (std::int64_t u = 4 * width; u < 8 * width; u += width) {
			EXPECT_GE(shape.below(u + width) - shape.below(u), 4) << u;
			EXPECT_GE(shape.below(-u) - shape.below(-u - width), 4) << u;
		}
}

TEST(ResidualShape, LearnsWhereTheErrorsAre)
{
	for (const std::int64_t at : {-5000, -100, -1, 0, 60, 700, 1 << 20}) {
		ResidualShape shape;
		const auto massAround = [&] {
			const std::int64_t size  = at < 0 ? -at : at;
			const std::int64_t reach = size / 2 + 16;
			return shape.below(at + reach) - shape.below(at - reach);
		};
		const std::int32_t before = massAround();
		for (int i = 0; i < 2000; ++i)
			shape.learn(at);
		EXPECT_GT(massAround(), before) << at;
		EXPECT_GT(massAround(), ResidualShape::kTotal / 10 * 9) << at;
	}
}

TEST(ResidualShape, ForgetsWhatWasLongAgo)
{
	ResidualShape shape;
	for (int i = 0; i < 20000; ++i)
		shape.learn(300);
	for (int i = 0; i < 20000; ++i)
		shape.learn(-300);
	EXPECT_GT(shape.below(0), ResidualShape::kTotal / 10 * 9);
}

TEST(ResidualShape, IsLinearInsideABin)
{
	ResidualShape shape;
	for (int i = 0; i < 500; ++i)
		shape.learn(4);
	const std::int32_t from = shape.below(0), to = shape.below(8);
	for (std::int64_t u = 0; u <= 8; ++u)
		EXPECT_NEAR(double(shape.below(u)), from + double(to - from) * double(u) / 8, 1) << u;
}

TEST(ResidualShape, TakesAnyArgument)
{
	constexpr std::int64_t kExtreme[] = {
	    -std::numeric_limits<std::int64_t>::max(),
	    std::numeric_limits<std::int64_t>::max(),
	    -(std::int64_t(1) << 21),
	    (std::int64_t(1) << 21),
	    (std::int64_t(1) << 21) - 1,
	    127,
	    128};
	ResidualShape shape;
	for (int i = 0; i < 300; ++i)
		for (const std::int64_t u : kExtreme) {
			shape.learn(u);
			ASSERT_GE(shape.below(u), 0);
			ASSERT_LE(shape.below(u), ResidualShape::kTotal);
		}
	expectIsADistribution(shape);
}

} // namespace
} // namespace wavemesh::test
