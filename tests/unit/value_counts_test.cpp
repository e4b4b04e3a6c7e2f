// SPDX-License-Identifier: GPL-3.0-or-later
// How often each value came up.
#include "predict/value_counts.h"
#include "rng.h"

#include <gtest/gtest.h>

namespace wavemesh::test {
namespace {

TEST(ValueCounts, AreThoseOfAPlainArray)
{
	Rng rng(706);
	for (const std::uint32_t size : {1u, 2u, 3u, 64u, 100u, 1000u, 65536u}) {
		ValueCounts counts(size);
		std::vector<std::uint32_t> plain(size, 0);
		for (int i = 0; i < 500; ++i) {
			const std::uint32_t value = i % 50 == 0 ? size - 1 : i % 50 == 1 ? 0 : rng.below(size);
			counts.add(value);
			++plain[value];
			const std::uint32_t end = rng.below(size + 1);
			std::uint32_t below     = 0;
			for (std::uint32_t v = 0; v < end; ++v)
				below += plain[v];
			ASSERT_EQ(counts.below(end), below) << size;
		}
		EXPECT_EQ(counts.below(0), 0u);
		EXPECT_EQ(counts.below(size), 500u);
	}
}

} // namespace
} // namespace wavemesh::test
