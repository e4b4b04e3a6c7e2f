// SPDX-License-Identifier: GPL-3.0-or-later
// Range coder, adaptive models, integers and mixing.
#include "entropy/models.h"
#include "rng.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

namespace wavemesh::test {
namespace {

struct Bit
{
	bool value;
	Probability p; ///< of a 1
};

/// Random bits with probabilities that are right, wrong or extreme.
std::vector<Bit> randomBits(std::size_t count, std::uint64_t seed, int style)
{
	Rng rng(seed);
	std::vector<Bit> bits;
	for (std::size_t i = 0; i < count; ++i) {
		Probability p = 1 + rng.below(65535);
		if (style == 1) // extremely skewed, and nearly always right
			p = rng.below(2) ? 1 : 65535;
		else if (style == 2) // always the least likely
			p = rng.below(2) ? 1 : 65535;
		bool value = rng.below(65536) < p;
		if (style == 1)
			value = rng.below(1000) == 0 ? p == 1 : p != 1;
		else if (style == 2)
			value = p == 1;
		bits.push_back({value, p});
	}
	return bits;
}

std::vector<std::uint8_t> encodeBits(const std::vector<Bit>& bits)
{
	RangeEncoder coder;
	for (const Bit& b : bits)
		coder.bit(b.value, b.p);
	return coder.finish();
}

class RangeCoder : public testing::TestWithParam<int>
{
};

TEST_P(RangeCoder, GivesBackEveryBit)
{
	for (std::uint64_t seed = 0; seed < 50; ++seed) {
		const auto bits   = randomBits(1 + seed * 37, seed, GetParam());
		const auto stream = encodeBits(bits);
		RangeDecoder decoder(stream.data(), stream.size());
		for (std::size_t i = 0; i < bits.size(); ++i) {
			ASSERT_EQ(decoder.bit(false, bits[i].p), bits[i].value) << seed << ' ' << i;
			ASSERT_FALSE(decoder.exhausted());
		}
	}
}

TEST_P(RangeCoder, OfEveryPrefix_GivesTrueBitsUntilItSaysExhausted)
{
	for (std::uint64_t seed = 100; seed < 110; ++seed) {
		const auto bits     = randomBits(GetParam() == 1 ? 6000 : 300, seed, GetParam());
		const auto stream   = encodeBits(bits);
		std::size_t longest = 0;
		for (std::size_t n = 0; n < stream.size(); ++n) {
			const std::vector<std::uint8_t> prefix(
			    stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(n));
			RangeDecoder decoder(prefix.data(), prefix.size());
			std::size_t good = 0;
			for (const Bit& b : bits) {
				const bool value = decoder.bit(true, b.p);
				if (decoder.exhausted())
					break;
				ASSERT_EQ(value, b.value) << seed << ' ' << n << ' ' << good;
				++good;
			}
			ASSERT_TRUE(decoder.exhausted()) << "finish() wrote more than needed";
			ASSERT_FALSE(decoder.bit(true, 65535));
			ASSERT_TRUE(decoder.exhausted()) << "must stay exhausted";
			ASSERT_GE(good, longest);
			longest = good;
		}
	}
}

/// Does this prefix determine the first `count` bits, whatever follows? The extremes tell: the
/// coder is monotone in its data.
bool determines(std::vector<std::uint8_t> prefix, const std::vector<Bit>& bits, std::size_t count)
{
	for (const std::uint8_t fill : {std::uint8_t {0}, std::uint8_t {255}}) {
		auto data = prefix;
		data.resize(prefix.size() + 8, fill);
		RangeDecoder decoder(data.data(), data.size());
		for (std::size_t i = 0; i < count; ++i)
			if (decoder.bit(false, bits[i].p) != bits[i].value || decoder.exhausted())
				return false;
	}
	return true;
}

TEST_P(RangeCoder, Prefix_IsTheShortestThatDeterminesTheBitsBeforeTheMark)
{
	for (std::uint64_t seed = 200; seed < 210; ++seed) {
		const auto bits = randomBits(GetParam() == 1 ? 3000 : 150, seed, GetParam());
		RangeEncoder coder;
		std::vector<RangeEncoder::Mark> marks;
		for (const Bit& b : bits) {
			marks.push_back(coder.mark());
			coder.bit(b.value, b.p);
		}
		marks.push_back(coder.mark());
		const auto stream = coder.finish();
		for (std::size_t i = 0; i < marks.size(); i += GetParam() == 1 ? 13 : 1) {
			const std::size_t n = RangeEncoder::prefix(stream, marks[i]);
			ASSERT_LE(n, stream.size());
			const auto end = stream.begin() + static_cast<std::ptrdiff_t>(n);
			ASSERT_TRUE(determines({stream.begin(), end}, bits, i)) << seed << ' ' << i;
			if (n > 0) {
				ASSERT_FALSE(determines({stream.begin(), end - 1}, bits, i)) << seed << ' ' << i;
			}
		}
		EXPECT_EQ(RangeEncoder::prefix(stream, marks.back()), stream.size());
	}
}

INSTANTIATE_TEST_SUITE_P(Entropy, RangeCoder, testing::Values(0, 1, 2), [](const auto& style) {
	return std::string(
	    style.param == 0   ? "random"
	    : style.param == 1 ? "skewed"
	                       : "always_unlikely");
});

TEST(RangeEncoder, FinishOfNothing_IsNothing)
{
	EXPECT_TRUE(RangeEncoder().finish().empty());
}

TEST(RangeEncoder, Finish_StartsANewStream)
{
	RangeEncoder coder;
	const auto code = [&] {
		for (int i = 0; i < 100; ++i)
			coder.bit(i % 3 == 0, 20000);
		return coder.finish();
	};
	const auto first = code();
	EXPECT_EQ(code(), first);
}

TEST(RangeEncoder, CodeLength_IsCloseToTheEntropy)
{
	Rng rng(300);
	RangeEncoder coder;
	constexpr int kCount = 80000;
	for (int i = 0; i < kCount; ++i)
		coder.bit(rng.below(65536) < 6554, 6554); // 0.1: 0.469 bits each
	const double bits = 8.0 * static_cast<double>(coder.finish().size());
	EXPECT_NEAR(bits / kCount, 0.469, 0.01);
}

TEST(AdaptiveBit, StaysWithinItsRangeAndFollowsTheBits)
{
	AdaptiveBit model;
	EXPECT_EQ(model.p(), 32768u);
	for (bool bit : {true, false}) {
		for (int i = 0; i < 100000; ++i) {
			model.update(bit, 255);
			ASSERT_GE(model.p(), 1u);
			ASSERT_LE(model.p(), 65535u);
			ASSERT_LE(model.age(), 255);
		}
		EXPECT_TRUE(bit ? model.p() > 65000 : model.p() < 500) << model.p();
	}
}

TEST(AdaptiveBit, LearnsAFrequency)
{
	Rng rng(301);
	AdaptiveBit model;
	double sum = 0;
	for (int i = 0; i < 20000; ++i) {
		model.update(rng.below(10) < 3, 255);
		if (i >= 1000)
			sum += static_cast<double>(model.p());
	}
	EXPECT_NEAR(sum / 19000 / 65536, 0.3, 0.02);
}

TEST(Integers, RawBits_ComeBack)
{
	Rng rng(302);
	RangeEncoder coder;
	std::vector<std::pair<int, std::uint32_t>> all;
	for (int i = 0; i < 2000; ++i) {
		const int bits = static_cast<int>(rng.below(33));
		const auto x   = static_cast<std::uint32_t>(bits == 0 ? 0 : rng.next() >> (64 - bits));
		all.push_back({bits, x});
		codeRaw(coder, bits, x);
	}
	const auto stream = coder.finish();
	RangeDecoder decoder(stream.data(), stream.size());
	for (const auto& [bits, x] : all)
		ASSERT_EQ(codeRaw(decoder, bits, 0), x);
	EXPECT_FALSE(decoder.exhausted());
}

template <class Model>
void expectBack(const std::vector<std::int64_t>& values)
{
	RangeEncoder coder;
	Model writer, reader;
	for (std::int64_t x : values)
		writer.code(coder, static_cast<decltype(writer.code(coder, 0))>(x));
	const auto stream = coder.finish();
	RangeDecoder decoder(stream.data(), stream.size());
	for (std::int64_t x : values)
		ASSERT_EQ(static_cast<std::int64_t>(reader.code(decoder, 0)), x);
	ASSERT_FALSE(decoder.exhausted());
}

/// Extremes, all small numbers, and random ones of every length.
std::vector<std::int64_t> interestingIntegers(int bits, bool negative)
{
	const std::int64_t most = (std::int64_t {1} << bits) - 1;
	std::vector<std::int64_t> values {0, most, most - 1, 1, most / 2, most / 2 + 1};
	for (int i = 0; i < 300; ++i)
		values.push_back(i <= most ? i : most);
	Rng rng(303);
	for (int i = 0; i < 3000; ++i)
		values.push_back(static_cast<std::int64_t>(
		    rng.next() >> (64 - 1 - rng.below(static_cast<std::uint32_t>(bits)))));
	if (negative)
		for (std::size_t i = 0; i < values.size(); i += 2)
			values[i] = -values[i];
	return values;
}

TEST(Integers, UnsignedAndSigned_ComeBackUpToTheirLargest)
{
	expectBack<AdaptiveUnsigned<32>>(interestingIntegers(32, false));
	expectBack<AdaptiveUnsigned<9>>(interestingIntegers(9, false));
	expectBack<AdaptiveUnsigned<1>>({0, 1, 1, 0, 0, 1});
	expectBack<AdaptiveSigned<32>>(interestingIntegers(32, true));
	expectBack<AdaptiveSigned<31>>(interestingIntegers(31, true));
	expectBack<AdaptiveSigned<9>>(interestingIntegers(9, true));
}

TEST(Integers, BitLength_IsTheNumberOfBits)
{
	EXPECT_EQ(bitLength(0), 0);
	for (int n = 0; n < 64; ++n) {
		EXPECT_EQ(bitLength(std::uint64_t {1} << n), n + 1);
		EXPECT_EQ(bitLength((std::uint64_t {1} << n) - 1), n);
	}
}

TEST(Logistic, StretchUndoesSquashAndBothAreMonotone)
{
	int before = -1;
	for (int x = -2047; x <= 2047; ++x) {
		const Probability p = squash(x);
		EXPECT_GE(static_cast<int>(p), before);
		EXPECT_GE(p, 1u);
		EXPECT_LE(p, 65535u);
		before = static_cast<int>(p);
		if (x > -1500 && x < 1500) {
			EXPECT_NEAR(stretch(p), x, 1 + 256 * 17.0 * 65536 / p / (65536 - p)) << x;
		}
	}
	EXPECT_EQ(squash(0), 32768u);
	EXPECT_EQ(squash(100000), squash(2047));
	EXPECT_EQ(squash(-100000), squash(-2047));
	for (Probability p = 16; p < 65536; p += 16)
		EXPECT_GE(stretch(p), stretch(p - 16));
}

TEST(Mixer, GivesBackEveryBitAndLearnsWhichModelToTrust)
{
	Rng rng(304);
	std::vector<bool> bits;
	for (int i = 0; i < 20000; ++i)
		bits.push_back(
		    i % 2 ? bits.back() : rng.below(2) == 1); // every second repeats the one before
	const auto run = [&](auto& coder) {
		Mixer<2> mixer(2);
		AdaptiveBit alone, afterZero, afterOne;
		bool last = false;
		std::vector<bool> out;
		for (std::size_t i = 0; i < bits.size(); ++i) {
			const int set = static_cast<int>(i % 2);
			AdaptiveBit dummy;
			AdaptiveBit& known = set == 0 ? dummy : last ? afterOne : afterZero;
			last               = mixer.code(coder, {&alone, &known}, set, bits[i], 255);
			out.push_back(last);
		}
		return out;
	};
	RangeEncoder encoder;
	run(encoder);
	const auto stream = encoder.finish();
	EXPECT_LT(8 * stream.size(), bits.size() / 2 + bits.size() / 25) << "one bit of two is free";
	RangeDecoder decoder(stream.data(), stream.size());
	EXPECT_EQ(run(decoder), bits);
	EXPECT_FALSE(decoder.exhausted());
}

} // namespace
} // namespace wavemesh::test
