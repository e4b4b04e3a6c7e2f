// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The logistic function and its inverse in integers (docs/wmc_format.md gives the tables).
#pragma once

#include "entropy/range_coder.h"

#include <array>

namespace wavemesh {

/// Logistic domain: ln(p / (1 - p)) in 1/256, -2047..2047.
constexpr int kStretchMax = 2047;

struct LogisticTables
{
	std::array<std::uint16_t, 4096> squash; ///< by x + 2048, 1/65536, 16..65520
	std::array<std::int16_t, 4096> stretch; ///< by p / 16
	constexpr LogisticTables();
};
/// There at compile time: whoever encodes before main() needs it.
extern const LogisticTables kLogistic;

inline Probability squash(int x)
{
	x = x > kStretchMax ? kStretchMax : x < -kStretchMax ? -kStretchMax : x;
	return kLogistic.squash[static_cast<std::size_t>(x + 2048)];
}
inline int stretch(Probability p)
{
	return kLogistic.stretch[p >> 4];
}

} // namespace wavemesh
