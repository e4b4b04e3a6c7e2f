// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Floating point numbers, bit for bit, each next to a number that is known: their distance is
/// counted in representable numbers.
#pragma once

#include "entropy/models.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

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

template <class Coder>
class ExactSyntax
{
public:
	/// @param wide  are there numbers that are no floats?
	ExactSyntax(Coder& coder, bool wide) :
	        coder_(coder), wide_(wide), models_(std::make_unique<Models>())
	{
	}

	/// @param predicted  a number near `value`, rounded the same everywhere
	/// @param spread     by how much the value may well be away, >= 0
	/// @param channel    0..2, numbers of one kind
	double code(double predicted, double spread, std::size_t channel, double value)
	{
		if (wide_) {
			const std::int64_t from = ordinalOf(predicted);
			const std::uint64_t reach =
			    std::uint64_t(ordinalOf(predicted + spread)) - std::uint64_t(from);
			const std::uint64_t difference = codeDifference(
			    std::uint64_t(ordinalOf(value)) - std::uint64_t(from), reach, channel);
			return doubleAt(std::int64_t(std::uint64_t(from) + difference));
		}
		// Differences of 32-bit ordinals do not wrap in 64 bits.
		const std::int64_t from  = ordinalOf(nearestFloat(predicted));
		const std::int64_t reach = std::int64_t(ordinalOf(nearestFloat(predicted + spread))) - from;
		const std::int64_t to =
		    from + std::int64_t(codeDifference(
		               std::uint64_t(std::int64_t(ordinalOf(float(value))) - from),
		               std::uint64_t(reach), channel));
		return double(floatAt(std::int32_t(std::uint32_t(std::uint64_t(to)))));
	}

private:
	/// By the length of the reach: sign, length of the magnitude, and its first two bits.
	struct Row
	{
		AdaptiveBit zero, negative;
		std::array<AdaptiveBit, 65> length;
		std::array<std::array<AdaptiveBit, 4>, 65> top;
	};
	using Models = std::array<std::array<Row, 65>, 3>;

	std::uint64_t codeDifference(std::uint64_t difference, std::uint64_t reach, std::size_t channel)
	{
		Row& row = (*models_)[channel][std::size_t(bitLength(reach))];
		if (codeBit(coder_, row.zero, difference == 0))
			return 0;
		const bool negative           = codeBit(coder_, row.negative, difference >> 63 != 0);
		const std::uint64_t magnitude = negative ? ~difference : difference - 1;
		return negative ? ~codeMagnitude(row, magnitude) : codeMagnitude(row, magnitude) + 1;
	}

	std::uint64_t codeMagnitude(Row& row, std::uint64_t magnitude)
	{
		const int wanted = bitLength(magnitude);
		int length       = 0;
		while (length < 64 && codeBit(coder_, row.length[std::size_t(length)], length < wanted))
			++length;
		if (length <= 1)
			return std::uint64_t(length);
		std::uint64_t out = 1;
		for (int i = length - 2; i >= 0; --i) {
			const bool bit = (magnitude >> i) & 1;
			const int done = length - 2 - i;
			auto& top      = row.top[std::size_t(length)];
			out            = (out << 1) |
			      std::uint64_t(
			          done < 2 ? codeBit(coder_, top[std::size_t(done == 0 ? 0 : out)], bit)
			                   : coder_.bit(bit, 32768));
		}
		return out;
	}

	Coder& coder_;
	bool wide_;
	std::unique_ptr<Models> models_; ///< half a megabyte
};

} // namespace wavemesh
