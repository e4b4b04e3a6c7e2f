// SPDX-License-Identifier: GPL-3.0-or-later
// The compact mode's plan.
#include "encode/level_errors.h"
#include "encode/schedule.h"
#include "mesh_families.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace wavemesh::test {
namespace {

Levels levelsOn(const MeshData& mesh, int bits)
{
	const Lattice lattice = makeLattice(mesh.positions, bits, 0).value();
	QuantisedMesh quantised {
	    cutToManifold(mesh.triangles, Index(mesh.positions.size())).value(), lattice, {}};
	const auto points = quantise(mesh.positions, lattice);
	for (const Index v : quantised.cut.vertex)
		quantised.positions.push_back(points[v]);
	const Progress none;
	return makeLevels(quantised, {}, {}, Stage(none, 0, 1)).value();
}

std::vector<ScheduleOptions> someOptions()
{
	std::vector<ScheduleOptions> all;
	for (const int cell : {0, 1, 4, 8, 12, 64, 1000})
		for (const int bits : {1, 2, 5})
			for (const int last : {1, 2, ScheduleOptions::kAll})
				all.push_back({cell, 8, bits, last});
	return all;
}

std::string whatIsWrong(
    const Schedule& schedule, const Levels& levels, int bits, const ScheduleOptions& options)
{
	if (schedule.baseShift < 0 || schedule.baseShift >= bits)
		return "the base mesh has no precision";
	int shift          = schedule.baseShift;
	std::size_t splits = 0;
	for (std::size_t i = 0; i < schedule.steps.size(); ++i) {
		const ScheduleStep& step = schedule.steps[i];
		if (step.kind == LevelKind::Split) {
			++splits;
			continue;
		}
		if (step.kind != LevelKind::Precise || step.bits < 1)
			return "step " + std::to_string(i) + " does nothing";
		if (splits == 0)
			return "bits before the first split";
		const bool last = i + 1 == schedule.steps.size();
		if (step.bits > (last ? std::max(options.bits, options.lastBits) : options.bits))
			return "step " + std::to_string(i) + " has too many bits";
		shift -= step.bits;
	}
	if (splits != levels.splits())
		return "not every split comes once";
	return shift == 0 ? "" : "the finest level is not at full precision";
}

TEST(Schedule, BitsAddUpForEveryMeshAndOption)
{
	for (const auto& family : allFamilies()) {
		if (family.mesh.positions.size() > 400)
			continue;
		for (const int bits : {1, 2, 12, 24}) {
			const Levels levels = levelsOn(family.mesh, bits);
			for (const ScheduleOptions& o : someOptions())
				ASSERT_EQ(whatIsWrong(makeSchedule(levels, bits, o), levels, bits, o), "")
				    << family.name << ", " << bits << " bits, " << o.cellSixteenths << ' ' << o.bits
				    << ' ' << o.lastBits;
		}
	}
}

TEST(Schedule, WithoutACellWidthIsAllSplits)
{
	const Levels levels = levelsOn(makeBumpySphere(300, 1), 12);
	const Schedule s    = makeSchedule(levels, 12, {0, 0, 1, 1});
	EXPECT_EQ(s.baseShift, 0);
	EXPECT_EQ(s.steps.size(), levels.splits());
}

TEST(Schedule, OfOneLevelIsAtFullPrecision)
{
	const Levels levels = levelsOn(makeTriangle(), 12);
	const Schedule s    = makeSchedule(levels, 12, {8, 8, 1, 1});
	EXPECT_EQ(s.baseShift, 0);
	EXPECT_TRUE(s.steps.empty());
}

TEST(Schedule, WiderCellsMeanACoarserBase)
{
	const Levels levels = levelsOn(makeBumpySphere(900, 1), 16);
	int before          = -1;
	for (const int cell : {1, 4, 16}) {
		const int shift = makeSchedule(levels, 16, {cell, cell, 1, 1}).baseShift;
		EXPECT_GT(shift, before) << cell;
		before = shift;
	}
}

/// Bits that are missing where the last split comes.
int bitsMissing(const Schedule& s)
{
	int shift = s.baseShift, missing = 0;
	for (const ScheduleStep& step : s.steps) {
		shift -= step.bits;
		missing = step.kind == LevelKind::Split ? shift : missing;
	}
	return missing;
}

TEST(Schedule, NarrowerCellsForTheLastSplitCountThereOnly)
{
	const Levels levels   = levelsOn(makeBumpySphere(900, 1), 16);
	const Schedule wide   = makeSchedule(levels, 16, {8, 8, 1, 1});
	const Schedule narrow = makeSchedule(levels, 16, {8, 2, 1, 1});
	EXPECT_EQ(narrow.baseShift, wide.baseShift);
	EXPECT_EQ(bitsMissing(narrow), bitsMissing(wide) - 2);
}

TEST(Schedule, ABoundForTheLastSplitCountsThereOnly)
{
	const Levels levels  = levelsOn(makeBumpySphere(900, 1), 16);
	const Schedule free  = makeSchedule(levels, 16, {8, 8, 1, 1});
	const Schedule bound = makeSchedule(levels, 16, {8, 8, 1, 1, 0, 0.5});
	EXPECT_EQ(bound.baseShift, free.baseShift);
	EXPECT_LT(bitsMissing(bound), bitsMissing(free));
}

TEST(Schedule, ABoundForRegularSplitsCountsOnlyWhereTheLastIsOne)
{
	const ScheduleOptions wide {8, 8, 1, 1, 0, 0, 0}, exact {8, 8, 1, 1, 0, 0, 0.25};
	const Levels regular = levelsOn(makeTorus(64, 32), 12);
	EXPECT_GT(bitsMissing(makeSchedule(regular, 12, wide)), 2);
	EXPECT_EQ(bitsMissing(makeSchedule(regular, 12, exact)), 0);
	const Levels irregular = levelsOn(makeBumpySphere(900, 1), 12);
	EXPECT_EQ(
	    bitsMissing(makeSchedule(irregular, 12, exact)),
	    bitsMissing(makeSchedule(irregular, 12, wide)));
}

TEST(Schedule, PrecisionFollowsTheLengthOfTheEdges)
{
	const Levels levels = levelsOn(makeBumpySphere(900, 1), 16);
	const Schedule s    = makeSchedule(levels, 16, {8, 8, 1, 1});
	EXPECT_EQ(s.steps.front().kind, LevelKind::Split);
	std::size_t between = 0; // bits that come before the last split
	bool lastSplitSeen  = false;
	for (std::size_t i = s.steps.size(); i-- > 0;) {
		lastSplitSeen = lastSplitSeen || s.steps[i].kind == LevelKind::Split;
		between += lastSplitSeen && s.steps[i].kind == LevelKind::Precise;
	}
	EXPECT_GE(between, 2u);
}

TEST(Schedule, LastBitsComeAtOnceIfAskedTo)
{
	const Levels levels = levelsOn(makeBumpySphere(300, 1), 16);
	const Schedule s    = makeSchedule(levels, 16, {8, 8, 1, ScheduleOptions::kAll});
	EXPECT_EQ(s.steps.back().kind, LevelKind::Precise);
	EXPECT_GT(s.steps.back().bits, 2);
	EXPECT_EQ(s.steps[s.steps.size() - 2].kind, LevelKind::Split);
}

bool repeats(const MeshData& mesh)
{
	const Levels levels = levelsOn(mesh, 12);
	return repeatsItself(levels.replay.finest, levels.positions);
}

TEST(RepeatsItself, IsTrueOfLatticesAndFalseOfIrregularSurfaces)
{
	EXPECT_TRUE(repeats(makeFlatGrid(20, 20)));
	EXPECT_TRUE(repeats(punch(makeFlatGrid(12, 9), 10, 1)));
	EXPECT_FALSE(repeats(makeBumpySphere(400, 1)));
	EXPECT_FALSE(repeats(makeTerrain(400, 1)));
	EXPECT_FALSE(repeats(makeTriangle()));
}

TEST(Schedule, CellsAreBoundedByTheErrorsOfTheLevels)
{
	const Levels levels              = levelsOn(makeBumpySphere(1500, 5), 14);
	const std::vector<double> errors = levelErrors(levels);
	// The bounds of all splits but the last, and of the last.
	for (const auto& [times, timesOfLast] :
	     {std::pair {0.25, 0.25}, {2.0, 2.0}, {12.0, 12.0}, {2.0, 0.0}, {0.0, 0.5}}) {
		const ScheduleOptions options {64, 64, 1, 1, times, timesOfLast};
		const Schedule s = makeSchedule(levels, 14, options);
		ASSERT_EQ(whatIsWrong(s, levels, 14, options), "");
		int shift         = s.baseShift;
		std::size_t level = 0;
		for (const ScheduleStep& step : s.steps) {
			if (step.kind == LevelKind::Precise) {
				shift -= step.bits;
				continue;
			}
			// Before the next split a level has all the bits that it is to have.
			const bool last    = level + 1 == levels.splits();
			const double bound = last ? timesOfLast : times;
			if (bound > 0) {
				EXPECT_LE(std::ldexp(1.0, shift), std::max(1.0, bound * errors[level]));
			}
			++level;
		}
	}
}

TEST(LevelErrors, OfASphereAreItsDistancesWithinAFactorOfTwo)
{
	const int bits                   = 16;
	const Levels levels              = levelsOn(makeIcosphere(32), bits);
	const std::vector<double> errors = levelErrors(levels);
	ASSERT_EQ(errors.size(), levels.splits() + 1);
	EXPECT_EQ(errors.back(), 0);
	const double radius = (std::ldexp(1.0, bits) - 1) / 2;
	for (std::size_t i = 0; i < levels.splits(); ++i) {
		EXPECT_GE(errors[i], errors[i + 1]);
		const CornerTable& table = levels.table(i);
		if (table.vertexCount < 150 || table.vertexCount > 3000)
			continue;
		// Faces weigh the same here: the middle of each, and of its edges.
		double squares = 0;
		for (Index c = 0; c < table.cornerCount(); c += 3) {
			std::array<double, 3> sum {};
			for (Index k = c; k < c + 3; ++k)
				for (std::size_t axis = 0; axis < 3; ++axis)
					sum[axis] += levels.positions[table.vertex[k]][axis] - radius;
			const double depth =
			    radius - std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / 3;
			squares += depth * depth;
		}
		const double middles = std::sqrt(squares / table.faceCount());
		EXPECT_GT(errors[i], 0.35 * middles) << i;
		EXPECT_LT(errors[i], 1.5 * middles) << i;
	}
}

} // namespace
} // namespace wavemesh::test
