// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the rich contexts of split bits (D1) know beyond the faces next to an edge: how long it is
/// against all edges of the level, against those at its ends, and against the length from which on
/// edges around it were split so far.
///
/// Lengths are log2Quarters() of squared lengths: 8 to an octave.
#pragma once

#include "mesh/integer_math.h"

#include <algorithm>
#include <vector>

namespace wavemesh {

/// Where the lengths of split edges and of whole ones lie, against the mean length of their level,
/// in 1/256; lives through all levels of a file.
struct SplitLengths
{
	std::int32_t split = 0, whole = 0;

	void learn(bool isSplit, std::int32_t length)
	{
		std::int32_t& mean = isSplit ? split : whole;
		mean += (length - mean) >> 6;
	}
};

/// Lengths of one parent level against what is known around them; all classes below their counts.
class SplitContexts
{
public:
	static constexpr int kGlobal = 16, kLocal = 20, kExcess = 21, kOuter = 22 * 22;

	/// @param length  #corners: of the edge that the corner faces
	SplitContexts(
	    const CornerTable& parent,
	    const std::vector<std::uint8_t>& length,
	    const std::vector<Index>& valence,
	    SplitLengths& lengths) :
	        parent_(parent),
	        length_(length), lengths_(lengths), vertex_(parent.vertexCount)
	{
		std::vector<std::int64_t> atVertex(parent.vertexCount, 0);
		std::int64_t sum = 0, edges = 0;
		for (Index c = 0; c < parent.cornerCount(); ++c) {
			const Index d = parent.opposite[c];
			if (d < c)
				continue;
			sum += length[c];
			++edges;
			atVertex[parent.vertex[nextCorner(c)]] += length[c];
			atVertex[parent.vertex[prevCorner(c)]] += length[c];
		}
		mean_ = static_cast<std::int32_t>(256 * sum / edges);
		for (Index v = 0; v < parent.vertexCount; ++v) {
			const std::int64_t n = std::max(valence[v], Index {1});
			vertex_[v].mean      = static_cast<std::int32_t>((4 * atVertex[v] + n / 2) / n);
		}
	}

	struct Classes
	{
		int global; ///< against the length where, over the file, split and whole edges part
		int local;  ///< against the mean of the edges at both ends
		int excess; ///< against the length where those known around part
		int outer;  ///< the same of the four edges next to it, or whether they are split
	};
	/// @param known  #corners: 0 not yet, 1 whole, 2 split
	template <class Known>
	Classes classesOf(Index c, const std::vector<Known>& known) const
	{
		const Index d                = parent_.opposite[c];
		const Vertex& a              = vertex_[parent_.vertex[nextCorner(c)]];
		const Vertex& b              = vertex_[parent_.vertex[prevCorner(c)]];
		const std::int32_t own       = length_[c];
		const std::int32_t threshold = mean_ + ((lengths_.split + lengths_.whole) >> 1);

		// The edges at both ends count most, then those at the far vertices and the level.
		std::int32_t sum = 4 * (threshold >> 8) + 4 * (a.sum + b.sum);
		std::int32_t n   = 4 + 4 * (a.count + b.count);
		for (const Index corner : {c, d})
			if (corner != kNone) {
				const Vertex& far = vertex_[parent_.vertex[corner]];
				sum += far.sum;
				n += far.count;
			}
		const std::int32_t parting = std::max(sum, 0) / n;

		int left  = outerPair(c, known, parting);
		int right = d == kNone ? kNoFace : outerPair(d, known, parting);
		if (left > right)
			std::swap(left, right);
		return {
		    std::clamp((256 * own - threshold) >> 8, -8, 7) + 8,
		    std::clamp((8 * own - a.mean - b.mean) >> 3, -10, 9) + 10,
		    std::clamp(own - parting, -10, 10) + 10, left * 22 + right};
	}

	void learn(Index c, bool split)
	{
		const std::int32_t own = length_[c];
		lengths_.learn(split, 256 * own - mean_);
		// Split edges are longer than where they part from whole ones, those shorter.
		for (const Index corner : {nextCorner(c), prevCorner(c)}) {
			Vertex& v = vertex_[parent_.vertex[corner]];
			if (v.count < kMostKnown) {
				v.sum += own - (split ? 5 : 1);
				++v.count;
			}
		}
	}

private:
	static constexpr std::int32_t kMostKnown = 64;
	static constexpr int kNoFace             = 21;

	struct Vertex
	{
		std::int32_t mean  = 0; ///< of its edges' lengths, in quarters
		std::int32_t sum   = 0; ///< of guesses where split and whole edges part
		std::int32_t count = 0;
	};

	/// The two other edges of a face, in either order: 0..20.
	template <class Known>
	int outerPair(Index c, const std::vector<Known>& known, std::int32_t parting) const
	{
		int low  = outerEdge(nextCorner(c), known, parting);
		int high = outerEdge(prevCorner(c), known, parting);
		if (low > high)
			std::swap(low, high);
		return high * (high + 1) / 2 + low;
	}
	template <class Known>
	int outerEdge(Index c, const std::vector<Known>& known, std::int32_t parting) const
	{
		if (known[c] != 0)
			return known[c] == 2 ? 4 : 5;
		const std::int32_t excess = length_[c] - parting;
		return (excess >= -4) + (excess >= 0) + (excess >= 4);
	}

	const CornerTable& parent_;
	const std::vector<std::uint8_t>& length_;
	SplitLengths& lengths_;
	std::int32_t mean_ = 0; ///< of the level, in 1/256
	std::vector<Vertex> vertex_;
};

} // namespace wavemesh
