// SPDX-License-Identifier: GPL-3.0-or-later
#include "encode/levels.h"

#include "entropy/range_coder.h"
#include "syntax/base_syntax.h"

namespace wavemesh {

std::optional<Levels> makeLevels(
    const QuantisedMesh& mesh,
    const GeometricalCriterion& criterion,
    const Steering& steering,
    const Stage& stage,
    const Seams& seams)
{
	bool running         = true;
	const auto keepGoing = [&](double fraction) { return running = stage(fraction); };
	auto coarsenings     = coarsenAll(
	        mesh.cut.table, mesh.positions, criterion, steering, keepGoing, mesh.cut.shared(), seams);
	if (!running)
		return {};

	BaseMesh base;
	std::vector<Index> source;
	base.table = coarsenings.empty() ? mesh.cut.table : coarsenings.back().coarse;
	base.positions.resize(base.table.vertexCount);
	{
		RangeEncoder ignored; // the order of the base does not depend on its positions
		base.table = BaseSyntax<RangeEncoder>(ignored, mesh.lattice.bits).write(base, source).table;
	}
	const Index baseVertices = base.table.vertexCount;
	Levels levels;
	levels.replay = replay(std::move(coarsenings), std::move(base.table), std::move(source));
	levels.positions.reserve(levels.replay.source.size());
	for (const Index v : levels.replay.source)
		levels.positions.push_back(mesh.positions[v]);
	levels.group = mesh.cut.groupsOf(levels.replay.source, baseVertices);
	levels.glue  = glueOf(levels.group);
	return levels;
}

} // namespace wavemesh
