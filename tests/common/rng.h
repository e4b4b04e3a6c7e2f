// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A random generator that gives the same numbers with every standard library, which the
/// distributions of <random> do not promise.
#pragma once

#include <cstdint>

namespace wavemesh::test {

/// SplitMix64.
class Rng
{
public:
	explicit Rng(std::uint64_t seed) : state_(seed) {}

	std::uint64_t next()
	{
		std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
		z               = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
		z               = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
		return z ^ (z >> 31);
	}
	/// 0..n-1. @pre n > 0
	std::uint32_t below(std::uint32_t n)
	{
		return static_cast<std::uint32_t>(((next() >> 32) * n) >> 32);
	}
	/// [0, 1)
	double unit() { return static_cast<double>(next() >> 11) * (1.0 / 9007199254740992.0); }
	double between(double low, double high) { return low + (high - low) * unit(); }

private:
	std::uint64_t state_;
};

} // namespace wavemesh::test
