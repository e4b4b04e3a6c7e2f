// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The encoder's half-way house: the mesh cut and on its lattice, coarsened to the base mesh, and
/// all of it numbered as the decoder will.
#pragma once

#include "mesh/glue.h"
#include "mesh/manifold_cut.h"
#include "mesh/quantization.h"
#include "multires/hierarchy.h"
#include "stage.h"

#include <optional>

namespace wavemesh {

struct QuantisedMesh
{
	ManifoldCut cut;
	Lattice lattice;
	std::vector<LatticePoint> positions; ///< #V of the cut
};

struct Levels
{
	Replay replay;
	std::vector<LatticePoint> positions; ///< #V_J in the decoder's order, lattice units
	std::vector<Index> group;            ///< #V_0: see glueOf()
	Glue glue;

	std::size_t splits() const { return replay.levels.size(); }
	/// Connectivity of level i, counting splits only.
	const CornerTable& table(std::size_t i) const
	{
		return i < splits() ? replay.levels[i].parent : replay.finest;
	}
};

/// @return nothing if the user cancelled. Linear.
std::optional<Levels> makeLevels(
    const QuantisedMesh& mesh,
    const GeometricalCriterion& criterion,
    const Steering& steering,
    const Stage& stage,
    const Seams& seams = {});

} // namespace wavemesh
