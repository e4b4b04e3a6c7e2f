// SPDX-License-Identifier: GPL-3.0-or-later
#include "entropy/logarithm.h"

namespace wavemesh {
namespace {

/// log2(x / 2^30) in 1/4096 for 2^30 <= x < 2^31: each squaring tells one more binary digit.
constexpr std::uint16_t fractionOfLog2(std::uint64_t x)
{
	std::uint32_t digits = 0;
	for (int i = 0; i < 12; ++i) {
		x      = (x * x) >> 30;
		digits = 2 * digits + std::uint32_t(x >> 31);
		x >>= x >> 31;
	}
	return static_cast<std::uint16_t>(digits);
}

} // namespace

constexpr LogarithmTables::LogarithmTables() :
        log2(), exp2 {4096, 4466, 4870, 5311, 5792, 6316, 6888, 7512}
{
	for (std::size_t i = 0; i < log2.size(); ++i)
		log2[i] = fractionOfLog2((std::uint64_t(1024) + i) << 20);
}

constexpr LogarithmTables kLogarithm;

} // namespace wavemesh
