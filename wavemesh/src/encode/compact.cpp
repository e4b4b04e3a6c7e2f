// SPDX-License-Identifier: GPL-3.0-or-later
#include "encode/compact.h"

#include "level_work.h"
#include "predict/shown_positions.h"
#include "syntax/base_syntax.h"
#include "syntax/connectivity_syntax.h"
#include "syntax/position_syntax.h"

namespace wavemesh {
namespace {

/// Rows [from, to) of the positions, as cells 2^shift lattice units wide.
void appendCells(
    const std::vector<LatticePoint>& positions,
    std::size_t from,
    std::size_t to,
    int shift,
    std::vector<LatticePoint>& cells)
{
	for (std::size_t v = from; v < to; ++v)
		cells.push_back(
		    {positions[v][0] >> shift, positions[v][1] >> shift, positions[v][2] >> shift});
}

/// By split: squared distances from the middle of the parents, of all vertices that come with it
/// and later.
std::vector<std::uint64_t> missingDetails(const Levels& levels, const std::vector<Parents>& parents)
{
	std::vector<std::uint64_t> sums(levels.splits() + 1, 0);
	for (std::size_t i = levels.splits(); i-- > 0;) {
		sums[i]           = sums[i + 1];
		std::size_t child = levels.table(i).vertexCount;
		for (const auto& p : parents[i])
			sums[i] = saturatingAdd(
			    sums[i], squaredDistance(levels.positions[child++], middle(levels.positions, p)));
	}
	return sums;
}

/// Of vertices from where a level has them. Lattice units.
/// @param shown  in 1/16 of a lattice unit
std::uint64_t
squaredErrors(const std::vector<LatticePoint>& truth, const std::vector<LatticePoint>& shown)
{
	std::uint64_t sum = 0;
	for (std::size_t v = 0; v < shown.size(); ++v) {
		LatticePoint p = truth[v];
		for (std::int32_t& x : p)
			x *= 16;
		sum = saturatingAdd(sum, squaredDistance(shown[v], p));
	}
	return sum / 256;
}

/// By level: the work up to its end, of 1 in all.
std::vector<double> workOf(const Levels& levels, const Schedule& schedule, int latticeBits)
{
	LevelInfo level;
	level.vertices = levels.table(0).vertexCount;
	level.bits     = latticeBits - schedule.baseShift;
	std::vector<double> work {levelWork(Mode::Compact, level, nullptr)};
	std::size_t split = 0;
	for (const ScheduleStep& step : schedule.steps) {
		const LevelInfo below = level;
		level.kind            = step.kind;
		level.bits += step.bits;
		if (step.kind == LevelKind::Split)
			level.vertices = levels.table(++split).vertexCount;
		work.push_back(work.back() + levelWork(Mode::Compact, level, &below));
	}
	const double all = work.back();
	for (double& w : work)
		w = all > 0 ? w / all : 1;
	return work;
}

} // namespace

bool writeCompact(
    const Levels& levels,
    const Schedule& schedule,
    AttributeWriter* attributes,
    Head& head,
    std::vector<std::uint8_t>& chunks,
    const Stage& stage)
{
	const std::vector<LatticePoint>& truth = levels.positions;
	const int bits                         = head.lattice.bits;
	std::vector<Parents> parents;
	for (const ReplayedLevel& level : levels.replay.levels)
		parents.push_back(parentsOf(level.parent, level.refinement));
	const std::vector<std::uint64_t> missing = missingDetails(levels, parents);

	LevelWriter writer(head, chunks);
	ConnectivityModels connectivityModels(head.rich ? Contexts::Rich : Contexts::Fast);
	const auto models              = std::make_unique<CompactModels>(head.predictors);
	const std::vector<double> work = workOf(levels, schedule, bits);
	std::size_t split              = 0; // levels of connectivity so far, less the base
	int shift                      = schedule.baseShift;
	std::vector<LatticePoint> cells;
	cells.reserve(truth.size());
	const auto errors = [&]() -> std::uint64_t {
		if (shift == 0)
			return 0;
		// Of coarser levels the missing vertices count far more than where their own are shown.
		const bool hasAll = cells.size() == truth.size();
		return squaredErrors(
		    truth, hasAll ? shownPositions(levels.table(split), {}, cells, shift, bits, levels.glue)
		                  : middlesOfCells(cells, shift));
	};
	const auto endLevel = [&](LevelKind kind, std::size_t step) {
		LevelRow row;
		row.kind      = kind;
		row.vertices  = std::uint32_t(cells.size());
		row.faces     = std::uint32_t(levels.table(split).faceCount());
		row.shift     = shift;
		row.errorCode = errorCode(saturatingAdd(missing[split], errors()), truth.size());
		writer.endLevel(row, step == schedule.steps.size());
	};

	appendCells(truth, 0, levels.table(0).vertexCount, shift, cells);
	{
		const BaseMesh base {levels.table(0), cells, {}};
		std::vector<Index> ignored;
		BaseSyntax<RangeEncoder>(writer.coder(), bits - shift, head.has(kRestoration))
		    .write(base, ignored, &levels.group);
	}
	writer.attributesBegin();
	if (attributes)
		attributes->base(writer.coder(), levels.table(0), levels.glue);
	endLevel(LevelKind::Base, 0);
	for (std::size_t i = 0; i < schedule.steps.size(); ++i) {
		const ScheduleStep& step = schedule.steps[i];
		const Stage level        = stage.part(work[i], work[i + 1]);
		const Stage positions =
		    level.part(step.kind == LevelKind::Split ? kConnectivityWork : 0, 1);
		bool running           = true;
		const Progress watched = [&](double done) { return running = positions(done); };
		if (step.kind == LevelKind::Split) {
			const CornerTable& parent = levels.table(split);
			Refinement refinement     = levels.replay.levels[split].refinement;
			ConnectivitySyntax<RangeEncoder>(writer.coder(), connectivityModels, parent, cells)
			    .code(refinement);
			writer.connectivityEnds();
			const CornerTable& child = levels.table(++split);
			appendCells(truth, cells.size(), child.vertexCount, shift, cells);
			withPositionSyntax<RangeEncoder>(
			    head.predictors,
			    [&](auto syntax) {
				    syntax.watch(watched);
				    syntax.codeChildren(parent, refinement, parents[split - 1], shift, cells);
			    },
			    writer.coder(), *models, child, bits, levels.glue);
			writer.attributesBegin();
			if (attributes)
				attributes->split(
				    writer.coder(), split, parent, child, refinement, parents[split - 1]);
		}
		else {
			shift -= step.bits;
			std::vector<LatticePoint> finer;
			finer.reserve(cells.size());
			appendCells(truth, 0, cells.size(), shift, finer);
			withPositionSyntax<RangeEncoder>(
			    head.predictors,
			    [&](auto syntax) {
				    syntax.watch(watched);
				    syntax.codeBits(shift, step.bits, cells, finer);
			    },
			    writer.coder(), *models, levels.table(split), bits, levels.glue);
			writer.attributesBegin();
		}
		if (!running)
			return false;
		endLevel(step.kind, i + 1);
		if (!level(1))
			return false;
	}
	return true;
}

} // namespace wavemesh
