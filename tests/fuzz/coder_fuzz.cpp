// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Any values through the range coder and every model: they are read as they were written, from the
/// whole stream to the end, and from a part of it up to where it says that it is exhausted.
#include "entropy/mixed_value.h"
#include "entropy/models.h"
#include "entropy/range_coder.h"
#include "fuzz_check.h"
#include "syntax/exact_syntax.h"

#include <cstring>
#include <memory>

namespace wavemesh::test {
namespace {

/// As if every 64th value had come up once.
struct EvenCounts
{
	std::uint32_t below(std::uint32_t x) const { return x / 64; }
};

/// Everything that learns.
template <class Coder>
struct Models
{
	explicit Models(Coder&) : wide({true, 3}, 2), narrow({false, 2}, 1) {}

	AdaptiveBit bits[8];
	AdaptiveUnsigned<32> words;
	AdaptiveUnsigned<5> few;
	AdaptiveSigned<9> small;
	AdaptiveSigned<32> large;
	Mixer<3> mixer {4};
	PairMixer<2> pair {4};
	MixedValue mixed {6144};
	ResidualShape shapes[MixedValue::kMaxOpinions];
	ExactSyntax wide, narrow;
};

std::uint64_t bitsOf(double x)
{
	std::uint64_t bits;
	std::memcpy(&bits, &x, sizeof bits);
	return bits;
}

double numberOf(std::uint64_t bits)
{
	double x;
	std::memcpy(&x, &bits, sizeof x);
	return x;
}

template <std::size_t N, class Coder>
std::uint64_t codeMixed(Coder& coder, Models<Coder>& m, ByteSource& in)
{
	const std::uint32_t what = in.byte();
	const int bits           = int(what % 25);
	const std::int64_t size  = std::int64_t(1) << bits;
	for (std::size_t i = 0; i < N; ++i)
		m.mixed.setOpinion(
		    i, std::int64_t(in.word(2)) << in.below(18), int(in.below(kScaleClasses)), m.shapes[i]);
	const MixContext context {in.below(12), in.below(12), in.below(12)};
	const auto drawn = [&] { return std::int64_t(in.word(3)) % size; };
	const EvenCounts even;
	const EvenCounts* const counts = what & 64 ? &even : nullptr;
	if (what & 128) {
		const std::int64_t low = drawn();
		return std::uint64_t(
		    m.mixed.template codeWithin<N>(coder, low + drawn(), low, bits, context, counts));
	}
	const std::int64_t value = drawn(), guide = drawn();
	return std::uint64_t(m.mixed.template codeAround<N>(
	    coder, value, 0, size, guide, int(in.below(26)), context, counts));
}

double finite(double x)
{
	return std::isfinite(x) ? x : 0;
}

/// Codes one value; what it is and by which model is drawn.
template <class Coder>
std::uint64_t codeOne(Coder& coder, Models<Coder>& m, ByteSource& in)
{
	const std::uint32_t what = in.byte(), context = what >> 4;
	switch (what % 12) {
	case 0:
		return coder.bit(in.flag(), std::clamp<Probability>(Probability(in.word(2)), 1, 65535));
	case 1:
		return codeBit(coder, m.bits[context % 8], in.flag(), 30 + 225 * int(context / 8));
	case 2: {
		const int bits = int(in.below(33));
		return codeRaw(coder, bits, std::uint32_t(in.word(4)));
	}
	case 3:
		return m.words.code(coder, in.word(4) >> (2 * context));
	case 4:
		return m.few.code(coder, in.below(32));
	case 5:
		return std::uint64_t(m.small.code(coder, std::int64_t(in.below(1023)) - 511));
	case 6:
		return std::uint64_t(m.large.code(coder, std::int32_t(in.word(4) >> context)));
	case 7:
		return m.mixer.code(
		    coder, std::array<AdaptiveBit*, 3> {&m.bits[0], &m.bits[1], &m.bits[2]},
		    int(context % 4), in.flag(), 255);
	case 8:
		return m.pair.code(
		    coder, std::array<AdaptiveBit*, 2> {&m.bits[3], &m.bits[4]}, int(context % 4),
		    in.flag(), 127);
	case 9:
		return context % 2 ? codeMixed<MixedValue::kFewOpinions>(coder, m, in)
		                   : codeMixed<MixedValue::kMaxOpinions>(coder, m, in);
	case 10: {
		const double near   = finite(numberOf(in.word(8))),
		             spread = std::abs(finite(numberOf(in.word(8))));
		return bitsOf(m.wide.code(coder, near, spread, context % 2, numberOf(in.word(8))));
	}
	default: {
		const double near  = double(std::int16_t(in.word(2))) / 100;
		std::uint32_t bits = std::uint32_t(in.word(4));
		float value;
		std::memcpy(&value, &bits, sizeof value);
		if (std::isnan(value)) // a quiet one, as floats widen to
			value = std::numeric_limits<float>::quiet_NaN();
		return bitsOf(m.narrow.code(coder, near, 0.01 * context, 0, double(value)));
	}
	}
}

/// Codes all that the input draws; false from the first value that the data no longer told.
template <class Coder>
std::vector<std::uint64_t> codeAll(Coder& coder, const std::uint8_t* bytes, std::size_t size)
{
	const auto models = std::make_unique<Models<Coder>>(coder);
	std::vector<std::uint64_t> values;
	for (ByteSource in(bytes, size); !in.empty() && values.size() < 3000;) {
		const std::uint64_t value = codeOne(coder, *models, in);
		if (coder.exhausted())
			break;
		values.push_back(value);
	}
	return values;
}

void check(const std::uint8_t* bytes, std::size_t size)
{
	RangeEncoder encoder;
	const auto values = codeAll(encoder, bytes, size);
	const auto stream = encoder.finish();
	RangeDecoder decoder(stream.data(), stream.size());
	require(codeAll(decoder, bytes, size) == values, "what was written is read");
	require(!decoder.exhausted(), "the stream is whole");

	const std::vector<std::uint8_t> part(
	    stream.begin(), stream.begin() + std::ptrdiff_t(stream.size() * (size % 7) / 7));
	RangeDecoder short_(part.data(), part.size());
	const auto some = codeAll(short_, bytes, size);
	require(
	    some.size() <= values.size() && std::equal(some.begin(), some.end(), values.begin()),
	    "what a part tells is true");
}

} // namespace
} // namespace wavemesh::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
	wavemesh::test::check(bytes, size);
	return 0;
}
