// SPDX-License-Identifier: GPL-3.0-or-later
#include "encode/schedule.h"

#include "encode/level_errors.h"
#include "mesh/integer_math.h"

#include <algorithm>
#include <cmath>

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

bool endsRegular(const Levels& levels)
{
	const std::size_t n = levels.splits();
	return n > 0 && isRegularSplit(levels.table(n - 1).vertexCount, levels.table(n).vertexCount);
}

/// Share of the inner edges whose two faces make a parallelogram, up to rounding.
double closedParallelograms(const CornerTable& table, const std::vector<LatticePoint>& positions)
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
	return count == 0 ? 0 : double(closed) / double(count);
}

/// e^-x for x >= 0, of operations that round the same everywhere, which std::exp() need not: the
/// same mesh gives the same file.
double decay(double x)
{
	constexpr int kHalvings = 12;
	const double part       = std::min(x, 64.) / (1 << kHalvings);
	double result           = 1 - part * (1 - part / 2 * (1 - part / 3));
	for (int i = 0; i < kHalvings; ++i)
		result *= result;
	return result;
}

/// How many different values the coordinates have, as a share of how many random ones would.
double differentValues(const std::vector<LatticePoint>& positions)
{
	double values = 0, expected = 0;
	std::vector<std::int32_t> axis(positions.size());
	for (std::size_t k = 0; k < 3 && !positions.empty(); ++k) {
		std::transform(
		    positions.begin(), positions.end(), axis.begin(),
		    [k](const LatticePoint& p) { return p[k]; });
		std::sort(axis.begin(), axis.end());
		const double range = double(axis.back()) - axis.front() + 1;
		values += double(std::unique(axis.begin(), axis.end()) - axis.begin());
		expected += range * (1 - decay(double(positions.size()) / range));
	}
	return positions.empty() ? 1 : values / expected;
}

} // namespace

Schedule makeSchedule(const Levels& levels, int latticeBits, const ScheduleOptions& options)
{
	Schedule schedule;
	const bool regular      = options.regularErrors > 0 && endsRegular(levels);
	const double cellErrors = regular ? options.regularErrors : options.cellErrors;
	const double lastErrors = regular ? options.regularErrors : options.lastSplitErrors;
	const std::vector<double> errors =
	    cellErrors > 0 || lastErrors > 0 ? levelErrors(levels) : std::vector<double>();
	const auto shiftOf = [&](std::size_t i) {
		const bool last    = i + 1 >= levels.splits();
		const int width    = last ? options.lastSplitSixteenths : options.cellSixteenths;
		const double bound = last ? lastErrors : cellErrors;
		int most           = latticeBits - 1;
		if (bound > 0)
			for (most = 0; most < latticeBits - 1 && double(2u << most) <= bound * errors[i];)
				++most;
		return std::min(most, shiftFor(levels.table(i), levels.positions, width));
	};
	int shift          = shiftOf(0);
	schedule.baseShift = shift;
	if (levels.splits() == 0)
		schedule.baseShift = shift = 0;
	const auto sharpen = [&](int target, bool last) {
		while (shift > target) {
			const int rest = shift - target;
			const int bits = last && rest <= options.lastBits ? rest : std::min(rest, options.bits);
			schedule.steps.push_back({LevelKind::Precise, bits});
			shift -= bits;
		}
	};
	for (std::size_t i = 1; i <= levels.splits(); ++i) {
		schedule.steps.push_back({LevelKind::Split, 0});
		const bool last = i == levels.splits();
		sharpen(last ? 0 : shiftOf(i), last);
	}
	return schedule;
}

bool repeatsItself(const CornerTable& table, const std::vector<LatticePoint>& positions)
{
	// By chance edges close to parallelograms the more rarely the longer they are.
	return closedParallelograms(table, positions) * double(meanEdge(table, positions)) / 16 > 2 ||
	       differentValues(positions) < 0.75;
}

} // namespace wavemesh
