// SPDX-License-Identifier: GPL-3.0-or-later
#include "entropy/logistic.h"

namespace wavemesh {
namespace {

// 65536 / (1 + e^-x) for x = -8, -7.5 .. 8, kept within 16..65520.
constexpr int kKnots[33] = {22,    36,    60,    98,    162,   267,   439,   720,   1179,
                            1921,  3108,  4971,  7812,  11955, 17625, 24743, 32768, 40793,
                            47911, 53581, 57724, 60565, 62428, 63615, 64357, 64816, 65097,
                            65269, 65374, 65438, 65476, 65500, 65514};

} // namespace

constexpr LogisticTables::LogisticTables() : squash(), stretch()
{
	for (int x = -2048; x < 2048; ++x) {
		const int at = x + 2048, knot = at >> 7, part = at & 127;
		squash[static_cast<std::size_t>(at)] = static_cast<std::uint16_t>(
		    (kKnots[knot] * (128 - part) + kKnots[knot + 1] * part + 64) >> 7);
	}
	// The inverse: the first x that the middle of the interval does not exceed.
	int x = -kStretchMax;
	for (int p = 0; p < 4096; ++p) {
		while (x < kStretchMax && squash[static_cast<std::size_t>(x + 2048)] < 16 * p + 8)
			++x;
		stretch[static_cast<std::size_t>(p)] = static_cast<std::int16_t>(x);
	}
}

constexpr LogisticTables kLogistic;

} // namespace wavemesh
