// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The error that the removal of a vertex makes, and which removals a step may make: those whose
/// error is among the smallest of the level.
#pragma once

#include "multires/coarsen.h"
#include "multires/coarsen_state.h"
#include "multires/quadrics.h"

#include <limits>
#include <optional>

namespace wavemesh {

/// Squared distance times area that the removal of a vertex adds, by its quadric: lattice units to
/// the fourth.
class Removal
{
public:
	static constexpr double kInfinite = std::numeric_limits<double>::infinity();

	/// @param fine, positions, quadrics  of M^j; they outlive this object
	Removal(
	    const CornerTable& fine,
	    const std::vector<LatticePoint>& positions,
	    const Quadrics& quadrics) :
	        fine_(&fine),
	        positions_(&positions), quadrics_(&quadrics)
	{
	}

	/// Where the coarse surface passes the middle of the parents in place of the child.
	double toMiddle(const ChildOf& p) const;
	/// The same of the parents at these places of the child's ring; infinite if no pair of coarse
	/// faces beside the new edge looks the way the fine ones did. @pre CoarsenState::fits()
	/// @param most  errors above it may come back as infinite, which is cheaper
	double between(Index child, const Star& s, int placeA, int placeB, double most) const;
	/// The least of all pairs of parents that a vertex could have.
	double least(Index v, const Star& s) const;
	/// Of a vertex of valence 3 that becomes the centre of a face.
	double toCentre(Index v, const Star& s) const;

private:
	double error(Index child, const Vector3& place) const;
	bool folds(const Side& side) const;

	const CornerTable* fine_;
	const std::vector<LatticePoint>* positions_;
	const Quadrics* quadrics_;
};

class RemovalError
{
public:
	/// @param state      of a coarsening of the level; outlives this object. Only stars and
	///                   sides of M^j are asked of it
	/// @param positions  #V_j by 3, lattice units
	/// @param criterion  if not active nothing is computed and everything is allowed
	/// Linear.
	RemovalError(
	    const CoarsenState& state,
	    const std::vector<LatticePoint>& positions,
	    const ErrorCriterion& criterion);

	bool active() const { return removal_.has_value(); }

	/// The error in units of the largest that a step may make by removing one vertex; infinite
	/// above 1, 0 if not active.
	double relative(const ChildOf& proposal) const;
	/// Is the error within the level's limit? Always if not active. `complete`: the child completes
	/// a 4:1 merge, which may cost more: regular connectivity takes fewer bits.
	bool allows(const ChildOf& proposal, bool complete) const;
	/// The same for a vertex of valence 3 that becomes a centre.
	bool allowsCentre(Index v) const;

private:
	double of(const ChildOf& proposal, double most) const;

	const CoarsenState& state_;
	std::optional<Removal> removal_;
	double limit_ = 0;
};

/// The error that a step adds, in units of the least that the removal of the same vertices could
/// add; of some thousand of them, spread evenly.
/// @param fine, positions, quadrics  of M^j, before the step
double excessError(
    const CornerTable& fine,
    const std::vector<LatticePoint>& positions,
    const Quadrics& quadrics,
    const Coarsening& step);

} // namespace wavemesh
