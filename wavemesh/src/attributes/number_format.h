// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Floating point numbers as integers: their places among all others, and decimal fractions.
#pragma once

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace wavemesh {

static_assert(
    FLT_EVAL_METHOD == 0 && std::numeric_limits<double>::is_iec559 &&
        std::numeric_limits<float>::is_iec559,
    "a decoder predicts numbers as the encoder did: every operation rounds to its own type");

/// The place of x among all doubles, in ascending order; 0 for +0, -1 for -0. Any bit pattern.
inline std::int64_t ordinalOf(double x)
{
	std::int64_t i;
	std::memcpy(&i, &x, sizeof i);
	return i < 0 ? i ^ 0x7fffffffffffffff : i;
}
inline double doubleAt(std::int64_t ordinal)
{
	const std::int64_t i = ordinal < 0 ? ordinal ^ 0x7fffffffffffffff : ordinal;
	double x;
	std::memcpy(&x, &i, sizeof x);
	return x;
}
/// The same among floats.
inline std::int32_t ordinalOf(float x)
{
	std::int32_t i;
	std::memcpy(&i, &x, sizeof i);
	return i < 0 ? i ^ 0x7fffffff : i;
}
inline float floatAt(std::int32_t ordinal)
{
	const std::int32_t i = ordinal < 0 ? ordinal ^ 0x7fffffff : ordinal;
	float x;
	std::memcpy(&x, &i, sizeof x);
	return x;
}

/// The nearest float; the largest for what is beyond it.
inline float nearestFloat(double x)
{
	constexpr double kLargest = double(std::numeric_limits<float>::max());
	if (std::isfinite(x))
		x = std::clamp(x, -kLargest, kLargest);
	return float(x);
}

/// Is x, bit for bit, what the float of its value widens to?
inline bool isFloat(double x)
{
	return ordinalOf(double(nearestFloat(x))) == ordinalOf(x);
}

/// How numbers are written down: `wide` if some are no floats, and the decimal fraction that most
/// of them are the nearest number to, as they are where they were text once.
struct NumberFormat
{
	bool wide  = false;
	int digits = kNone; ///< behind the decimal point, 0..14, or kNone

	static constexpr int kNone = -1;
	static constexpr int kMost = 14;
};

inline double powerOfTen(int n)
{
	double x = 1;
	for (; n > 0; --n)
		x *= 10;
	return x; // exact up to 10^22
}

/// The number that is `count` times 10^-digits.
inline double decimalNumber(std::int64_t count, const NumberFormat& format)
{
	const double x = double(count) / powerOfTen(format.digits);
	return format.wide ? x : double(nearestFloat(x));
}

/// x in units of `unit` times 10^-digits, to the nearest; within +-2^53.
inline std::int64_t decimalCount(double x, int digits, double unit)
{
	constexpr double kLargest = 9007199254740992.0;
	if (!std::isfinite(x))
		return 0;
	return std::int64_t(
	    std::clamp(std::floor(x * powerOfTen(digits) / unit + 0.5), -kLargest, kLargest));
}

/// Is x the number nearest to a decimal fraction, bit for bit?
inline bool isDecimal(double x, const NumberFormat& format)
{
	return ordinalOf(decimalNumber(decimalCount(x, format.digits, 1), format)) == ordinalOf(x);
}

/// The format that takes the fewest bits where numbers are known up to `spread`.
NumberFormat formatOf(const std::vector<std::array<double, 3>>& numbers, double spread);

} // namespace wavemesh
