// SPDX-License-Identifier: GPL-3.0-or-later
#include "encode/classic.h"

#include "syntax/base_syntax.h"
#include "syntax/connectivity_syntax.h"
#include "syntax/detail_syntax.h"
#include "wavelet/lifting.h"

namespace wavemesh {
namespace {

/// Details of one level and what their synthesis needs.
struct AnalysedLevel
{
	Parents parents;
	UpdateWeights weights;
	std::vector<LatticePoint> details;
};

struct Analysis
{
	std::vector<AnalysedLevel> levels;
	std::vector<std::uint64_t> squaredError; ///< by level, of the details that it lacks
};

/// From the finest level down; `positions` become those of the base mesh.
bool analyseAll(
    const Levels& levels,
    int lifting,
    std::vector<LatticePoint>& positions,
    Analysis& out,
    const Stage& stage)
{
	const std::size_t splits = levels.splits();
	out.levels.resize(splits);
	out.squaredError.assign(splits + 1, 0);
	for (std::size_t i = splits; i-- > 0;) {
		const ReplayedLevel& level = levels.replay.levels[i];
		AnalysedLevel& a           = out.levels[i];
		a.parents                  = parentsOf(level.parent, level.refinement);
		a.weights = updateWeights(level.parent, level.refinement, a.parents, lifting);
		keepStill(levels.glue, a.weights);
		a.details = analyse(a.parents, a.weights, positions);
		positions.resize(level.parent.vertexCount);
		out.squaredError[i] = out.squaredError[i + 1];
		for (const LatticePoint& d : a.details)
			out.squaredError[i] = saturatingAdd(out.squaredError[i], squaredDistance(d, {0, 0, 0}));
		if (!stage(1 - double(i + 1) / double(splits)))
			return false;
	}
	return true;
}

} // namespace

bool writeClassic(
    Levels& levels,
    AttributeWriter* attributes,
    Head& head,
    std::vector<std::uint8_t>& chunks,
    const Stage& stage)
{
	std::vector<LatticePoint>& positions = levels.positions;
	const std::size_t splits = levels.splits(), total = positions.size();
	Analysis analysis;
	if (!analyseAll(levels, head.lifting, positions, analysis, stage.part(0, 0.4)))
		return false;

	// From the base up; each level is synthesised on the way, as the decoder does.
	LevelWriter writer(head, chunks);
	ConnectivityModels connectivityModels(head.rich ? Contexts::Rich : Contexts::Fast);
	DetailModels detailModels;
	const auto row = [&](LevelKind kind, std::size_t level) {
		LevelRow r;
		r.kind      = kind;
		r.vertices  = std::uint32_t(positions.size());
		r.faces     = std::uint32_t(levels.table(level).faceCount());
		r.errorCode = errorCode(analysis.squaredError[level], total);
		return r;
	};
	BaseMesh base {levels.table(0), positions, {}};
	std::vector<Index> ignored;
	BaseSyntax<RangeEncoder>(writer.coder(), head.lattice.bits, head.has(kRestoration))
	    .write(base, ignored, &levels.group);
	writer.attributesBegin();
	if (attributes)
		attributes->base(writer.coder(), levels.table(0), levels.glue);
	writer.endLevel(row(LevelKind::Base, 0), splits == 0);
	for (std::size_t i = 0; i < splits; ++i) {
		ReplayedLevel& level = levels.replay.levels[i];
		AnalysedLevel& a     = analysis.levels[i];
		ConnectivitySyntax<RangeEncoder>(
		    writer.coder(), connectivityModels, level.parent, positions)
		    .code(level.refinement);
		writer.connectivityEnds();
		DetailSyntax<RangeEncoder>(
		    writer.coder(), detailModels, level.parent, level.refinement, positions)
		    .code(a.details);
		synthesise(a.parents, a.weights, a.details, positions);
		writer.attributesBegin();
		if (attributes)
			attributes->split(
			    writer.coder(), i + 1, level.parent, levels.table(i + 1), level.refinement,
			    a.parents);
		writer.endLevel(row(LevelKind::Split, i + 1), i + 1 == splits);
		level = {};
		a     = {};
		if (!stage(0.4 + 0.6 * double(positions.size()) / double(total)))
			return false;
	}
	return true;
}

} // namespace wavemesh
