// SPDX-License-Identifier: GPL-3.0-or-later
#include "encode/ways.h"

#include <algorithm>
#include <utility>

namespace wavemesh {
namespace {

constexpr std::size_t kSmall = 4096;  ///< vertices; their time is nothing
constexpr std::size_t kLarge = 16384; ///< vertices; here speed counts

/// How narrow the cells of the levels are: members of ScheduleOptions, where surfaces are smooth.
struct Cells
{
	int sixteenths, lastSplit;
	double errors, lastSplitErrors;
	/// cellErrors and lastSplitErrors where coordinates repeat: they are cheaper exact from the
	/// start than half known.
	double errorsOfRepeats;
	double regularErrors;
};
constexpr Cells kCellsForLevels {8, 8, 2, 2, 2, 0};
constexpr Cells kNarrowCells {2, 8, 2, 0, 0.25, 0.25};
constexpr Cells kCellsForBalanced {2, 8, 4, 0, 0.25, 0.25};
constexpr Cells kCellsBetween {6, 6, 0, 0, 0.5, 0};
constexpr Cells kCellsForSize {8, 8, 0, 0, 0, 0.25};

Cells cellsFor(Optimize aim)
{
	return aim == Optimize::Levels     ? kCellsForLevels
	       : aim == Optimize::Balanced ? kCellsForBalanced
	                                   : kCellsForSize;
}

/// A plan but for its rank.
using Coding = std::pair<ScheduleOptions, PredictorSet>;

/// The codings of one way to make levels.
std::vector<Coding> codings(int effort, const Cells& cells, std::size_t vertices, bool repeating)
{
	const PredictorSet all = PredictorSet::All, repeats = PredictorSet::Repeats;
	const bool small = vertices < kSmall;
	ScheduleOptions smooth, exact;
	smooth.cellSixteenths      = cells.sixteenths;
	smooth.lastSplitSixteenths = cells.lastSplit;
	smooth.cellErrors          = cells.errors;
	smooth.lastSplitErrors     = cells.lastSplitErrors;
	exact.lastBits             = ScheduleOptions::kAll;
	exact.cellErrors = exact.lastSplitErrors = cells.errorsOfRepeats;
	smooth.regularErrors = exact.regularErrors = cells.regularErrors;
	if (effort < 3) {
		if (small)
			return {{smooth, all}, {exact, repeats}};
		smooth.bits = exact.bits = smooth.lastBits = 2;
		if (repeating)
			return {{exact, repeats}};
		return {{smooth, vertices < kLarge ? all : PredictorSet::Few}};
	}
	std::vector<Coding> some;
	const auto add = [&some](ScheduleOptions schedule, int lastBits, PredictorSet set) {
		schedule.lastBits = lastBits;
		some.push_back({schedule, set});
	};
	const auto addWidths = [&some](ScheduleOptions schedule, PredictorSet set) {
		schedule.regularErrors = 0;
		for (const int width : {4, 12}) {
			schedule.cellSixteenths = schedule.lastSplitSixteenths = width;
			some.push_back({schedule, set});
		}
	};
	constexpr int kAll = ScheduleOptions::kAll;
	if (small || !repeating) {
		for (const int lastBits : {1, 2, kAll})
			add(smooth, lastBits, all);
		smooth.lastBits = 2;
		addWidths(smooth, all);
		for (const double errors : {2, 5}) {
			ScheduleOptions bounded = smooth;
			bounded.cellErrors = bounded.regularErrors = errors;
			some.push_back({bounded, all});
		}
	}
	for (const int lastBits : {1, 2, kAll})
		add(smooth, lastBits, repeats);
	if (small || repeating) {
		some.push_back({exact, repeats});
		addWidths(exact, repeats);
	}
	return some;
}

} // namespace

Steering steeringFor(Optimize aim)
{
	// Shares and steps from experiment, on meshes of all kinds: docs/algorithm.md, section 3.
	switch (aim) {
	case Optimize::Balanced:
		return {1, 0.99, 0.9, 0.96};
	case Optimize::Levels:
		return {0, 0.95, 0.7};
	case Optimize::Size:
		break;
	}
	return {};
}

std::vector<Way> waysToEncode(const EncodeOptions& options, std::size_t vertices, bool repeats)
{
	const bool classic = isWrittenClassic(options);
	std::vector<Way> ways;
	std::size_t rank = 0;
	// The best levels come first.
	const auto add = [&](Optimize aim, bool wgc, std::initializer_list<Cells> cells) {
		ways.push_back({aim, wgc, {}});
		for (const Cells& cell : cells) {
			if (classic)
				ways.back().plans.push_back({rank, {}});
			else
				for (const Coding& c : codings(options.effort, cell, vertices, repeats))
					ways.back().plans.push_back({rank, c.first, c.second});
			++rank;
			if (classic)
				break;
		}
	};
	const Optimize wanted = options.optimize;
	if (options.wgc != Wgc::Auto)
		add(wanted, options.wgc == Wgc::On && wanted != Optimize::Levels, {cellsFor(wanted)});
	else if (vertices < kSmall && wanted != Optimize::Levels) {
		add(Optimize::Levels, false, {kCellsForLevels});
		add(Optimize::Balanced, false,
		    {kNarrowCells, kCellsForBalanced, kCellsBetween, kCellsForSize});
		add(Optimize::Size, false, {kCellsBetween, kCellsForSize});
		if (classic || options.effort == 3)
			add(Optimize::Size, true, {kCellsForSize});
	}
	else if (
	    wanted == Optimize::Balanced &&
	    (options.effort == 3 || (options.effort == 2 && vertices < kLarge))) {
		add(Optimize::Balanced, false,
		    {kNarrowCells, kCellsForBalanced, kCellsBetween, kCellsForSize});
		add(Optimize::Size, false, {kCellsForSize});
	}
	else {
		add(wanted, false, {cellsFor(wanted)});
		if (wanted == Optimize::Size && (options.mode == Mode::Classic || options.effort == 3))
			add(wanted, true, {kCellsForSize});
	}
	return ways;
}

void Choice::add(std::size_t rank, EncodedMesh file)
{
	if (smallest_.size() <= rank)
		smallest_.resize(rank + 1);
	std::optional<EncodedMesh>& best = smallest_[rank];
	if (!best || file.bytes.size() < best->bytes.size())
		best = std::move(file);
}

EncodedMesh Choice::take()
{
	std::size_t least = ~std::size_t {0};
	for (const auto& file : smallest_)
		if (file)
			least = std::min(least, file->bytes.size());
	const auto isSmallEnough = [&](const auto& file) {
		return file && double(file->bytes.size()) <= most_ * double(least);
	};
	return std::move(**std::find_if(smallest_.begin(), smallest_.end(), isSmallEnough));
}

} // namespace wavemesh
