// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The compact mode's plan: when a level gets more vertices and when its vertices get more bits.
/// Any plan decodes; a good one lets precision follow the length of the edges.
#pragma once

#include "encode/levels.h"

namespace wavemesh {

struct ScheduleOptions
{
	static constexpr int kAll = 24;

	/// Width of a cell over the mean length of the level's edges, in sixteenths; 0: full precision
	/// from the start.
	int cellSixteenths = 8;
	/// The same while the last split is coded, where narrow cells cost the most.
	int lastSplitSixteenths = 8;
	/// Bits that a refinement adds to all vertices: 1 is the smallest where surfaces are smooth, 2
	/// is faster.
	int bits = 1;
	/// The same for the last refinement of all. kAll: whatever is missing once connectivity is
	/// whole, vertex after vertex; the smallest where coordinates repeat, as on CAD and scan
	/// lattices.
	int lastBits = 1;
	/// A level's cells are no wider than so many times its error (level_errors.h): wider ones cost
	/// more in distance than they save in bits, and where surfaces are smooth not even bits are
	/// saved, as predictions from wide cells are poor. 0: no such bound.
	double cellErrors = 0;
	/// The same while the last split is coded. Cells never widen again: what narrows those of a
	/// coarser level narrows these.
	double lastSplitErrors = 0;
	/// In place of both where the last split is regular, if not 0: predictions are so good there
	/// that positions are cheaper exact from the start.
	double regularErrors = 0;
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

/// Do the mesh's coordinates repeat, as on CAD and scan lattices, so that PredictorSet::Repeats and
/// ScheduleOptions::kAll give the smaller file? A guess, from how often neighbouring faces close to
/// parallelograms for their size, and from how few different values the coordinates have.
bool repeatsItself(const CornerTable& table, const std::vector<LatticePoint>& positions);

} // namespace wavemesh
