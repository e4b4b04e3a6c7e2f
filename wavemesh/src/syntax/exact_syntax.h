// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Floating point numbers, bit for bit, each next to a number that is known: their distance is
/// counted in representable numbers.
#pragma once

#include "attributes/number_format.h"
#include "entropy/models.h"

#include <memory>

namespace wavemesh {

class ExactSyntax
{
public:
	/// @param channels  kinds of numbers
	ExactSyntax(const NumberFormat& format, std::size_t channels) :
	        format_(format), models_(channels)
	{
	}

	/// @param predicted  a number near `value`, rounded the same everywhere
	/// @param spread     by how much the value may well be away, >= 0
	/// @param channel    below `channels`, numbers of one kind
	template <class Coder>
	double code(Coder& coder, double predicted, double spread, std::size_t channel, double value)
	{
		if (format_.digits != NumberFormat::kNone) {
			bool decimal = false;
			if constexpr (!Coder::kReading)
				decimal = isDecimal(value, format_);
			if (codeBit(coder, models_[channel].decimal, decimal))
				return codeDecimal(coder, predicted, spread, channel, value);
		}
		if (format_.wide) {
			const std::int64_t from = ordinalOf(predicted);
			const std::uint64_t reach =
			    std::uint64_t(ordinalOf(predicted + spread)) - std::uint64_t(from);
			const std::uint64_t difference = codeDifference(
			    coder, std::uint64_t(ordinalOf(value)) - std::uint64_t(from), reach,
			    models_[channel].binary);
			return doubleAt(std::int64_t(std::uint64_t(from) + difference));
		}
		// Differences of 32-bit ordinals do not wrap in 64 bits.
		const std::int64_t from  = ordinalOf(nearestFloat(predicted));
		const std::int64_t reach = std::int64_t(ordinalOf(nearestFloat(predicted + spread))) - from;
		const std::int64_t to =
		    from + std::int64_t(codeDifference(
		               coder, std::uint64_t(std::int64_t(ordinalOf(nearestFloat(value))) - from),
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
		std::array<std::unique_ptr<Row>, 65> row; ///< most lengths never occur
		std::array<std::array<AdaptiveBit, 4>, 5> top;
	};
	struct Models
	{
		Rows binary, decimals;
		AdaptiveBit decimal;
		std::array<std::array<AdaptiveBit, kZeros>, 65> hasZero; ///< by the prediction's length
	};

	/// The last digits are often zero, for large numbers written with as many digits as small ones.
	template <class Coder>
	double
	codeDecimal(Coder& coder, double predicted, double spread, std::size_t channel, double value)
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
			if (!codeBit(coder, hasZero[i], count % (unit * 10) == 0))
				break;
			unit *= 10;
		}
		const std::int64_t from  = decimalCount(predicted, format_.digits, double(unit));
		const std::int64_t reach = decimalCount(spread, format_.digits, double(unit));
		const std::uint64_t n =
		    std::uint64_t(from) + codeDifference(
		                              coder, std::uint64_t(count / unit) - std::uint64_t(from),
		                              std::uint64_t(reach), models_[channel].decimals);
		return decimalNumber(std::int64_t(n * std::uint64_t(unit)), format_);
	}

	template <class Coder>
	std::uint64_t
	codeDifference(Coder& coder, std::uint64_t difference, std::uint64_t reach, Rows& rows)
	{
		const int length = bitLength(reach);
		auto& place      = rows.row[std::size_t(length)];
		if (!place)
			place = std::make_unique<Rows::Row>();
		auto& row = *place;
		if (codeBit(coder, row.zero, difference == 0))
			return 0;
		const bool negative     = codeBit(coder, row.negative, difference >> 63 != 0);
		std::uint64_t magnitude = negative ? ~difference : difference - 1;
		const int wanted        = bitLength(magnitude);
		int n                   = 0;
		while (n < 64 && codeBit(coder, row.length[std::size_t(n)], n < wanted))
			++n;
		magnitude = codeDigits(
		    coder, n, magnitude, rows.top[std::size_t(std::clamp(length - n + 2, 0, 4))]);
		return negative ? ~magnitude : magnitude + 1;
	}

	/// A number of n binary digits.
	template <class Coder>
	std::uint64_t
	codeDigits(Coder& coder, int n, std::uint64_t value, std::array<AdaptiveBit, 4>& top)
	{
		if (n <= 1)
			return std::uint64_t(n);
		std::uint64_t out = 1;
		for (int i = n - 2; i >= 0; --i) {
			const bool bit = (value >> i) & 1;
			const int done = n - 2 - i;
			out            = (out << 1) |
			      std::uint64_t(
			          done < 2 ? codeBit(coder, top[std::size_t(done == 0 ? 0 : out)], bit)
			                   : coder.bit(bit, 32768));
		}
		return out;
	}

	NumberFormat format_;
	std::vector<Models> models_; ///< by channel; 3 kB each, and 18 more at most
};

} // namespace wavemesh
