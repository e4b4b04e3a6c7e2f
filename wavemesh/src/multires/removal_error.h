// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The error that the removal of a vertex makes, and which removals a step may make: those whose
/// error is among the smallest of the level.
#pragma once

#include "multires/coarsen.h"
#include "multires/coarsen_state.h"
#include "multires/quadrics.h"

#include <limits>

namespace wavemesh {

class RemovalError
{
public:
	/// @param state      of a coarsening of the level; outlives this object. Only stars and sides
	/// of
	///                   M^j are asked of it
	/// @param positions  #V_j by 3, lattice units
	/// @param criterion  if not active nothing is computed and everything is allowed
	/// Linear.
	RemovalError(
	    const CoarsenState& state,
	    const std::vector<LatticePoint>& positions,
	    const ErrorCriterion& criterion);

	bool active() const { return criterion_.active(); }

	/// Squared distance times area that is added where the coarse surface passes the middle of the
	/// parents in place of the child, by the child's quadric; infinite if no pair of coarse faces
	/// beside the new edge looks the way the fine ones did. Lattice units to the fourth.
	/// @param most  errors above it may come back as infinite, which is cheaper
	/// @pre active()
	double of(const ChildOf& proposal, double most = std::numeric_limits<double>::infinity()) const;
	/// The same in units of the largest error that a step may make by removing one vertex.
	double relative(const ChildOf& proposal) const;
	/// Is the error within the level's limit? Always if not active. `complete`: the child completes
	/// a 4:1 merge, which may cost more: regular connectivity takes fewer bits.
	bool allows(const ChildOf& proposal, bool complete) const;
	/// The same for a vertex of valence 3 that becomes a centre.
	bool allowsCentre(Index v) const;

private:
	double error(Index child, const Vector3& place) const;
	double least(Index v) const;
	/// With the parents at these places of the child's ring. @pre CoarsenState::fits()
	double ofPlaces(const ChildOf& proposal, int placeA, int placeB, double most) const;
	bool folds(const Side& side) const;

	const CoarsenState& state_;
	const std::vector<LatticePoint>& positions_;
	ErrorCriterion criterion_;
	double limit_ = 0;
};

} // namespace wavemesh
