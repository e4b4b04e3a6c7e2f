// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Floating point numbers, bit for bit, each next to a number that is known: their distance is
/// counted in representable numbers.
#pragma once

#include "entropy/models.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace wavemesh {

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

template <class Coder>
class ExactSyntax
{
public:
	/// @param channels  kinds of numbers
	ExactSyntax(Coder& coder, const NumberFormat& format, std::size_t channels) :
	        coder_(coder), format_(format), models_(channels)
	{
		format_.wide   = codeRaw(coder_, 1, format.wide) != 0;
		format_.digits = int(codeRaw(coder_, 4, std::uint32_t(format.digits + 1))) - 1;
	}

	/// @param predicted  a number near `value`, rounded the same everywhere
	/// @param spread     by how much the value may well be away, >= 0
	/// @param channel    below `channels`, numbers of one kind
	double code(double predicted, double spread, std::size_t channel, double value)
	{
		if (format_.digits != NumberFormat::kNone) {
			bool decimal = false;
			if constexpr (!Coder::kReading)
				decimal = isDecimal(value, format_);
			if (codeBit(coder_, models_[channel].decimal, decimal))
				return codeDecimal(predicted, spread, channel, value);
		}
		if (format_.wide) {
			const std::int64_t from = ordinalOf(predicted);
			const std::uint64_t reach =
			    std::uint64_t(ordinalOf(predicted + spread)) - std::uint64_t(from);
			const std::uint64_t difference = codeDifference(
			    std::uint64_t(ordinalOf(value)) - std::uint64_t(from), reach,
			    models_[channel].binary);
			return doubleAt(std::int64_t(std::uint64_t(from) + difference));
		}
		// Differences of 32-bit ordinals do not wrap in 64 bits.
		const std::int64_t from  = ordinalOf(nearestFloat(predicted));
		const std::int64_t reach = std::int64_t(ordinalOf(nearestFloat(predicted + spread))) - from;
		const std::int64_t to =
		    from + std::int64_t(codeDifference(
		               std::uint64_t(std::int64_t(ordinalOf(nearestFloat(value))) - from),
		               std::uint64_t(reach), models_[channel].binary));
		return double(floatAt(std::int32_t(std::uint32_t(std::uint64_t(to)))));
	}

private:
	static constexpr int kZeros = 4;

	/// By the length of the reach: sign and length of the magnitude; by how these differ, its first
	/// two bits.
	struct Rows
	{
		struct Row
		{
			AdaptiveBit zero, negative;
			std::array<AdaptiveBit, 64> length;
		};
		std::array<Row, 65> row;
		std::array<std::array<AdaptiveBit, 4>, 5> top;
	};
	struct Models
	{
		Rows binary, decimals;
		AdaptiveBit decimal;
		std::array<std::array<AdaptiveBit, kZeros>, 65> hasZero; ///< by the prediction's length
	};

	/// The last digits are often zero, for large numbers written with as many digits as small ones.
	double codeDecimal(double predicted, double spread, std::size_t channel, double value)
	{
		const auto lengthOf = [](std::int64_t x) {
			return std::size_t(bitLength(std::uint64_t(x < 0 ? -x : x)));
		};
		std::int64_t count = 0;
		if constexpr (!Coder::kReading)
			count = decimalCount(value, format_.digits, 1);
		auto& hasZero =
		    models_[channel].hasZero[lengthOf(decimalCount(predicted, format_.digits, 1))];
		std::int64_t unit = 1;
		for (std::size_t i = 0; i < kZeros && format_.digits > 0; ++i) {
			if (!codeBit(coder_, hasZero[i], count % (unit * 10) == 0))
				break;
			unit *= 10;
		}
		const std::int64_t from  = decimalCount(predicted, format_.digits, double(unit));
		const std::int64_t reach = decimalCount(spread, format_.digits, double(unit));
		const std::uint64_t n =
		    std::uint64_t(from) + codeDifference(
		                              std::uint64_t(count / unit) - std::uint64_t(from),
		                              std::uint64_t(reach), models_[channel].decimals);
		return decimalNumber(std::int64_t(n * std::uint64_t(unit)), format_);
	}

	std::uint64_t codeDifference(std::uint64_t difference, std::uint64_t reach, Rows& rows)
	{
		const int length = bitLength(reach);
		auto& row        = rows.row[std::size_t(length)];
		if (codeBit(coder_, row.zero, difference == 0))
			return 0;
		const bool negative     = codeBit(coder_, row.negative, difference >> 63 != 0);
		std::uint64_t magnitude = negative ? ~difference : difference - 1;
		const int wanted        = bitLength(magnitude);
		int n                   = 0;
		while (n < 64 && codeBit(coder_, row.length[std::size_t(n)], n < wanted))
			++n;
		magnitude =
		    codeDigits(n, magnitude, rows.top[std::size_t(std::clamp(length - n + 2, 0, 4))]);
		return negative ? ~magnitude : magnitude + 1;
	}

	/// A number of n binary digits.
	std::uint64_t codeDigits(int n, std::uint64_t value, std::array<AdaptiveBit, 4>& top)
	{
		if (n <= 1)
			return std::uint64_t(n);
		std::uint64_t out = 1;
		for (int i = n - 2; i >= 0; --i) {
			const bool bit = (value >> i) & 1;
			const int done = n - 2 - i;
			out            = (out << 1) |
			      std::uint64_t(
			          done < 2 ? codeBit(coder_, top[std::size_t(done == 0 ? 0 : out)], bit)
			                   : coder_.bit(bit, 32768));
		}
		return out;
	}

	Coder& coder_;
	NumberFormat format_;
	std::vector<Models> models_; ///< by channel; 40 kB each
};

} // namespace wavemesh
