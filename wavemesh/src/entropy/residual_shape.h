// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a predictor's errors look like: their distribution, relative to their expected size, learnt
/// from those seen. Integers only.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace wavemesh {

/// Histogram of normalised errors, asked for its cumulative distribution. 64 units are one expected
/// error; bins are 8 units wide up to 128, then four to an octave.
class ResidualShape
{
public:
	/// Mass of everything.
	static constexpr std::int32_t kTotal = 1 << 20;

	/// Heavy-tailed, the same for all.
	ResidualShape();

	/// Mass of the errors below u, 0..kTotal, increasing; bins are even inside.
	std::int32_t below(std::int64_t u) const
	{
		// Bins of negative errors mirror those of positive ones: sign is 0, or -1, which turns
		// bin b into kSide - 1 - b and makes the mass go down from the bin's upper end.
		const std::int64_t sign   = u < 0 ? -1 : 0;
		const Place at            = locate((u ^ sign) - sign);
		const std::int32_t* edges = &cumulative_[kSide];
		const std::int64_t bin    = static_cast<std::int64_t>(at.bin) ^ sign;
		const std::int64_t inside =
		    (std::int64_t(edges[bin + 1] - edges[bin]) * at.part) >> at.bits;
		return edges[bin - sign] + static_cast<std::int32_t>((inside ^ sign) - sign);
	}

	void learn(std::int64_t u);

private:
	static constexpr std::size_t kLinear       = 16;
	static constexpr std::size_t kOctaves      = 14;
	static constexpr std::size_t kSide         = kLinear + 4 * kOctaves;
	static constexpr std::size_t kBins         = 2 * kSide;
	static constexpr std::int64_t kBeyond      = std::int64_t(1) << (kOctaves + 7);
	static constexpr std::uint32_t kIncrement  = 64;
	static constexpr std::uint32_t kLargestSum = 2000 * kIncrement;
	static constexpr int kLongestWait          = 128;

	/// Bin of |u|, and how far inside, in 2^bits parts.
	struct Place
	{
		std::size_t bin;
		std::int64_t part;
		int bits;
	};
	static Place locate(std::int64_t magnitude);
	void rebuild();

	std::array<std::uint32_t, kBins> count_;
	std::array<std::int32_t, kBins + 1> cumulative_;
	int pending_ = 0; ///< learnt since the cumulative counts were taken
	int wait_    = 2; ///< how many may be pending
};

} // namespace wavemesh

#include "mesh/integer_math.h"

namespace wavemesh {

inline ResidualShape::Place ResidualShape::locate(std::int64_t magnitude)
{
	magnitude = std::min(magnitude, kBeyond - 1);
	// 7 for the even bins below 128; from there on the octaves' number of digits.
	const int length   = bitLength(static_cast<std::uint64_t>(magnitude | 64));
	const bool linear  = length == 7;
	const int bits     = linear ? 3 : length - 3;
	const int firstBin = linear ? 0 : static_cast<int>(kLinear) + 4 * (length - 8) - 4;
	return {
	    static_cast<std::size_t>(firstBin + static_cast<int>(magnitude >> bits)),
	    magnitude & ((std::int64_t(1) << bits) - 1), bits};
}

} // namespace wavemesh
