// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The exact integer filter bank of the paper, sec. V: lazy prediction by the middle of the parents
/// (13)-(15), and the update of the parents by lifting (16)-(25).
#pragma once

#include "mesh/glue.h"
#include "multires/refinement.h"

namespace wavemesh {

/// Parents of each new vertex: the ends of its edge, in the order next, prev of the first corner
/// that faces the edge, and kNone; or the three corners of its face for a centre.
/// #(V_j - V_{j-1}) by 3.
using Parents = std::vector<std::array<Index, 3>>;
Parents parentsOf(const CornerTable& parent, const Refinement& refinement);

/// Weights alpha of the update (16), in 1/65536: how much of each detail its parents' neighbourhood
/// takes on. Depends on connectivity alone, before edge flips. As lists: entry e adds
/// alpha[e] * detail[child] to vertex[e], e in begin[child] .. begin[child + 1].
struct UpdateWeights
{
	std::vector<Index> begin; ///< #(children + 1); empty: lifting is off
	std::vector<Index> vertex;
	std::vector<std::int32_t> alpha;
};

/// Weights of the k-disc update: alpha minimises |I[T,H] alpha - b|, H the parents dilated k times,
/// T = H and its neighbours, I the Gram matrix of the coarse hat functions on faces weighted by
/// their number of descendants, b the inner products of the child's fine hat with the coarse hats.
///
/// @param disc  kLiftingOff, or k, 0..2
/// Cost O(1) a child.
UpdateWeights updateWeights(
    const CornerTable& parent, const Refinement& refinement, const Parents& parents, int disc);

/// Takes all weights from the vertices that are glued to others, so that these stay together.
void keepStill(const Glue& glue, UpdateWeights& weights);

/// Splits positions of level j into those of level j-1 and details.
///
/// Source: (23) predict, D = floor(B_lazy C), then (24) update, C' = A_lazy C + floor(alpha D).
/// @param positions  [in,out] #V_j by 3, lattice units; on return the first #V_{j-1} rows are level
///                   j-1
/// @return details, #(V_j - V_{j-1}) by 3, lattice units
/// Arithmetic modulo 2^32. @post synthesise() restores `positions` exactly.
std::vector<LatticePoint>
analyse(const Parents& parents, const UpdateWeights& weights, std::vector<LatticePoint>& positions);

/// Inverse of analyse(), (25).
/// @param positions  [in,out] the first #V_{j-1} rows are level j-1; on return #V_j rows, level j
void synthesise(
    const Parents& parents,
    const UpdateWeights& weights,
    const std::vector<LatticePoint>& details,
    std::vector<LatticePoint>& positions);

/// ceil of the parents' mean: the prediction of a child.
LatticePoint
middle(const std::vector<LatticePoint>& positions, const std::array<Index, 3>& parents);

} // namespace wavemesh
