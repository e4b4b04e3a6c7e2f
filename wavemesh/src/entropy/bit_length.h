// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Number of binary digits: asked for with every length and every detail.
#pragma once

#include <cstdint>

namespace wavemesh {

/// Number of binary digits of x; 0 for 0.
inline int bitLength(std::uint64_t x)
{
#if defined(__GNUC__)
	return x == 0 ? 0 : 64 - __builtin_clzll(x);
#else
	int n = 0;
	for (int half = 32; half != 0; half /= 2)
		if (x >> half != 0) {
			x >>= half;
			n += half;
		}
	return n + static_cast<int>(x);
#endif
}

} // namespace wavemesh
