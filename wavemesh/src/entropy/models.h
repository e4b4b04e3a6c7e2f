// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Adaptive models of binary decisions, alone, mixed, and strung together to integers. Integer
/// arithmetic only: encoder and decoder learn the same, bit for bit, on every machine.
#pragma once

#include "entropy/logistic.h"
#include "mesh/integer_math.h"

#include <algorithm>
#include <array>
#include <vector>

namespace wavemesh {

/// 1 / (n + 1.5) in 1/65536.
struct AdaptiveSteps
{
	std::int32_t of[1024];
	constexpr AdaptiveSteps() : of()
	{
		for (int n = 0; n < 1024; ++n)
			of[n] = 65536 * 2 / (2 * n + 3);
	}
};
inline constexpr AdaptiveSteps kAdaptiveSteps {};

/// Probability of a 1 that moves towards each bit seen by 1/(n + 1.5), n the bits seen so far, kept
/// at or below `limit`.
class AdaptiveBit
{
public:
	Probability p() const { return std::clamp<Probability>(state_ >> 16, 1, 65535); }
	/// stretch(p())
	int stretched() const { return kLogistic.stretch[state_ >> 20]; }
	int age() const { return static_cast<int>(state_ & 1023); }

	void update(bool bit, int limit) { move(target(bit), limit); }
	/// State of the probability that a bit is a sign of.
	static std::int64_t target(bool bit) { return bit ? std::int64_t {0xffffffff} : 1023; }
	/// update(), its target found once for many.
	void move(std::int64_t target, int limit)
	{
		const std::uint32_t n     = state_ & 1023;
		const std::int64_t change = ((target - state_) >> 10) * kAdaptiveSteps.of[n];
		state_ += (static_cast<std::uint32_t>(change >> 6) & ~std::uint32_t {1023}) +
		          ((n - static_cast<std::uint32_t>(limit)) >> 31); // 1 where n < limit
	}

private:
	std::uint32_t state_ = 1u << 31; ///< probability in 22 bits, age in 10
};

/// A bit with one model.
template <class Coder>
bool codeBit(Coder& coder, AdaptiveBit& model, bool value, int limit = 255)
{
	value = coder.bit(value, model.p());
	model.update(value, limit);
	return value;
}

/// Equally likely bits, most significant first.
template <class Coder>
std::uint32_t codeRaw(Coder& coder, int bits, std::uint32_t value)
{
	std::uint32_t out = 0;
	for (int i = bits - 1; i >= 0; --i)
		out = (out << 1) | std::uint32_t(coder.bit((value >> i) & 1, 32768));
	return out;
}

/// Unsigned integer below 2^MaxBits: its length in unary, then the bits below the leading one, the
/// first of them modelled, the rest equally likely.
template <int MaxBits>
class AdaptiveUnsigned
{
public:
	template <class Coder>
	std::uint64_t code(Coder& coder, std::uint64_t value)
	{
		const int wanted = bitLength(value);
		int length       = 0;
		while (length < MaxBits &&
		       codeBit(coder, length_[std::size_t(length)], length < wanted, 60))
			++length;
		if (length <= 1)
			return std::uint64_t(length);
		std::uint64_t out = 1;
		for (int i = length - 2; i >= 0; --i) {
			const bool bit = (value >> i) & 1;
			const bool top = i == length - 2;
			out            = (out << 1) | std::uint64_t(
			                                  top ? codeBit(coder, top_[std::size_t(length)], bit, 60)
			                                      : coder.bit(bit, 32768));
		}
		return out;
	}

private:
	std::array<AdaptiveBit, MaxBits + 1> length_, top_;
};

/// The same for either sign: zero is one symbol, the sign equally likely.
template <int MaxBits>
class AdaptiveSigned
{
public:
	template <class Coder>
	std::int64_t code(Coder& coder, std::int64_t value)
	{
		const auto magnitude = static_cast<std::int64_t>(
		    magnitude_.code(coder, static_cast<std::uint64_t>(value < 0 ? -value : value)));
		if (magnitude == 0)
			return 0;
		return coder.bit(value < 0, 32768) ? -magnitude : magnitude;
	}

private:
	AdaptiveUnsigned<MaxBits> magnitude_;
};

/// Learning rate of a mixer's weights after n bits: high at first, slow + 1 from the 512th on.
struct MixerRates
{
	static constexpr std::uint32_t kYoung = 512;
	std::int32_t of[kYoung];
	explicit constexpr MixerRates(std::int32_t slow) : of()
	{
		for (std::uint32_t n = 0; n < kYoung; ++n)
			of[n] = slow + static_cast<std::int32_t>(768 / (n + 49));
	}
};
inline constexpr MixerRates kSteadyRates {3};
inline constexpr MixerRates kAgileRates {24}; ///< where what is mixed changes quickly

/// Weights of N models in a mixer, and how they learn.
template <int N>
class MixerWeights
{
public:
	MixerWeights() { weight_.fill(kOne * 3 / (2 * N)); }

	/// Sum of weight * input, in the logistic domain but not limited to it.
	std::int32_t mix(const std::array<std::int32_t, N>& input) const
	{
		std::int32_t sum = 0;
		for (std::size_t i = 0; i < N; ++i)
			sum += input[i] * weight_[i];
		return sum >> kFraction;
	}
	/// @param p  what the weights said: squash(mix(input))
	void learn(
	    const std::array<std::int32_t, N>& input,
	    Probability p,
	    bool value,
	    const MixerRates& rates)
	{
		const std::int32_t error =
		    (((value ? 65535 : 0) - static_cast<std::int32_t>(p)) * rates.of[seen_]) >> 4;
		seen_ += static_cast<std::uint32_t>(seen_ + 1 < MixerRates::kYoung);
		for (std::size_t i = 0; i < N; ++i)
			weight_[i] = std::clamp(
			    weight_[i] + ((input[i] * error + (1 << 17)) >> 18), -kLargest, kLargest);
	}

private:
	static constexpr int kFraction         = 14;
	static constexpr std::int32_t kOne     = 1 << kFraction;
	static constexpr std::int32_t kLargest = 8 * kOne - 1;
	static_assert(N <= 8, "the sum must stay below 2^31");

	std::array<std::int32_t, N> weight_; ///< 1/16384
	std::uint32_t seen_ = 0;
};

/// Logistic mixing of N models: p = squash(sum of weight * stretch(p_i)), the weights learn from
/// every bit (PAQ family; M. Mahoney). Everything fits into 32 bits.
template <int N>
class Mixer
{
public:
	/// @param sets  number of weight sets; one is selected for each bit
	explicit Mixer(int sets, const MixerRates& rates = kSteadyRates) :
	        sets_(std::size_t(sets)), rates_(&rates)
	{
	}

	/// Codes a bit with all of `models`, which learn it too.
	template <class Coder>
	bool
	code(Coder& coder, const std::array<AdaptiveBit*, N>& models, int set, bool value, int limit)
	{
		return code(coder, models, 0, set, value, limit);
	}
	/// The same with the models at place `at` of `rows`.
	template <class Coder>
	bool code(
	    Coder& coder,
	    const std::array<AdaptiveBit*, N>& rows,
	    std::size_t at,
	    int set,
	    bool value,
	    int limit)
	{
		MixerWeights<N>& weights = sets_[std::size_t(set)];
		std::array<std::int32_t, N> input;
		for (std::size_t i = 0; i < N; ++i)
			input[i] = rows[i][at].stretched();
		const Probability p = squash(weights.mix(input));
		value               = coder.bit(value, p);
		weights.learn(input, p, value, *rates_);
		const std::int64_t target = AdaptiveBit::target(value);
		for (std::size_t i = 0; i < N; ++i)
			rows[i][at].move(target, limit);
		return value;
	}

private:
	std::vector<MixerWeights<N>> sets_;
	const MixerRates* rates_;
};

/// Two mixers of the same models, one that knows a context and one that does not, averaged in the
/// logistic domain; each learns from its own error. What they say together is then corrected by
/// what came of it before.
template <int N>
class PairMixer
{
public:
	/// @param sets  number of weight sets of the one that knows a context
	explicit PairMixer(int sets) : sets_(std::size_t(sets)) {}

	template <class Coder>
	bool
	code(Coder& coder, const std::array<AdaptiveBit*, N>& models, int set, bool value, int limit)
	{
		MixerWeights<N>& special = sets_[std::size_t(set)];
		std::array<std::int32_t, N> input;
		for (std::size_t i = 0; i < N; ++i)
			input[i] = models[i]->stretched();
		const std::int32_t a = special.mix(input), b = general_.mix(input);
		const std::int32_t both = std::clamp((a + b) >> 1, -kStretchMax, kStretchMax);
		AdaptiveBit& correction = corrections_[static_cast<std::size_t>((both + 2048) >> 7)];
		value                   = coder.bit(
		                      value, std::clamp<Probability>((3 * squash(both) + correction.p()) / 4, 32, 65503));
		special.learn(input, squash(a), value, kAgileRates);
		general_.learn(input, squash(b), value, kAgileRates);
		correction.update(value, 255);
		const std::int64_t target = AdaptiveBit::target(value);
		for (std::size_t i = 0; i < N; ++i)
			models[i]->move(target, limit);
		return value;
	}

private:
	std::vector<MixerWeights<N>> sets_;
	MixerWeights<N> general_;
	std::array<AdaptiveBit, 32> corrections_; ///< by what both say
};

} // namespace wavemesh
