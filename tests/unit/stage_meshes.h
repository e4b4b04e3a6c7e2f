// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Meshes as the codec's inner stages take them, and all their levels.
#pragma once

#include "mesh_families.h"
#include "multires/hierarchy.h"
#include "rng.h"

#include <string>
#include <vector>

namespace wavemesh::test {

/// A mesh on a lattice.
struct StageMesh
{
	CornerTable table;
	std::vector<LatticePoint> positions;
};
StageMesh stageMesh(const MeshData& mesh, int bits = 12);

/// Plain arrays again; lattice units.
MeshData meshOf(const CornerTable& table, const std::vector<LatticePoint>& positions);

/// Positions of the rows named.
std::vector<LatticePoint>
pickedPositions(const std::vector<LatticePoint>& fine, const std::vector<Index>& rows);

using Triangle = std::array<std::uint32_t, 3>;
/// Triangles, each begun at its smallest index, sorted: equal exactly if the oriented faces are.
std::vector<Triangle> sortedFaces(std::vector<Triangle> faces);
std::vector<Triangle> facesOf(const CornerTable& table);

/// Empty if `opposite` is what the indices say: an involution, and both corners face one edge.
std::string whatIsNotLinked(const CornerTable& table);

/// All levels of a mesh in the decoder's numbering; positions[j] are those of level j, without
/// lifting.
struct Levels
{
	Replay replay;
	std::vector<LatticePoint> positions; ///< of the finest level; a prefix is a coarser one
};
Levels makeLevels(
    const MeshData& mesh,
    const GeometricalCriterion& criterion = {},
    int bits                              = 12,
    const Steering& steering              = {});

/// Splits, diagonals, flips and centres thrown at random; valid for refine().
Refinement randomRefinement(const CornerTable& parent, Rng& rng, bool flips = true);

} // namespace wavemesh::test
