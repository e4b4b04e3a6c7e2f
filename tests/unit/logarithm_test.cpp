// SPDX-License-Identifier: GPL-3.0-or-later
// Logarithms and powers of two, against their definitions in exact integers.
#include "entropy/logarithm.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace wavemesh::test {
namespace {

/// A number of any length, lowest digit first.
using Digits = std::vector<std::uint32_t>;

Digits product(const Digits& a, const Digits& b)
{
	Digits out(a.size() + b.size(), 0);
	for (std::size_t i = 0; i < a.size(); ++i) {
		std::uint64_t carry = 0;
		for (std::size_t k = 0; k < b.size(); ++k) {
			carry += std::uint64_t(a[i]) * b[k] + out[i + k];
			out[i + k] = static_cast<std::uint32_t>(carry);
			carry >>= 32;
		}
		out[i + b.size()] = static_cast<std::uint32_t>(carry);
	}
	while (!out.empty() && out.back() == 0)
		out.pop_back();
	return out;
}

int lengthOf(const Digits& a)
{
	return a.empty() ? 0 : 32 * static_cast<int>(a.size() - 1) + bitLength(a.back());
}

/// floor(4096 log2(x)): one less than the number of binary digits of x^4096.
int exactLog2(std::uint32_t x)
{
	Digits power {x};
	for (int i = 0; i < 12; ++i)
		power = product(power, power);
	return lengthOf(power) - 1;
}

TEST(Logarithm, TableIsTheLogarithmRoundedDown)
{
	for (std::uint32_t i = 0; i < 1024; i += i < 16 || i > 1000 ? 1 : 37)
		EXPECT_EQ(int(kLogarithm.log2[i]), exactLog2(1024 + i) - 10 * 4096) << i;
}

TEST(Logarithm, WholeTableIsWithinOneOfTheRealOne)
{
	for (std::size_t i = 0; i < 1024; ++i) {
		const double real = 4096 * std::log2(1 + double(i) / 1024);
		EXPECT_LE(kLogarithm.log2[i], real + 1e-9) << i;
		EXPECT_GT(kLogarithm.log2[i], real - 1 - 1e-9) << i;
	}
}

TEST(Logarithm, OfAPowerOfTwoIsExact)
{
	for (int i = 0; i < 64; ++i) {
		EXPECT_EQ(log2Fixed(std::uint64_t(1) << i), 4096 * i);
		EXPECT_EQ(log2Eighths(std::uint64_t(1) << i), 8 * i);
	}
}

TEST(Logarithm, NeverFalls)
{
	std::int32_t before = 0;
	for (std::uint64_t x = 1; x < 100000; ++x) {
		ASSERT_GE(log2Fixed(x), before) << x;
		before = log2Fixed(x);
	}
	before = 0;
	for (std::uint64_t x = 100000; x < std::numeric_limits<std::uint64_t>::max() / 17 * 16;
	     x += x / 16) {
		ASSERT_GT(log2Fixed(x), before) << x;
		before = log2Fixed(x);
	}
	EXPECT_EQ(log2Fixed(~std::uint64_t {0}), 63 * 4096 + kLogarithm.log2[1023]);
}

TEST(Logarithm, LooksAtElevenDigitsOnly)
{
	for (std::uint64_t mantissa = 1024; mantissa < 2048; mantissa += 11)
		for (const int shift : {1, 10, 30, 53}) {
			const std::uint64_t low = mantissa << shift;
			EXPECT_EQ(log2Fixed(low), log2Fixed(low + ((std::uint64_t(1) << shift) - 1)));
			EXPECT_EQ(log2Fixed(low), log2Fixed(mantissa) + 4096 * shift);
		}
}

TEST(Logarithm, Exp2TableIsThePowerRoundedDown)
{
	// 2^(i/8) >= m / 4096 exactly if 2^(i + 96) >= m^8.
	const auto isReached = [](std::uint32_t m, int i) {
		Digits power {m};
		for (int k = 0; k < 3; ++k)
			power = product(power, power);
		return lengthOf(power) - 1 < i + 96 || (m == 4096 && i == 0);
	};
	for (int i = 0; i < 8; ++i) {
		const std::uint32_t m = kLogarithm.exp2[std::size_t(i)];
		EXPECT_TRUE(isReached(m, i)) << i;
		EXPECT_FALSE(isReached(m + 1, i)) << i;
	}
}

TEST(Logarithm, Exp2GrowsAndDoublesWithEveryOctave)
{
	EXPECT_EQ(exp2Eighths(0), 4096);
	EXPECT_EQ(exp2Eighths(-80), 4);
	EXPECT_EQ(exp2Eighths(56), 4096 << 7);
	for (int i = -79; i <= 63; ++i)
		EXPECT_GE(exp2Eighths(i), exp2Eighths(i - 1)) << i;
	for (int i = 0; i <= 55; ++i)
		EXPECT_EQ(exp2Eighths(i + 8), 2 * exp2Eighths(i)) << i;
	for (int i = -80; i < 0; ++i)
		EXPECT_EQ(exp2Eighths(i), exp2Eighths(i + 8) / 2) << i;
}

} // namespace
} // namespace wavemesh::test
