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

/// What one predictor says.
struct Opinion
{
	std::int64_t centre  = 0; ///< 1/16, |centre| < 2^33
	int scale            = 0; ///< class of the expected error
	ResidualShape* shape = nullptr;

	/// Mass below t - 1/2.
	std::int32_t below(std::int64_t t) const { return shape->below(normalised(16 * t - 8)); }
	std::int64_t normalised(std::int64_t sixteenths) const
	{
		return ((sixteenths - centre) * kScaleTable.inverse[std::size_t(scale)]) >> 20;
	}
};

/// ln(above / under) in 1/256, for the mixer.
inline std::int32_t oddsOf(std::uint32_t above, std::uint32_t under)
{
	const std::int32_t x = ((log2Fixed(above) - log2Fixed(under)) * 177) >> 12;
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
	static constexpr std::size_t kMaxOpinions = 15;
	static constexpr std::size_t kContexts    = 12;

	/// The predictors' opinions of the next value; the first `count` are asked.
	std::array<Opinion, kMaxOpinions> opinions;
	std::size_t count = kMaxOpinions;

	MixedValue();

	/// Codes a value of low .. high-1, asking outwards from `guide` in steps that double from
	/// 2^spread on, then halving what is left.
	///
	/// @param odds  callable (low, t, high) -> the last opinion, given as odds in 1/256
	template <class Coder, class Odds>
	std::int64_t codeAround(
	    Coder& coder,
	    std::int64_t value,
	    std::int64_t low,
	    std::int64_t high,
	    std::int64_t guide,
	    int spread,
	    const MixContext& context,
	    const Odds& odds)
	{
		for (std::size_t i = 0; i < count; ++i)
			bounds_[i] = {0, ResidualShape::kTotal};
		Range range {low, high};
		const bool up      = ask(coder, value, guide, range, 0, context, odds);
		std::int64_t reach = std::int64_t(1) << spread;
		for (int depth = 1; !coder.exhausted(); ++depth, reach *= 2) {
			const std::int64_t t = up ? guide + reach : guide - reach;
			if (t <= low || t >= high)
				break;
			const std::size_t node = static_cast<std::size_t>(std::min(depth, kOutward));
			if (ask(coder, value, t, range, node, context, odds) != up)
				break;
		}
		halve(coder, value, range, kInward, 8, context, odds);
		return learn(range.low);
	}

	/// Codes a value of low .. low + 2^bits - 1 by halving.
	template <class Coder, class Odds>
	std::int64_t codeWithin(
	    Coder& coder,
	    std::int64_t value,
	    std::int64_t low,
	    int bits,
	    const MixContext& context,
	    const Odds& odds)
	{
		Range range {low, low + (std::int64_t(1) << bits)};
		for (std::size_t i = 0; i < count; ++i)
			bounds_[i] = {opinions[i].below(range.low), opinions[i].below(range.high)};
		halve(coder, value, range, kWithin, 4, context, odds);
		return learn(range.low);
	}

private:
	// Questions by their kind: sign, outward, halving after that, halving a known interval.
	static constexpr int kOutward        = 6;
	static constexpr std::size_t kInward = 7;
	static constexpr std::size_t kWithin = 16;
	static constexpr std::size_t kNodes  = 21;
	static constexpr std::size_t kSlots  = 33; ///< of the final stage: odds in steps of 1/2

	struct Range
	{
		std::int64_t low, high;
	};

	/// Weights in 1/65536, and how many bits they saw.
	struct Weights
	{
		std::array<std::int32_t, kMaxOpinions + 1> of;
		std::int32_t seen = 0;
	};

	template <class Coder, class Odds>
	void halve(
	    Coder& coder,
	    std::int64_t value,
	    Range& range,
	    std::size_t node,
	    int deepest,
	    const MixContext& context,
	    const Odds& odds)
	{
		while (range.high - range.low > 1 && !coder.exhausted()) {
			const std::int64_t width = range.high - range.low;
			const int left           = bitLength(static_cast<std::uint64_t>(width - 1));
			ask(coder, value, range.low + width / 2, range,
			    node + static_cast<std::size_t>(std::min(left, deepest)), context, odds);
		}
	}

	template <class Coder, class Odds>
	bool
	ask(Coder& coder,
	    std::int64_t value,
	    std::int64_t t,
	    Range& range,
	    std::size_t node,
	    const MixContext& context,
	    const Odds& odds)
	{
		if (t <= range.low)
			return true;
		if (t >= range.high)
			return false;
		for (std::size_t i = 0; i < count; ++i) {
			middle_[i] = opinions[i].below(t);
			const auto above =
			    static_cast<std::uint32_t>(std::max(bounds_[i].high - middle_[i], 0) + 3);
			const auto under =
			    static_cast<std::uint32_t>(std::max(middle_[i] - bounds_[i].low, 0) + 3);
			input_[i] = oddsOf(above, under);
		}
		input_[count] = odds(range.low, t, range.high);

		const bool bit                 = mix(coder, value >= t, node, context);
		(bit ? range.low : range.high) = t;
		for (std::size_t i = 0; i < count; ++i)
			(bit ? bounds_[i].low : bounds_[i].high) = middle_[i];
		return bit;
	}

	template <class Coder>
	bool mix(Coder& coder, bool value, std::size_t node, const MixContext& context)
	{
		Weights* const sets[3] = {
		    &sets_[0][node * kContexts + context.a], &sets_[1][node * kContexts + context.b],
		    &sets_[2][node * kContexts + context.c]};
		std::int32_t said[3], sum = 0;
		for (std::size_t s = 0; s < 3; ++s) {
			said[s] = dot(*sets[s]);
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
			adapt(*sets[s], squash(said[s]), value);
		std::int32_t& r = refined_[part < 2048 ? slot : slot + 1];
		r += ((value ? (1 << 22) - 1 : 0) - r) / 64;
		return value;
	}

	std::int32_t dot(const Weights& w) const
	{
		std::int64_t sum = 0;
		for (std::size_t i = 0; i <= count; ++i)
			sum += std::int64_t(input_[i]) * w.of[i];
		return static_cast<std::int32_t>(
		    std::clamp<std::int64_t>(sum >> 16, -kStretchMax, kStretchMax));
	}

	void adapt(Weights& w, Probability p, bool value)
	{
		const std::int32_t rate = kRate + kYoungRate / (w.seen + 48);
		const std::int64_t error =
		    std::int64_t((value ? 65535 : 0) - static_cast<std::int32_t>(p)) * rate;
		if (w.seen < 1024)
			++w.seen;
		for (std::size_t i = 0; i <= count; ++i)
			w.of[i] = static_cast<std::int32_t>(std::clamp<std::int64_t>(
			    w.of[i] + ((input_[i] * error + (1 << 19)) >> 20), -kLargestWeight,
			    kLargestWeight));
	}
	static constexpr std::int32_t kRate          = 20;
	static constexpr std::int32_t kYoungRate     = 3000;
	static constexpr std::int64_t kLargestWeight = 8 * 65536 - 1;

	std::int64_t learn(std::int64_t x)
	{
		for (std::size_t i = 0; i < count; ++i)
			opinions[i].shape->learn(opinions[i].normalised(16 * x));
		return x;
	}

	struct Mass
	{
		std::int32_t low, high;
	};
	std::array<Mass, kMaxOpinions> bounds_; ///< mass below the ends of the range
	std::array<std::int32_t, kMaxOpinions> middle_;
	std::array<std::int32_t, kMaxOpinions + 1>
	    input_;                                ///< odds in 1/256; the last ones from outside
	std::array<std::vector<Weights>, 3> sets_; ///< by kind of question and context
	std::vector<std::int32_t> refined_;        ///< by kind and odds, probability in 22 bits
};

inline MixedValue::MixedValue()
{
	Weights first;
	first.of.fill(65536 * 3 / 2 / (kMaxOpinions + 1));
	for (auto& sets : sets_)
		sets.assign(kNodes * kContexts, first);
	refined_.resize(kNodes * kSlots);
	for (std::size_t i = 0; i < refined_.size(); ++i)
		refined_[i] = static_cast<std::int32_t>(squash(int(i % kSlots) * 128 - 2048) << 6);
}

} // namespace wavemesh
