// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Logarithms and powers of two in integers (docs/wmc_format.md gives their definition).
#pragma once

#include "mesh/integer_math.h"

namespace wavemesh {

struct LogarithmTables
{
	std::array<std::uint16_t, 1024> log2; ///< log2(1 + i/1024) in 1/4096, rounded down
	std::array<std::uint16_t, 8> exp2;    ///< 2^(i/8) in 1/4096, rounded down
	constexpr LogarithmTables();
};
/// There at compile time: whoever encodes before main() needs it.
extern const LogarithmTables kLogarithm;

/// log2(x) in 1/4096, from the eleven leading bits. @pre x > 0
inline std::int32_t log2Fixed(std::uint64_t x)
{
	const int length             = bitLength(x);
	const std::uint64_t mantissa = length > 11 ? x >> (length - 11) : x << (11 - length);
	return 4096 * (length - 1) + kLogarithm.log2[static_cast<std::size_t>(mantissa & 1023)];
}

/// The same; without the branch, for what is asked most. @pre x > 0
inline std::int32_t log2OfWord(std::uint32_t x)
{
	const int digit     = leadingDigit(x);
	const auto mantissa = static_cast<std::size_t>((std::uint64_t(x) << 10) >> digit) & 1023;
	return 4096 * digit + kLogarithm.log2[mantissa];
}

/// log2(x) in eighths, rounded down. @pre x > 0
inline int log2Eighths(std::uint64_t x)
{
	return log2Fixed(x) >> 9;
}

/// 2^(eighths / 8) in 1/4096. @pre -80 <= eighths <= 63
inline std::int32_t exp2Eighths(int eighths)
{
	const std::int32_t mantissa = kLogarithm.exp2[static_cast<std::size_t>(eighths & 7)];
	return (mantissa * (1 << ((eighths >> 3) + 10))) >> 10;
}

} // namespace wavemesh
