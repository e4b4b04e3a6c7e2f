// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Error quadrics (Garland & Heckbert, 1997): what the encoder remembers, from level to level, of
/// the surface around each vertex. Guides the encoder's choice only; IEEE operations and square
/// roots, so that every machine makes the same one.
#pragma once

#include "mesh/vector_math.h"
#include "multires/coarsen.h"

namespace wavemesh {

/// x -> x^T A x + 2 b^T x + c, a sum of weighted squared distances to planes. x counts from the
/// vertex the quadric belongs to, so that large coordinates cost no precision.
struct Quadric
{
	std::array<double, 6> a {}; ///< xx xy xz yy yz zz
	Vector3 b {};
	double c = 0;

	/// Adds weight * (normal . x)^2, a plane through the vertex.
	void addPlane(const Vector3& normal, double weight);
	/// Adds `share` of another vertex' quadric. @param offset  this vertex less the other
	void add(const Quadric& other, const Vector3& offset, double share);
	/// At x; never negative.
	double at(const Vector3& x) const;
};

/// One quadric for each vertex of a level. At the finest level, squared distance to the planes of
/// its faces, each weighted with a third of the face's area; boundary edges add the plane across
/// the face through them, so that the outline counts like the surface. From a level to the next
/// coarser the quadrics of children go to their parents, half each: their sum stays.
class Quadrics
{
public:
	Quadrics() = default;
	/// @param table, positions  the finest level. Linear.
	Quadrics(const CornerTable& table, const std::vector<LatticePoint>& positions);

	/// Goes to the next coarser level.
	/// @param step           what coarsen() gave for the level of these quadrics
	/// @param finePositions  of that level. Linear.
	void carry(const Coarsening& step, const std::vector<LatticePoint>& finePositions);

	const Quadric& of(Index v) const { return quadrics_[v]; }

private:
	std::vector<Quadric> quadrics_; ///< #V_j; units: lattice units to the fourth
};

} // namespace wavemesh
