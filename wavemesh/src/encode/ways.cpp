// SPDX-License-Identifier: GPL-3.0-or-later
#include "encode/ways.h"

#include <algorithm>
#include <utility>

namespace wavemesh {
namespace {

constexpr std::size_t kSmall = 4096;  ///< vertices; their time is nothing
constexpr std::size_t kLarge = 16384; ///< vertices; here speed counts

/// Cells as this aim wants them, of a surface that is smooth.
ScheduleOptions smoothCells(Optimize aim)
{
	ScheduleOptions options;
	if (aim == Optimize::Balanced)
		options.cellSixteenths = 4;
	if (aim == Optimize::Levels)
		options.cellErrors = 2;
	return options;
}

/// The same where coordinates repeat: they are cheaper exact from the start than half known.
ScheduleOptions repeatingCells(Optimize aim)
{
	ScheduleOptions options;
	options.lastBits = ScheduleOptions::kAll;
	if (aim == Optimize::Balanced)
		options.cellErrors = 0.25;
	if (aim == Optimize::Levels)
		options.cellErrors = 2;
	return options;
}

/// A plan but for its rank.
using Coding = std::pair<ScheduleOptions, PredictorSet>;

/// The codings of one way to make levels, with cells as this aim wants them.
std::vector<Coding> codings(int effort, Optimize aim, std::size_t vertices, bool repeating)
{
	const PredictorSet all = PredictorSet::All, repeats = PredictorSet::Repeats;
	const bool small       = vertices < kSmall;
	ScheduleOptions smooth = smoothCells(aim), exact = repeatingCells(aim);
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
		for (const int width : {4, 6, 12}) {
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
		return {1, 0.99, 0.9};
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
	const auto add = [&](Optimize vertex, bool wgc, std::initializer_list<Optimize> cells) {
		ways.push_back({vertex, wgc, {}});
		for (const Optimize cell : cells) {
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
	const Optimize aim = options.optimize;
	if (options.wgc != Wgc::Auto)
		add(aim, options.wgc == Wgc::On && aim != Optimize::Levels, {aim}); // which never asks it
	else if (vertices < kSmall && aim != Optimize::Levels) {
		add(Optimize::Levels, false, {Optimize::Levels});
		add(Optimize::Balanced, false, {Optimize::Balanced, Optimize::Size});
		add(Optimize::Size, false, {Optimize::Size});
		if (classic || options.effort == 3)
			add(Optimize::Size, true, {Optimize::Size});
	}
	else if (
	    aim == Optimize::Balanced &&
	    (options.effort == 3 || (options.effort == 2 && vertices < kLarge))) {
		add(Optimize::Balanced, false, {Optimize::Balanced, Optimize::Size});
		add(Optimize::Size, false, {Optimize::Size});
	}
	else {
		add(aim, false, {aim});
		if (aim == Optimize::Size && (options.mode == Mode::Classic || options.effort == 3))
			add(aim, true, {aim});
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
