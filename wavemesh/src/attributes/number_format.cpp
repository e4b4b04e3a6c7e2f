// SPDX-License-Identifier: GPL-3.0-or-later
#include "attributes/number_format.h"

#include "mesh/integer_math.h"

namespace wavemesh {

NumberFormat formatOf(const std::vector<std::array<double, 3>>& numbers, double spread)
{
	NumberFormat format;
	double binary = 0; // bits, about
	for (const auto& row : numbers)
		for (const double x : row)
			format.wide = format.wide || !isFloat(x);
	const auto binaryBits = [&](double x) {
		if (!std::isfinite(x))
			return 64;
		return format.wide
		           ? bitLength(std::uint64_t(ordinalOf(x + spread)) - std::uint64_t(ordinalOf(x)))
		           : bitLength(std::uint64_t(
		                 std::int64_t(ordinalOf(nearestFloat(x + spread))) -
		                 ordinalOf(nearestFloat(x))));
	};
	for (const auto& row : numbers)
		for (const double x : row)
			binary += binaryBits(x);
	double least = binary;
	for (int digits = 0; digits <= NumberFormat::kMost; ++digits) {
		const NumberFormat decimal {format.wide, digits};
		const int each = 1 + bitLength(std::uint64_t(decimalCount(spread, digits, 1)));
		double bits    = 0;
		for (std::size_t i = 0; i < numbers.size() && bits < least; ++i)
			for (const double x : numbers[i])
				bits += isDecimal(x, decimal) ? each : 7 + binaryBits(x);
		if (bits < least) {
			least         = bits;
			format.digits = digits;
		}
	}
	return format;
}

} // namespace wavemesh
