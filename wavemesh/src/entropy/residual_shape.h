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
		const std::int64_t bin    = std::int64_t(at.bin) ^ sign;
		const std::int64_t inside = (std::int64_t(edges[bin + 1] - edges[bin]) * at.part) >> kParts;
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

	static constexpr int kParts = kOctaves + 4; ///< log2

	/// Bin of |u|, and how far inside, in 2^kParts parts.
	struct Place
	{
		std::uint32_t bin, part;
	};
	/// How magnitudes with the same leading digit are shifted for a bin to have 2^kParts parts, and
	/// the bin from which the shifted ones count.
	struct Octave
	{
		std::uint8_t shift, first;
	};
	struct Octaves
	{
		std::array<Octave, kOctaves + 7> of;
		constexpr Octaves() : of()
		{
			of[6] = {kParts - 3, 0}; // the even bins
			for (std::size_t digit = 7; digit < of.size(); ++digit)
				// The first of the octave's four is 4 after shifting.
				of[digit] = {
				    static_cast<std::uint8_t>(kParts + 2 - digit),
				    static_cast<std::uint8_t>(kLinear + 4 * (digit - 7) - 4)};
		}
	};
	static const Octaves kOctave;
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

inline constexpr ResidualShape::Octaves ResidualShape::kOctave {};

inline ResidualShape::Place ResidualShape::locate(std::int64_t magnitude)
{
	const auto x                = static_cast<std::uint32_t>(std::min(magnitude, kBeyond - 1));
	const Octave octave         = kOctave.of[static_cast<std::size_t>(leadingDigit(x | 64))];
	const std::uint32_t shifted = x << octave.shift;
	return {octave.first + (shifted >> kParts), shifted & ((std::uint32_t(1) << kParts) - 1)};
}

} // namespace wavemesh
