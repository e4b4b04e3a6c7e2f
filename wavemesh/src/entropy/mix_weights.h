// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Weighted sums of what predictors say in the logistic domain, and how the weights learn. Kept out
/// of line and with fixed numbers of inputs: so compilers use the vector unit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace wavemesh {

constexpr std::size_t kMostInputs = 16;

/// Odds in 1/256, at most kStretchMax in magnitude.
using MixInputs = std::array<std::int16_t, kMostInputs>;

/// Weights in 1/65536, less than 8 in magnitude, and how many bits they saw.
struct MixWeights
{
	std::array<std::int32_t, kMostInputs> of;
	std::int32_t seen = 0;
};

/// Sum of the first N inputs, weighted: odds in 1/256, within kStretchMax. N is 8 or 16.
template <std::size_t N>
std::int32_t weightedSum(const MixInputs& inputs, const MixWeights& weights);

/// After a bit: the first N weights follow the gradient of its cost.
///
/// @param missed  65535 times the bit less the probability that was given to it, 1/65536
template <std::size_t N>
void followBit(const MixInputs& inputs, std::int32_t missed, MixWeights& weights);

} // namespace wavemesh
