// SPDX-License-Identifier: GPL-3.0-or-later
#include "entropy/mix_weights.h"

#include "entropy/logistic.h"

#include <algorithm>

namespace wavemesh {
namespace {

constexpr std::int32_t kLargestWeight = 8 * 65536 - 1;

/// Rates of learning by the number of bits seen: a table saves a division.
struct Rates
{
	static constexpr std::int32_t kSlowest = 1024; ///< bits, from where on the rate is constant
	std::array<std::uint8_t, kSlowest + 1> of;
	constexpr Rates() : of()
	{
		for (std::size_t seen = 0; seen < of.size(); ++seen)
			of[seen] = static_cast<std::uint8_t>(20 + 3000 / (seen + 48));
	}
};
constexpr Rates kRates {};

} // namespace

template <std::size_t N>
std::int32_t weightedSum(const MixInputs& inputs, const MixWeights& weights)
{
	std::int64_t sum = 0;
	for (std::size_t i = 0; i < N; ++i)
		sum += std::int64_t(inputs[i]) * weights.of[i];
	return static_cast<std::int32_t>(
	    std::clamp<std::int64_t>(sum >> 16, -kStretchMax, kStretchMax));
}

/// Adds input * error / 2^20, rounded. The error has 24 bits; in two parts of 12 the products are
/// of 16 bits, which every vector unit has, and their sums below 2^24.
template <std::size_t N>
void followBit(const MixInputs& inputs, std::int32_t missed, MixWeights& weights)
{
	const std::int32_t error = missed * kRates.of[static_cast<std::size_t>(weights.seen)];
	weights.seen             = std::min(weights.seen + 1, Rates::kSlowest);
	const auto high          = static_cast<std::int16_t>(error >> 12);
	const auto low           = static_cast<std::int16_t>(error & 4095);
	for (std::size_t i = 0; i < N; ++i) {
		const std::int32_t step = (inputs[i] * high + ((inputs[i] * low + (1 << 19)) >> 12)) >> 8;
		std::int32_t w          = weights.of[i] + step;
		w                       = w > kLargestWeight ? kLargestWeight : w;
		weights.of[i]           = w < -kLargestWeight ? -kLargestWeight : w;
	}
}

template std::int32_t weightedSum<8>(const MixInputs&, const MixWeights&);
template std::int32_t weightedSum<16>(const MixInputs&, const MixWeights&);
template void followBit<8>(const MixInputs&, std::int32_t, MixWeights&);
template void followBit<16>(const MixInputs&, std::int32_t, MixWeights&);

} // namespace wavemesh
