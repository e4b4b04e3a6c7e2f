// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Model units to lattice units and back. The only place where floating point meets the positions.
#pragma once

#include "mesh/corner_table.h"

#include <cfloat>
#include <limits>

namespace wavemesh {

/// Largest lattice coordinate is below 2^kMaxBits.
constexpr int kMaxBits = 24;

static_assert(
    FLT_EVAL_METHOD == 0 && std::numeric_limits<double>::is_iec559,
    "decoders give the same positions bit for bit: every operation rounds to double");

/// Position = origin + step * lattice point, in that order of IEEE double operations.
struct Lattice
{
	std::array<double, 3> origin {};
	double step = 1;
	int bits    = 1; ///< the largest coordinate is below 2^bits

	std::array<double, 3> position(const LatticePoint& p) const
	{
		return {origin[0] + step * p[0], origin[1] + step * p[1], origin[2] + step * p[2]};
	}
	/// The same for a point in sixteenths of lattice units.
	std::array<double, 3> positionOfSixteenths(const LatticePoint& p) const
	{
		return {
		    origin[0] + step * (p[0] / 16.0), origin[1] + step * (p[1] / 16.0),
		    origin[2] + step * (p[2] / 16.0)};
	}
};

/// Lattice over the bounding box of `positions`: `step` model units a step if step > 0, else
/// 2^bits - 1 steps over the largest extent (1 model unit a step if that is 0).
/// @return InvalidArgument for non-finite coordinates (naming the vertex), bits outside 1..24, a
///         step that is negative, not finite or gives 2^24 steps or more.
Result<Lattice>
makeLattice(const std::vector<std::array<double, 3>>& positions, int bits, double step);

/// `positions` with something finite, of the same magnitude as the rest, for what makeLattice()
/// would refuse: to be made good by the exact values.
std::vector<std::array<double, 3>> finitePositions(std::vector<std::array<double, 3>> positions);

/// Nearest lattice points, ties away from zero. #V by 3, 0..2^bits - 1.
std::vector<LatticePoint>
quantise(const std::vector<std::array<double, 3>>& positions, const Lattice& lattice);

} // namespace wavemesh
