// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Points without any order or connectivity: the lattice box is halved again and again, and the
/// points in the lower half are counted.
///
/// Source: P.-M. Gandoin and O. Devillers, 2002 (the kd-tree of counts).
#pragma once

#include "entropy/models.h"
#include "mesh/corner_table.h"

#include <algorithm>

namespace wavemesh {

template <class Coder>
class PointSetSyntax
{
public:
	explicit PointSetSyntax(Coder& coder) : coder_(coder) {}

	/// @param points  reading: out, `count` points in the coded order; writing: in any order with
	///                coordinates 0..2^bits - 1
	/// @return writing: `points` in the coded order, by row
	/// Linear in count * bits. Reading leaves fewer points where the data end.
	std::vector<Index> code(std::vector<LatticePoint>& points, Index count, int bits)
	{
		if constexpr (!Coder::kReading) {
			points_ = points.data();
			rows_.resize(count);
			for (Index i = 0; i < count; ++i)
				rows_[i] = i;
		}
		std::vector<Cell> open;
		if (count != 0)
			open.push_back({0, count, {0, 0, 0}, {bits, bits, bits}});
		while (!open.empty() && !coder_.exhausted()) {
			const Cell cell = open.back();
			open.pop_back();
			const std::size_t axis = longest(cell);
			if (cell.bits[axis] == 0) {
				if constexpr (Coder::kReading)
					points.insert(points.end(), cell.count, cell.low);
				continue;
			}
			Cell lower = cell, upper = cell;
			lower.bits[axis] = upper.bits[axis] = cell.bits[axis] - 1;
			upper.low[axis] += 1 << upper.bits[axis];
			lower.count = codeLower(countBelow(cell, axis, upper.low[axis]), cell.count, axis);
			upper.count = cell.count - lower.count;
			upper.begin = cell.begin + lower.count;
			if (upper.count != 0)
				open.push_back(upper);
			if (lower.count != 0)
				open.push_back(lower);
		}
		return std::move(rows_);
	}

private:
	struct Cell
	{
		Index begin, count; ///< begin: writing, in rows_
		LatticePoint low;
		std::array<int, 3> bits; ///< of each side
	};

	static std::size_t longest(const Cell& cell)
	{
		std::size_t axis = 0;
		for (std::size_t k = 1; k < 3; ++k)
			if (cell.bits[k] > cell.bits[axis])
				axis = k;
		return axis;
	}

	/// Writing: moves the points below `middle` to the front of the cell and counts them.
	Index countBelow(const Cell& cell, std::size_t axis, std::int32_t middle)
	{
		if constexpr (Coder::kReading)
			return 0;
		else {
			const auto begin = rows_.begin() + std::ptrdiff_t(cell.begin);
			const auto split =
			    std::stable_partition(begin, begin + std::ptrdiff_t(cell.count), [&](Index row) {
				    return points_[row][axis] < middle;
			    });
			return Index(split - begin);
		}
	}

	Index codeLower(Index lower, Index count, std::size_t axis)
	{
		if (count == 1)
			return Index(codeBit(coder_, single_[axis], lower == 1, 255));
		Models& m = models_[axis][std::size_t(std::min(bitLength(count), 16))];
		if (codeBit(coder_, m.together, lower == 0 || lower == count, 60))
			return codeBit(coder_, m.below, lower == count, 60) ? count : 0;
		// Between 1 and count - 1, mostly near the half.
		const std::int64_t half = count / 2;
		const std::int64_t read = half + m.fromHalf.code(coder_, std::int64_t(lower) - half);
		return Index(std::clamp<std::int64_t>(read, 1, std::int64_t(count) - 1));
	}

	struct Models
	{
		AdaptiveBit together, below;
		AdaptiveSigned<32> fromHalf;
	};
	Coder& coder_;
	std::array<std::array<Models, 17>, 3> models_; ///< by axis and length of the count
	std::array<AdaptiveBit, 3> single_;

	// Writing only.
	const LatticePoint* points_ = nullptr;
	std::vector<Index> rows_;
};

} // namespace wavemesh
