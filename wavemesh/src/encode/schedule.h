// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The compact mode's plan: when a level gets more vertices and when its vertices get more bits.
/// Any plan decodes; a good one lets precision follow the length of the edges.
#pragma once

#include "encode/levels.h"

namespace wavemesh {

/// How the last bits are coded, once connectivity is whole.
enum class LastBits : std::uint8_t {
	OneByOne, ///< bit after bit for all vertices: good where surfaces are smooth
	AtOnce,   ///< vertex after vertex: good where coordinates repeat, as on CAD and scan lattices
};

struct ScheduleOptions
{
	/// Width of a cell over the mean length of the level's edges, in sixteenths; 0: full precision
	/// from the start.
	int cellSixteenths = 8;
	LastBits last      = LastBits::OneByOne;
};

/// A refinement: a split, or `bits` more bits of every coordinate.
struct ScheduleStep
{
	LevelKind kind = LevelKind::Split;
	int bits       = 0; ///< of a Precise step
};

struct Schedule
{
	int baseShift = 0; ///< cells of the base mesh are 2^baseShift lattice units wide
	std::vector<ScheduleStep> steps;
};

Schedule makeSchedule(const Levels& levels, int latticeBits, const ScheduleOptions& options);

/// Guesses from the mesh which way to code the last bits is the smaller.
LastBits guessLastBits(const CornerTable& table, const std::vector<LatticePoint>& positions);

} // namespace wavemesh
