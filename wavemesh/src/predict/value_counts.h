// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How often each value of a coordinate came up so far: CAD meshes repeat theirs all over.
#pragma once

#include <cstdint>
#include <vector>

namespace wavemesh {

/// Counts of values 0 .. size-1 with their running sums (P. Fenwick 1994). Both O(log size).
class ValueCounts
{
public:
	explicit ValueCounts(std::size_t size) : sums_(size + 1, 0) {}

	/// @pre value < size
	void add(std::uint32_t value)
	{
		for (std::size_t i = std::size_t(value) + 1; i < sums_.size(); i += i & (~i + 1))
			++sums_[i];
	}
	/// How many were below `value`. @pre value <= size
	std::uint32_t below(std::uint32_t value) const
	{
		std::uint32_t sum = 0;
		for (std::size_t i = value; i > 0; i &= i - 1)
			sum += sums_[i];
		return sum;
	}

private:
	std::vector<std::uint32_t> sums_;
};

} // namespace wavemesh
