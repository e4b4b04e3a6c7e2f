// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The ways to encode a mesh that are tried, and which of the files is kept.
#pragma once

#include "encode/schedule.h"
#include "multires/hierarchy.h"
#include "predict/predictor_set.h"

#include <wavemesh/codec.h>

#include <optional>
#include <vector>

namespace wavemesh {

/// One way to code the positions of levels.
struct Plan
{
	std::size_t rank; ///< by the quality of the levels, 0 the best; several plans may share one
	ScheduleOptions schedule;                        ///< compact mode only
	PredictorSet predictors = PredictorSet::Repeats; ///< compact mode only
};

/// One way to make levels, and all ways to code them.
struct Way
{
	Optimize aim;
	bool wgc;
	std::vector<Plan> plans;
};

/// Which steps of the coarsening look at the error they make, for this aim.
Steering steeringFor(Optimize aim);

/// @param vertices  of the mesh
/// @param repeats   see repeatsItself()
std::vector<Way> waysToEncode(const EncodeOptions& options, std::size_t vertices, bool repeats);

/// Of files made in several ways: the smallest, or that of the best rank among those that are about
/// as small, as the aim has it.
class Choice
{
public:
	explicit Choice(Optimize aim) : most_(aim == Optimize::Balanced ? 1.03 : 1) {}

	void add(std::size_t rank, EncodedMesh file);
	/// @pre add() was called
	EncodedMesh take();

private:
	double most_;                                      ///< bytes, in units of the smallest file's
	std::vector<std::optional<EncodedMesh>> smallest_; ///< of each rank
};

} // namespace wavemesh
