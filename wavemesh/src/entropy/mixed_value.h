// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// An integer coded by what many predictors say about it. Each predictor gives a distribution: a
/// centre, an expected error, and a learnt shape of its errors. The integer is narrowed down by
/// questions "is it at least t?"; each predictor answers with the odds that its distribution gives,
/// and the answers are mixed in the logistic domain with weights that learn from every question.
///
/// Mixing the distributions, not the predictions, keeps what each predictor is sure of: exact
/// repeats stay exact.
#pragma once

#include "entropy/logarithm.h"
#include "entropy/logistic.h"
#include "entropy/mix_weights.h"
#include "entropy/residual_shape.h"

#include <algorithm>
#include <vector>

namespace wavemesh {

/// Classes of expected errors, four to an octave, in 1/16.
constexpr int kScaleClasses = 96;

struct ScaleTable
{
	std::array<std::int64_t, kScaleClasses> inverse; ///< 2^26 / 2^(class/4)
	constexpr ScaleTable() : inverse()
	{
		constexpr std::int64_t quarter[4] = {65536, 77936, 92682, 110218};
		for (std::size_t c = 0; c < inverse.size(); ++c)
			inverse[c] = (std::int64_t(1) << 42) / (quarter[c & 3] << (c >> 2));
	}
};
inline constexpr ScaleTable kScaleTable {};

/// ln(above / under) in 1/256, for the mixer. @pre both are positive
inline std::int32_t oddsOf(std::uint32_t above, std::uint32_t under)
{
	const std::int32_t x = ((log2OfWord(above) - log2OfWord(under)) * 177) >> 12;
	return std::clamp(x, -kStretchMax, kStretchMax);
}

/// Selects three of the weight sets, by what is known before the first question.
struct MixContext
{
	std::size_t a = 0, b = 0, c = 0; ///< below MixedValue::kContexts
};

class MixedValue
{
public:
	static constexpr std::size_t kMaxOpinions  = kMostInputs - 1;
	static constexpr std::size_t kSomeOpinions = 8;
	static constexpr std::size_t kFewOpinions  = 5;
	static constexpr std::size_t kContexts     = 12;

	/// @param firstWeight  of every opinion, 1/65536
	explicit MixedValue(std::int32_t firstWeight);

	/// What predictor i says of the next value.
	///
	/// @param centre  1/16, |centre| < 2^33
	/// @param scale   class of the expected error
	void setOpinion(std::size_t i, std::int64_t centre, int scale, ResidualShape& shape)
	{
		centre_[i]  = centre;
		inverse_[i] = kScaleTable.inverse[static_cast<std::size_t>(scale)];
		shape_[i]   = &shape;
	}

	/// Codes a value of low .. high-1, asking outwards from `guide` in steps that double from
	/// 2^spread on, then halving what is left.
	///
	/// @tparam N      opinions that are asked, the first ones: kFewOpinions or kMaxOpinions
	/// @param counts  one opinion more if N = kMaxOpinions: below(x) tells how many values below x
	///                there were; nullptr: has none
	template <std::size_t N, class Coder, class Counts>
	std::int64_t codeAround(
	    Coder& coder,
	    std::int64_t value,
	    std::int64_t low,
	    std::int64_t high,
	    std::int64_t guide,
	    int spread,
	    const MixContext& context,
	    const Counts* counts)
	{
		low_.fill(0);
		high_.fill(ResidualShape::kTotal);
		Range range {low, high};
		beginCounts<N>(range, counts);
		const bool up      = ask<N>(coder, value, guide, range, 0, context, counts);
		std::int64_t reach = std::int64_t(1) << spread;
		for (int depth = 1; !coder.exhausted(); ++depth, reach *= 2) {
			const std::int64_t t = up ? guide + reach : guide - reach;
			if (t <= low || t >= high)
				break;
			const std::size_t node = static_cast<std::size_t>(std::min(depth, kOutward));
			if (ask<N>(coder, value, t, range, node, context, counts) != up)
				break;
		}
		halve<N>(coder, value, range, kInward, 8, context, counts);
		return learn<N>(range.low);
	}

	/// Codes a value of low .. low + 2^bits - 1 by halving.
	template <std::size_t N, class Coder, class Counts>
	std::int64_t codeWithin(
	    Coder& coder,
	    std::int64_t value,
	    std::int64_t low,
	    int bits,
	    const MixContext& context,
	    const Counts* counts)
	{
		Range range {low, low + (std::int64_t(1) << bits)};
		for (std::size_t i = 0; i < N; ++i) {
			low_[i]  = below(i, range.low);
			high_[i] = below(i, range.high);
		}
		beginCounts<N>(range, counts);
		halve<N>(coder, value, range, kWithin, 4, context, counts);
		return learn<N>(range.low);
	}

private:
	// Questions by their kind: sign, outward, halving after that, halving a known interval.
	static constexpr int kOutward        = 6;
	static constexpr std::size_t kInward = 7;
	static constexpr std::size_t kWithin = 16;
	static constexpr std::size_t kNodes  = 21;
	static constexpr std::size_t kSlots  = 33; ///< of the final stage: odds in steps of 1/2
	/// Counts have a place behind the most opinions only; few are filled up with nothing.
	template <std::size_t N>
	static constexpr std::size_t kInputs = N == kMaxOpinions ? N + 1 : kSomeOpinions;

	struct Range
	{
		std::int64_t low, high;
	};

	std::int64_t normalised(std::size_t i, std::int64_t sixteenths) const
	{
		return ((sixteenths - centre_[i]) * inverse_[i]) >> 20;
	}
	/// Mass below t - 1/2 in predictor i's opinion. Increases with t.
	std::int32_t below(std::size_t i, std::int64_t t) const
	{
		return shape_[i]->below(normalised(i, 16 * t - 8));
	}

	template <std::size_t N, class Counts>
	void beginCounts(const Range& range, const Counts* counts)
	{
		if (N != kMaxOpinions || counts == nullptr)
			return;
		countLow_  = counts->below(static_cast<std::uint32_t>(range.low));
		countHigh_ = counts->below(static_cast<std::uint32_t>(range.high));
	}

	template <std::size_t N, class Coder, class Counts>
	void halve(
	    Coder& coder,
	    std::int64_t value,
	    Range& range,
	    std::size_t node,
	    int deepest,
	    const MixContext& context,
	    const Counts* counts)
	{
		while (range.high - range.low > 1 && !coder.exhausted()) {
			const std::int64_t width = range.high - range.low;
			const int left           = bitLength(static_cast<std::uint64_t>(width - 1));
			ask<N>(
			    coder, value, range.low + width / 2, range,
			    node + static_cast<std::size_t>(std::min(left, deepest)), context, counts);
		}
	}

	template <std::size_t N, class Coder, class Counts>
	bool
	ask(Coder& coder,
	    std::int64_t value,
	    std::int64_t t,
	    Range& range,
	    std::size_t node,
	    const MixContext& context,
	    const Counts* counts)
	{
		if (t <= range.low)
			return true;
		if (t >= range.high)
			return false;
		std::array<std::int32_t, N> middle;
		for (std::size_t i = 0; i < N; ++i) {
			middle[i] = below(i, t);
			input_[i] = static_cast<std::int16_t>(oddsOf(
			    static_cast<std::uint32_t>(high_[i] - middle[i] + 3),
			    static_cast<std::uint32_t>(middle[i] - low_[i] + 3)));
		}
		std::uint32_t count = 0;
		if constexpr (N == kMaxOpinions) {
			input_[N] = 0;
			if (counts != nullptr) {
				count     = counts->below(static_cast<std::uint32_t>(t));
				input_[N] = static_cast<std::int16_t>(
				    oddsOf(16 * (countHigh_ - count) + 6, 16 * (count - countLow_) + 6));
			}
		}

		const bool bit                 = mix<kInputs<N>>(coder, value >= t, node, context);
		(bit ? range.low : range.high) = t;
		(bit ? countLow_ : countHigh_) = count;
		std::array<std::int32_t, kMaxOpinions>& bound = bit ? low_ : high_;
		std::copy(middle.begin(), middle.end(), bound.begin());
		return bit;
	}

	template <std::size_t Inputs, class Coder>
	bool mix(Coder& coder, bool value, std::size_t node, const MixContext& context)
	{
		MixWeights* const sets[3] = {
		    &sets_[0][node * kContexts + context.a], &sets_[1][node * kContexts + context.b],
		    &sets_[2][node * kContexts + context.c]};
		std::int32_t said[3], sum = 0;
		for (std::size_t s = 0; s < 3; ++s) {
			said[s] = weightedSum<Inputs>(input_, *sets[s]);
			sum += said[s];
		}
		const std::int32_t mean = sum / 3;
		// Final stage: what bits with these odds were in truth.
		const std::int32_t place   = (mean + 2048) * 32;
		const std::size_t slot     = node * kSlots + static_cast<std::size_t>(place >> 12);
		const std::int32_t part    = place & 4095;
		const std::int64_t refined = (std::int64_t(refined_[slot]) * (4096 - part) +
		                              std::int64_t(refined_[slot + 1]) * part) >>
		                             18;
		const auto p = static_cast<Probability>(
		    std::clamp<std::int64_t>((std::int64_t(squash(mean)) + refined) / 2, 24, 65512));
		value = coder.bit(value, p);

		for (std::size_t s = 0; s < 3; ++s)
			followBit<Inputs>(
			    input_, (value ? 65535 : 0) - static_cast<std::int32_t>(squash(said[s])), *sets[s]);
		std::int32_t& r = refined_[part < 2048 ? slot : slot + 1];
		r += ((value ? (1 << 22) - 1 : 0) - r) / 64;
		return value;
	}

	template <std::size_t N>
	std::int64_t learn(std::int64_t x)
	{
		for (std::size_t i = 0; i < N; ++i)
			shape_[i]->learn(normalised(i, 16 * x));
		return x;
	}

	// The predictors' opinions of the next value.
	std::array<std::int64_t, kMaxOpinions> centre_;
	std::array<std::int64_t, kMaxOpinions> inverse_; ///< of the expected error
	std::array<ResidualShape*, kMaxOpinions> shape_;

	std::array<std::int32_t, kMaxOpinions> low_, high_; ///< mass below the ends of the range
	std::uint32_t countLow_ = 0, countHigh_ = 0;        ///< the same of the counts
	MixInputs input_ {};                                ///< the last ones from the counts
	std::array<std::vector<MixWeights>, 3> sets_;       ///< by kind of question and context
	std::vector<std::int32_t> refined_; ///< by kind and odds, probability in 22 bits
};

inline MixedValue::MixedValue(std::int32_t firstWeight)
{
	MixWeights first;
	first.of.fill(firstWeight);
	for (auto& sets : sets_)
		sets.assign(kNodes * kContexts, first);
	refined_.resize(kNodes * kSlots);
	for (std::size_t i = 0; i < refined_.size(); ++i)
		refined_[i] = static_cast<std::int32_t>(squash(int(i % kSlots) * 128 - 2048) << 6);
}

} // namespace wavemesh
