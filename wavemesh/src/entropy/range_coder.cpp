// SPDX-License-Identifier: GPL-3.0-or-later
#include "entropy/range_coder.h"

namespace wavemesh {

std::vector<std::uint8_t> RangeEncoder::finish()
{
	// The shortest byte string all of whose continuations lie in [low, high].
	for (int count = 0; count <= 4; ++count) {
		const std::uint32_t free  = count == 4 ? 0 : ~std::uint32_t {0} >> (8 * count);
		const std::uint64_t value = (std::uint64_t(low_) + free) & ~std::uint64_t(free);
		if (value + free > high_)
			continue;
		for (int i = 0; i < count; ++i)
			bytes_.push_back(static_cast<std::uint8_t>(value >> (24 - 8 * i)));
		break;
	}
	std::vector<std::uint8_t> out;
	out.swap(bytes_);
	low_  = 0;
	high_ = ~std::uint32_t {0};
	return out;
}

std::size_t RangeEncoder::prefix(const std::vector<std::uint8_t>& stream, const Mark& mark)
{
	std::uint32_t known = 0, free = ~std::uint32_t {0};
	std::size_t size = mark.size;
	// Whatever follows, the next four bytes lie in [known, known + free].
	for (; size < stream.size() && (known < mark.low || known + free > mark.high); ++size) {
		free >>= 8;
		known |= std::uint32_t(stream[size]) << (24 - 8 * (size - mark.size));
	}
	return size;
}

} // namespace wavemesh
