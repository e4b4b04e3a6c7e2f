// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The wavelet geometrical criterion of the paper (sec. III; after its reference [22]).
#pragma once

#include "multires/coarsen.h"
#include "multires/coarsen_state.h"

namespace wavemesh {

/// Which vertices of a level are sharp, and whether a sharp one may become a child. Encoder only;
/// IEEE operations without libm, so that every machine chooses the same.
class Sharpness
{
public:
	Sharpness(
	    const CornerTable& fine,
	    const std::vector<LatticePoint>& positions,
	    const GeometricalCriterion& criterion);

	bool active() const { return criterion_.active; }
	/// On the boundary, or at an edge with |n1 x n2| above the threshold. @pre active()
	bool isSharp(Index v) const { return sharp_[v] != 0; }
	/// |(v-(p1+p2)/2) x (p1-p2)| / |p1-p2|^2 below the threshold, or v not sharp, or not active.
	bool allows(const ChildOf& proposal) const;

private:
	const std::vector<LatticePoint>& positions_;
	GeometricalCriterion criterion_;
	std::vector<std::uint8_t> sharp_; ///< #V, empty if not active
};

} // namespace wavemesh
