// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a predictor's errors look like: their distribution, relative to their expected size, learnt
/// from those seen. Integers only.
#pragma once

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
		const Place at = locate(u < 0 ? -u : u);
		if (u >= 0) {
			const std::int32_t from = cumulative_[kSide + at.bin];
			const std::int32_t to   = cumulative_[kSide + at.bin + 1];
			return from + static_cast<std::int32_t>((std::int64_t(to - from) * at.part) >> at.bits);
		}
		const std::int32_t to   = cumulative_[kSide - at.bin];
		const std::int32_t from = cumulative_[kSide - at.bin - 1];
		return to - static_cast<std::int32_t>((std::int64_t(to - from) * at.part) >> at.bits);
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
	if (magnitude < 128)
		return {static_cast<std::size_t>(magnitude >> 3), magnitude & 7, 3};
	if (magnitude >= kBeyond)
		magnitude = kBeyond - 1;
	const int octave = bitLength(static_cast<std::uint64_t>(magnitude)) - 8;
	const int bits   = octave + 5;
	return {
	    kLinear + 4 * static_cast<std::size_t>(octave) +
	        static_cast<std::size_t>((magnitude >> bits) & 3),
	    magnitude & ((std::int64_t(1) << bits) - 1), bits};
}

} // namespace wavemesh
