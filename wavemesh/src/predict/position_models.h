// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Everything the compact mode learns about positions; lives through all levels of a file.
#pragma once

#include "entropy/mixed_value.h"
#include "predict/least_squares.h"
#include "predict/predictor_set.h"
#include "predict/value_counts.h"

#include <optional>

namespace wavemesh {

/// Predictors whose expected error is judged from the errors around.
enum Predictor : std::uint8_t {
	kSurface,        ///< least squares; errors across the surface and along it as they are around
	kSurfaceNarrow,  ///< the same; the error across the surface small against that along it
	kSmooth,         ///< butterfly rule; of a known vertex: mean of all parallelograms
	kRing,           ///< mean of the known neighbours
	kBetween,        ///< between the middle and kParallelograms, or beyond them
	kParallelograms, ///< mean of the known parallelograms
	kSimilar,        ///< like the neighbours' own offsets
	kParallelogram,  ///< the first known parallelogram
	kPredictors
};
constexpr std::size_t kFewPredictors = kParallelograms;

/// Predictors that are exact or of no use, each with its own shapes of errors in whole cells.
enum Repeat : std::uint8_t {
	kRepeatMiddle,
	kRepeatParallelograms,
	kRepeatParallelogram,
	kRepeatMatch, ///< the neighbour that agrees best in the coordinates already known
	kRepeatLast,  ///< the last known neighbour
	kRepeatBest,  ///< the predictor that was best in the coordinates already known
	kRepeatFirst, ///< the first parent, or the first known neighbour
	kRepeats
};
static_assert(std::size_t(kPredictors) + std::size_t(kRepeats) == MixedValue::kMaxOpinions);
static_assert(std::size_t(kPredictors) == MixedValue::kSomeOpinions);
static_assert(kFewPredictors == MixedValue::kFewOpinions);

constexpr std::size_t kOffsetFeatures = 7;

/// Errors that are kept: across and along the surface, then of each predictor from kSmooth on along
/// each axis.
enum : std::size_t { kErrorAcross, kErrorAlong, kSurfaceErrors };
constexpr std::size_t errorOf(std::size_t predictor, std::size_t axis)
{
	return kSurfaceErrors + 3 * (predictor - kSmooth) + axis;
}
constexpr std::size_t kErrors = errorOf(kPredictors, 0);

/// What is learnt about one kind of coding: the positions of new vertices, or the bits of known
/// ones.
struct PositionModels
{
	MixedValue value;
	std::array<std::array<ResidualShape, 3>, kPredictors> shapes; ///< by class of expected error
	std::array<std::array<std::array<ResidualShape, 4>, 3>, kRepeats> repeats; ///< by axis, context
	/// Errors against the length around, log2 in 1/128, running; in the order of VertexRecord.
	std::array<std::int32_t, kErrors> ratio;
	std::array<LeastSquares<kOffsetFeatures>, 4> offset;
	std::array<LeastSquares<kOffsetFeatures + 2>, 4> height;

	explicit PositionModels(PredictorSet set) : value(firstWeight(set)) { ratio.fill(-20 * 16); }

private:
	static std::int32_t firstWeight(PredictorSet set)
	{
		return set == PredictorSet::Few ? 9830 : 6144;
	}
};

/// Errors that a vertex had when it was last coded, log2 in eighths, and what else its neighbours
/// learn from it.
struct VertexRecord
{
	std::array<std::uint8_t, kErrors> error;
	bool repeated;       ///< one of the predictors was right
	LatticePoint offset; ///< from the middle of the parents, or of the ring; 1/16
};

class CompactModels
{
public:
	explicit CompactModels(PredictorSet set) : births(set), bits(set) {}

	PositionModels births, bits;
	std::vector<VertexRecord> records; ///< #V
	/// Coordinates so far at full precision, by axis; only up to kCountedBits.
	std::array<std::optional<ValueCounts>, 3> counts;
	static constexpr int kCountedBits = 16;
};

} // namespace wavemesh
