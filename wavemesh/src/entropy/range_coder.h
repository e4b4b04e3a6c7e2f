// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Binary arithmetic coder: 32-bit carry-less range coder with 16-bit probabilities.
///
/// Both directions answer to the same call, `bool bit(bool value, probability of 1)`: the encoder
/// writes `value` and returns it, the decoder ignores it and returns what it reads. Syntax is
/// described once, as a template over the coder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace wavemesh {

/// Probability that a bit is 1, in 1/65536, 1..65535.
using Probability = std::uint32_t;

class RangeEncoder
{
public:
	static constexpr bool kReading = false;

	bool bit(bool value, Probability p)
	{
		const std::uint32_t middle =
		    low_ + static_cast<std::uint32_t>((std::uint64_t(high_ - low_) * p) >> 16);
		if (value)
			high_ = middle;
		else
			low_ = middle + 1;
		while (((low_ ^ high_) >> 24) == 0) {
			bytes_.push_back(static_cast<std::uint8_t>(high_ >> 24));
			low_ <<= 8;
			high_ = (high_ << 8) | 0xff;
		}
		return value;
	}
	bool exhausted() const { return false; }

	/// A point between two bits.
	struct Mark
	{
		std::size_t size   = 0; ///< bytes that no later bit can change
		std::uint32_t low  = 0;
		std::uint32_t high = ~std::uint32_t {0};
	};
	Mark mark() const { return {bytes_.size(), low_, high_}; }

	/// Ends the stream with as few bytes as determine it, returns it and starts a new one.
	std::vector<std::uint8_t> finish();
	/// Length of the shortest prefix of a finished stream that determines every bit before the
	/// mark.
	static std::size_t prefix(const std::vector<std::uint8_t>& stream, const Mark& mark);

private:
	std::uint32_t low_  = 0;
	std::uint32_t high_ = ~std::uint32_t {0};
	std::vector<std::uint8_t> bytes_;
};

/// Reads a stream or the beginning of one. Bits are exact as long as the bytes determine them; from
/// the first that they do not, exhausted() is true for ever and all bits are 0.
class RangeDecoder
{
public:
	static constexpr bool kReading = true;

	RangeDecoder() : RangeDecoder(nullptr, 0) {}
	RangeDecoder(const std::uint8_t* data, std::size_t size) : next_(data), end_(data + size)
	{
		for (int i = 0; i < 4; ++i)
			shift();
	}

	bool bit(bool, Probability p)
	{
		const std::uint32_t middle =
		    low_ + static_cast<std::uint32_t>((std::uint64_t(high_ - low_) * p) >> 16);
		const bool value = code_ <= middle;
		if (missing_ != 0 && (exhausted_ || value != ((code_ | missing_) <= middle))) {
			exhausted_ = true;
			return false;
		}
		if (value)
			high_ = middle;
		else
			low_ = middle + 1;
		while (((low_ ^ high_) >> 24) == 0) {
			low_ <<= 8;
			high_ = (high_ << 8) | 0xff;
			shift();
		}
		return value;
	}
	bool exhausted() const { return exhausted_; }

private:
	void shift()
	{
		const bool have = next_ != end_;
		code_           = (code_ << 8) | (have ? *next_ : 0u);
		missing_        = (missing_ << 8) | (have ? 0u : 0xffu);
		if (have)
			++next_;
	}

	const std::uint8_t* next_;
	const std::uint8_t* end_;
	std::uint32_t low_     = 0;
	std::uint32_t high_    = ~std::uint32_t {0};
	std::uint32_t code_    = 0;
	std::uint32_t missing_ = 0; ///< bits of code_ that the data did not provide
	bool exhausted_        = false;
};

} // namespace wavemesh
