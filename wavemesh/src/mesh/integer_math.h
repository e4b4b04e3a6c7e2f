// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Integer geometry that encoder and decoder share. No overflow for any 32-bit input: sums of
/// lattice coordinates wrap around, lengths are measured by their largest coordinate.
#pragma once

#include "mesh/corner_table.h"

namespace wavemesh {

/// a + b, a - b modulo 2^32.
inline std::int32_t wrappingAdd(std::int32_t a, std::int32_t b)
{
	return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
}
inline std::int32_t wrappingSubtract(std::int32_t a, std::int32_t b)
{
	return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
}

/// Number of binary digits: 0 for 0, 1 for 1, 3 for 4.
inline int bitLength(std::uint64_t x)
{
#if defined(__GNUC__)
	return x == 0 ? 0 : 64 - __builtin_clzll(x);
#else
	int n = 0;
	for (; x != 0; x >>= 1)
		++n;
	return n;
#endif
}

/// Number of binary digits less one. @pre x > 0
inline int leadingDigit(std::uint32_t x)
{
#if defined(__GNUC__)
	return __builtin_clz(x) ^ 31; // one instruction on x86, as a difference three
#else
	return bitLength(x) - 1;
#endif
}

/// 4 log2(x), rounded down to a multiple of one with the leading bits for a fraction; 0 for x = 0.
inline int log2Quarters(std::uint64_t x)
{
	if (x == 0)
		return 0;
	const int length        = bitLength(x);
	const std::uint64_t top = length >= 3 ? x >> (length - 3) : x << (3 - length);
	return 4 * (length - 1) + static_cast<int>(top & 3);
}

/// a + b, or the largest number.
inline std::uint64_t saturatingAdd(std::uint64_t a, std::uint64_t b)
{
	const std::uint64_t sum = a + b;
	return sum < a ? ~std::uint64_t {0} : sum;
}

/// Squared distance; coordinates may be anything: 34-bit differences are clamped to 31 bits.
inline std::uint64_t squaredDistance(const LatticePoint& a, const LatticePoint& b)
{
	std::uint64_t sum = 0;
	for (std::size_t k = 0; k < 3; ++k) {
		std::int64_t d = std::int64_t(a[k]) - b[k];
		d              = d < 0 ? -d : d;
		if (d > 0x7fffffff)
			d = 0x7fffffff;
		sum += static_cast<std::uint64_t>(d * d);
	}
	return sum;
}

} // namespace wavemesh
