// SPDX-License-Identifier: GPL-3.0-or-later
#include "entropy/residual_shape.h"

#include <algorithm>

namespace wavemesh {

ResidualShape::ResidualShape()
{
	for (std::size_t b = 0; b < kSide; ++b) {
		const int octave         = static_cast<int>(b - std::min(b, kLinear)) / 4;
		const std::int64_t width = b < kLinear ? 8 : std::int64_t(1) << (octave + 5);
		const std::int64_t edge  = b < kLinear
		                               ? 8 * static_cast<std::int64_t>(b)
		                               : (4 + static_cast<std::int64_t>((b - kLinear) % 4)) * width;
		// 1 / (1 + 2 (u/64)^2) at the middle of the bin.
		const std::int64_t u  = edge + width / 2;
		count_[kSide + b]     = static_cast<std::uint32_t>(1 + width * 163840 / (4096 + 2 * u * u));
		count_[kSide - 1 - b] = count_[kSide + b];
	}
	rebuild();
}

void ResidualShape::learn(std::int64_t u)
{
	const std::size_t bin = locate(u < 0 ? -u : u).bin;
	count_[u < 0 ? kSide - 1 - bin : kSide + bin] += kIncrement;
	if (++pending_ >= wait_) {
		wait_ = std::min(wait_ + wait_ / 2 + 1, kLongestWait);
		rebuild();
	}
}

void ResidualShape::rebuild()
{
	pending_          = 0;
	std::uint32_t sum = 0;
	for (const std::uint32_t c : count_)
		sum += c;
	if (sum > kLargestSum) {
		sum = 0;
		for (std::uint32_t& c : count_) {
			c -= c >> 1;
			sum += c;
		}
	}
	// Each bin keeps a little; the rest in proportion.
	const std::uint64_t scale = (std::uint64_t(kTotal - 4 * std::int32_t(kBins)) << 24) / sum;
	std::uint64_t run         = 0;
	for (std::size_t b = 0; b < kBins; ++b) {
		cumulative_[b] = static_cast<std::int32_t>(((run * scale) >> 24) + 4 * b);
		run += count_[b];
	}
	cumulative_[kBins] = static_cast<std::int32_t>(((run * scale) >> 24) + 4 * kBins);
}

} // namespace wavemesh
