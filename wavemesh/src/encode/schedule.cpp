// SPDX-License-Identifier: GPL-3.0-or-later
#include "encode/schedule.h"

#include "mesh/integer_math.h"

#include <algorithm>

namespace wavemesh {
namespace {

/// Mean length of the edges of a level, largest coordinate difference, in 1/16 lattice units.
std::uint64_t meanEdge(const CornerTable& table, const std::vector<LatticePoint>& positions)
{
	std::uint64_t sum = 0;
	for (Index c = 0; c < table.cornerCount(); ++c) {
		const LatticePoint& a = positions[table.vertex[nextCorner(c)]];
		const LatticePoint& b = positions[table.vertex[prevCorner(c)]];
		// Euclidean, by the root of the square's logarithm.
		const int quarters = log2Quarters(squaredDistance(a, b));
		sum += (std::uint64_t(4 + (quarters / 2 & 3)) << (quarters / 8)) * 4;
	}
	return table.cornerCount() == 0 ? 0 : sum / table.cornerCount();
}

int shiftFor(const CornerTable& table, const std::vector<LatticePoint>& positions, int sixteenths)
{
	const std::uint64_t cell = meanEdge(table, positions) * std::uint64_t(sixteenths) / 256;
	return cell == 0 ? 0 : bitLength(cell) - 1;
}

} // namespace

Schedule makeSchedule(const Levels& levels, int latticeBits, const ScheduleOptions& options)
{
	Schedule schedule;
	int shift = std::min(
	    shiftFor(levels.table(0), levels.positions, options.cellSixteenths), latticeBits - 1);
	schedule.baseShift = shift;
	if (levels.splits() == 0)
		schedule.baseShift = shift = 0;
	const auto sharpen = [&](int target) {
		while (shift > target) {
			const int rest = shift - target;
			const int bits =
			    target == 0 && rest <= options.lastBits ? rest : std::min(rest, options.bits);
			schedule.steps.push_back({LevelKind::Precise, bits});
			shift -= bits;
		}
	};
	for (std::size_t i = 1; i <= levels.splits(); ++i) {
		schedule.steps.push_back({LevelKind::Split, 0});
		const int target =
		    i == levels.splits()
		        ? 0
		        : shiftFor(levels.table(i), levels.positions, options.cellSixteenths);
		sharpen(target);
	}
	return schedule;
}

bool repeatsItself(const CornerTable& table, const std::vector<LatticePoint>& positions)
{
	std::uint64_t closed = 0, count = 0;
	for (Index c = 0; c < table.cornerCount(); ++c) {
		const Index d = table.opposite[c];
		if (d == kNone || d < c)
			continue;
		const LatticePoint &a = positions[table.vertex[nextCorner(c)]],
		                   &b = positions[table.vertex[prevCorner(c)]],
		                   &p = positions[table.vertex[c]], &q = positions[table.vertex[d]];
		bool closes = true;
		for (std::size_t k = 0; k < 3; ++k)
			closes = closes && std::abs((a[k] - p[k]) + (b[k] - q[k])) <= 1;
		closed += closes;
		++count;
	}
	return 4 * closed > count;
}

} // namespace wavemesh
