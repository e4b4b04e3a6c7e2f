// SPDX-License-Identifier: GPL-3.0-or-later
// Integers coded by the mixed opinions of predictors.
#include "entropy/mixed_value.h"
#include "entropy/range_coder.h"
#include "rng.h"

#include <gtest/gtest.h>

#include <memory>

namespace wavemesh::test {
namespace {

/// One value with everything that encoder and decoder both know before it.
struct Task
{
	std::int64_t value = 0, low = 0, high = 0, guide = 0;
	int spread  = 0;
	int bits    = 0; ///< > 0: by halving within low .. low + 2^bits - 1
	bool asOdds = false;
	MixContext context;
	std::array<std::int64_t, MixedValue::kMaxOpinions> centre {};
	std::array<int, MixedValue::kMaxOpinions> scale {};
};

/// As if every sixteenth value had come up once.
struct EvenCounts
{
	std::uint32_t below(std::uint32_t x) const { return x / 16; }
};

/// Codes all the tasks with N opinions; the same learning on both sides.
template <std::size_t N, class Coder>
std::vector<std::int64_t> run(Coder& coder, const std::vector<Task>& tasks)
{
	const auto value = std::make_unique<MixedValue>(6144);
	std::vector<ResidualShape> shapes(N);
	const EvenCounts even;
	std::vector<std::int64_t> out;
	for (const Task& t : tasks) {
		for (std::size_t i = 0; i < N; ++i)
			value->setOpinion(i, t.centre[i], t.scale[i], shapes[i]);
		const EvenCounts* const counts = t.asOdds ? &even : nullptr;
		out.push_back(
		    t.bits > 0 ? value->codeWithin<N>(coder, t.value, t.low, t.bits, t.context, counts)
		               : value->codeAround<N>(
		                     coder, t.value, t.low, t.high, t.guide, t.spread, t.context, counts));
	}
	return out;
}

std::vector<std::int64_t> valuesOf(const std::vector<Task>& tasks)
{
	std::vector<std::int64_t> out;
	for (const Task& t : tasks)
		out.push_back(t.value);
	return out;
}

constexpr std::size_t kMost = MixedValue::kMaxOpinions, kSome = MixedValue::kSomeOpinions,
                      kFew = MixedValue::kFewOpinions;

template <std::size_t N>
std::vector<std::uint8_t> encoded(const std::vector<Task>& tasks)
{
	RangeEncoder coder;
	EXPECT_EQ(run<N>(coder, tasks), valuesOf(tasks)) << "the encoder says what it wrote";
	return coder.finish();
}

template <std::size_t N>
void expectInverse(const std::vector<Task>& tasks)
{
	const auto stream = encoded<N>(tasks);
	RangeDecoder decoder(stream.data(), stream.size());
	ASSERT_EQ(run<N>(decoder, tasks), valuesOf(tasks)) << N << " opinions";
	EXPECT_FALSE(decoder.exhausted());
}

/// Opinions anywhere, from exact to absurd; values anywhere in the range, its ends among them.
Task randomTask(Rng& rng, bool within)
{
	Task t;
	const std::int64_t size = std::int64_t(1) << rng.below(25);
	t.low                   = within ? size * std::int64_t(rng.below(3)) : 0;
	t.bits                  = within ? bitLength(static_cast<std::uint64_t>(size)) - 1 : 0;
	if (t.bits == 0)
		t.low = 0;
	t.high = t.low + size;
	switch (rng.below(4)) {
	case 0:
		t.value = t.low;
		break;
	case 1:
		t.value = t.high - 1;
		break;
	default:
		t.value = t.low + std::int64_t(rng.below(static_cast<std::uint32_t>(size)));
	}
	t.guide =
	    rng.below(2) ? t.value : t.low + std::int64_t(rng.below(static_cast<std::uint32_t>(size)));
	t.spread  = static_cast<int>(rng.below(26));
	t.asOdds  = rng.below(2) == 1;
	t.context = {rng.below(12), rng.below(12), rng.below(12)};
	for (std::size_t i = 0; i < t.centre.size(); ++i) {
		constexpr std::int64_t kFar  = (std::int64_t(1) << 33) - 1;
		const std::int64_t centres[] = {
		    16 * t.value, 16 * t.value + 8, kFar, -kFar, 16 * std::int64_t(rng.below(1 << 24))};
		t.centre[i] = centres[rng.below(5)];
		t.scale[i]  = static_cast<int>(rng.below(kScaleClasses));
	}
	return t;
}

std::vector<Task> randomTasks(std::uint64_t seed, int count)
{
	Rng rng(seed);
	std::vector<Task> tasks;
	for (int i = 0; i < count; ++i)
		tasks.push_back(randomTask(rng, rng.below(2) == 1));
	return tasks;
}

TEST(MixedValue, ReadsWhatWasWrittenWithFewOpinionsAndWithAll)
{
	for (std::uint64_t seed = 500; seed < 510; ++seed) {
		expectInverse<kFew>(randomTasks(seed, 300));
		expectInverse<kSome>(randomTasks(seed, 300));
		expectInverse<kMost>(randomTasks(seed, 300));
	}
}

TEST(MixedValue, OfARangeOfOneCostsNothing)
{
	std::vector<Task> tasks(1000);
	for (Task& t : tasks)
		t.high = 1;
	expectInverse<kMost>(tasks);
	EXPECT_TRUE(encoded<kMost>(tasks).empty());
}

TEST(MixedValue, GuideAtAnEndOfTheRangeReachesTheOther)
{
	std::vector<Task> tasks;
	for (const std::int64_t high : {2, 3, 1 << 12, 1 << 24})
		for (const std::int64_t guide : {std::int64_t {0}, high - 1})
			for (const std::int64_t value : {std::int64_t {0}, high / 2, high - 1})
				for (const int spread : {0, 1, 12, 24}) {
					Task t;
					t.value  = value;
					t.high   = high;
					t.guide  = guide;
					t.spread = spread;
					tasks.push_back(t);
				}
	expectInverse<kFew>(tasks);
	expectInverse<kMost>(tasks);
}

/// Twelve bits; opinion `right` says it to half a step, the others are noise.
std::vector<Task> tasksWithOneGoodOpinion(std::size_t right)
{
	Rng rng(17);
	std::vector<Task> tasks;
	for (int i = 0; i < 3000; ++i) {
		Task t;
		t.high   = 4096;
		t.value  = rng.below(4096);
		t.guide  = 2048;
		t.spread = 9;
		for (std::size_t k = 0; k < t.centre.size(); ++k) {
			t.centre[k] = 16 * std::int64_t(k == right ? t.value : rng.below(4096));
			t.scale[k]  = 8;
		}
		tasks.push_back(t);
	}
	return tasks;
}

TEST(MixedValue, LearnsWhichOpinionIsRight)
{
	for (const std::size_t right : {0u, 7u, 14u}) {
		const auto tasks  = tasksWithOneGoodOpinion(right);
		const auto stream = encoded<kMost>(tasks);
		EXPECT_LT(8 * stream.size(), 2 * tasks.size()) << "of twelve bits less than two are left";
	}
}

TEST(MixedValue, FromACutStreamIsExactUntilItIsExhaustedAndThenEnds)
{
	const auto tasks  = randomTasks(600, 3000);
	const auto values = valuesOf(tasks);
	const auto stream = encoded<kMost>(tasks);
	ASSERT_GT(stream.size(), 100u);
	std::size_t before = 0;
	for (std::size_t n = 0; n < stream.size(); n += 1 + n / 16) {
		const std::vector<std::uint8_t> cut(
		    stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(n));
		RangeDecoder decoder(cut.data(), cut.size());
		const auto out = run<kMost>(decoder, tasks); // comes back at all
		EXPECT_TRUE(decoder.exhausted()) << n;
		std::size_t right = 0;
		while (right < out.size() && out[right] == values[right])
			++right;
		EXPECT_GE(right, before) << n;
		before = right;
		for (std::size_t i = 0; i < out.size(); ++i) {
			const std::int64_t high = tasks[i].bits > 0
			                              ? tasks[i].low + (std::int64_t(1) << tasks[i].bits)
			                              : tasks[i].high;
			ASSERT_GE(out[i], tasks[i].low);
			ASSERT_LT(out[i], high);
		}
	}
}

TEST(MixedValue, FromGarbageStaysInRange)
{
	Rng rng(601);
	const auto tasks = randomTasks(602, 300);
	for (int round = 0; round < 30; ++round) {
		std::vector<std::uint8_t> garbage(2000);
		for (auto& b : garbage)
			b = static_cast<std::uint8_t>(rng.next());
		RangeDecoder decoder(garbage.data(), garbage.size());
		const auto out = run<kMost>(decoder, tasks);
		for (std::size_t i = 0; i < out.size(); ++i) {
			ASSERT_GE(out[i], tasks[i].low);
			ASSERT_LT(out[i], tasks[i].high);
		}
	}
}

TEST(Odds, AreEvenSignedAndClamped)
{
	EXPECT_EQ(oddsOf(100, 100), 0);
	EXPECT_NEAR(oddsOf(1000, 500), 256 * 0.6931, 2);
	EXPECT_NEAR(oddsOf(500, 1000), -256 * 0.6931, 2);
	EXPECT_EQ(oddsOf(~std::uint32_t {0}, 1), kStretchMax);
	EXPECT_EQ(oddsOf(1, ~std::uint32_t {0}), -kStretchMax);
}

} // namespace
} // namespace wavemesh::test
