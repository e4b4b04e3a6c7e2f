// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a vertex sees when its position is coded. Lengths are in sixteenths of a cell of the
/// precision being coded.
#pragma once

#include "mesh/integer_math.h"
#include "predict/position_models.h"
#include "predict/surface.h"

namespace wavemesh {

/// A vertex looks at so many neighbours at most.
constexpr std::size_t kMostNeighbours = 24;
/// No prediction is further away than so many lengths.
constexpr std::int64_t kFurthest = 30;

inline std::uint64_t magnitude(std::int64_t x)
{
	return static_cast<std::uint64_t>(x < 0 ? -x : x);
}
/// Sum of absolute coordinates.
inline std::int64_t oneNorm(const Vector& a)
{
	return static_cast<std::int64_t>(magnitude(a[0]) + magnitude(a[1]) + magnitude(a[2]));
}

/// 65536 / n for numbers of neighbours.
struct Inverses
{
	std::array<std::int32_t, kMostNeighbours + 2> of;
	constexpr Inverses() : of()
	{
		for (std::size_t n = 1; n < of.size(); ++n)
			of[n] = static_cast<std::int32_t>(65536 / n);
	}
};
inline constexpr Inverses kInverses {};

/// Vectors are from origin.
struct VertexView
{
	std::size_t size = 0; ///< neighbours
	std::array<Index, kMostNeighbours + 1> ring;
	/// At the vertex, in the face (ring[i], ring[i+1]); kNone: there is none.
	std::array<Index, kMostNeighbours + 1> corner;

	Vector origin; ///< middle of the parents, or likely position
	std::int64_t length;
	int lengthBits;
	std::size_t parallelograms = 0; ///< known
	Index firstParent = kNone, firstKnown = kNone, lastKnown = kNone;
	std::size_t known = 0, repeated = 0; ///< neighbours
	UnitVector normal;

	std::array<Vector, kPredictors> predicted;
	Vector middle; ///< zero, or of the ring
	Vector offset; ///< by least squares, its height too
	std::array<LeastSquares<kOffsetFeatures>::Features, 3> features;
	LeastSquares<kOffsetFeatures + 2>::Features heightFeatures;
	Vector plainOffset;  ///< normalised, without the height
	std::int32_t height; ///< normalised
	std::size_t leastSquaresClass;

	std::array<int, 3 * kPredictors> scale; ///< of expected errors, by 3 * predictor + axis
	int across, along;                      ///< expected errors, log2 in eighths

	bool hasNoNormal() const { return normal == UnitVector {0, 0, 0}; }
	/// To lengths in 1/4096 or so: the length around has 12 binary digits.
	std::int64_t scaled(std::int64_t x) const
	{
		return lengthBits <= 12 ? x * (1 << (12 - lengthBits)) : x >> (lengthBits - 12);
	}
	std::int64_t unscaled(std::int64_t x) const
	{
		return lengthBits <= 12 ? x >> (12 - lengthBits)
		                        : x * (std::int64_t(1) << (lengthBits - 12));
	}
	std::int32_t feature(std::int64_t x) const
	{
		constexpr std::int64_t kLargest = LeastSquares<kOffsetFeatures>::kLargest;
		return static_cast<std::int32_t>(std::clamp(scaled(x), -kLargest, kLargest));
	}
};

} // namespace wavemesh
