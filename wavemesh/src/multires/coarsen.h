// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One step of inverse irregular subdivision, M^j -> M^{j-1} (paper sec. III, fig. 1-3): the
/// encoder's search for vertices that become children of an edge, such that the faces around them
/// merge 4:1, 3:1 or 2:1, with edge flips where a configuration blocks.
///
/// Every intermediate state of the search is a valid coarsening: a vertex becomes a child only if
/// each of its neighbours that is a child already still fits a pattern, and a side that needs a
/// flip holds the coarse edge reserved. The search can therefore stop anywhere and always
/// terminates.
#pragma once

#include "multires/refinement.h"

namespace wavemesh {

/// Wavelet geometrical criterion (paper sec. III): a sharp vertex becomes a child of p1, p2 only if
/// |(v-(p1+p2)/2) x (p1-p2)| / |p1-p2|^2 < deviation.
struct GeometricalCriterion
{
	bool active      = false;
	double sharpness = 0.3; ///< sharp: on the boundary, or |n1 x n2| above this at an edge
	double deviation = 0.25;
};

class Quadrics;
class Seams;

/// Only the vertices go whose removal makes the smallest errors (removal_error.h).
struct ErrorCriterion
{
	const Quadrics* quadrics = nullptr; ///< of M^j; null: not active
	/// Of the vertices that could go, those with the smallest errors may: this share. 0..1
	double share = 0.75;
	bool active() const { return quadrics != nullptr; }
};

/// M^{j-1} and its relation to M^j, in the numbering of M^j.
struct Coarsening
{
	CornerTable coarse;
	std::vector<Index> fineVertex; ///< #V_{j-1}: coarse vertex -> fine vertex, increasing
	std::vector<Index>
	    childOnEdge; ///< #coarse corners: fine vertex on the edge the corner faces, or kNone
	std::vector<FaceCode>
	    faceCode; ///< #coarse faces; two 1:2 faces that flip with each other both say so
	std::vector<Index>
	    centre; ///< #coarse faces: fine vertex of kFaceCentre, or kNone; empty if none
};

/// @param fine       M^j, vertices without faces not allowed
/// @param positions  #V_j by 3, lattice units, |x| < 2^30; guide the criterion and the choice only
/// @param kept       #V_j: 1 for vertices that must stay; empty if any may go
/// @param seams      of M^j, which stay
/// @return M^{j-1}; the same connectivity with coarse.vertexCount == fine.vertexCount if nothing
///         could be merged. Linear.
Coarsening coarsen(
    const CornerTable& fine,
    const std::vector<LatticePoint>& positions,
    const GeometricalCriterion& criterion,
    const std::vector<std::uint8_t>& kept = {},
    const ErrorCriterion& errorCriterion  = {},
    const Seams* seams                    = nullptr);

} // namespace wavemesh
