// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Points of an octahedron, each next to the one expected: the two coordinates that lie across the
/// expected direction, then on which side it is.
#pragma once

#include "attributes/octahedron.h"
#include "syntax/lattice_syntax.h"

namespace wavemesh {

class NormalSyntax
{
public:
	/// @param bits  the radius is 2^(bits - 1)
	explicit NormalSyntax(int bits) :
	        radius_(1 << (bits - 1)), columns_(2, {0, 1, bits + 1, true}), across_(columns_)
	{
	}
	NormalSyntax(const NormalSyntax&)            = delete;
	NormalSyntax& operator=(const NormalSyntax&) = delete;

	/// @param row, expected  three coordinates
	template <class Coder>
	void code(Coder& coder, double* row, const double* expected)
	{
		const std::size_t w = dominantAxis<double>({expected[0], expected[1], expected[2]});
		const std::size_t u = (w + 1) % 3, v = (w + 2) % 3;
		double cells[2]      = {row[u] + radius_, row[v] + radius_};
		const double near[2] = {expected[u] + radius_, expected[v] + radius_};
		across_.code(coder, cells, {near, nullptr, nullptr, nullptr});
		row[u]            = cells[0] - radius_;
		row[v]            = cells[1] - radius_;
		const double left = std::max(0.0, radius_ - std::abs(row[u]) - std::abs(row[v]));
		const bool turned = left > 0 && codeBit(coder, turned_, (row[w] < 0) != (expected[w] < 0));
		// Never -0: numbers are compared bit for bit.
		row[w] = left > 0 && turned != (expected[w] < 0) ? -left : left;
	}

private:
	int radius_;
	std::vector<Column> columns_;
	LatticeSyntax across_;
	AdaptiveBit turned_;
};

} // namespace wavemesh
