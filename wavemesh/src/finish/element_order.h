// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The original's numbering of a restored mesh.
#pragma once

#include "finish/restoration.h"

namespace wavemesh {

struct ElementOrder
{
	std::vector<Index> face;         ///< #F: the restored face that is the original's i-th
	std::vector<std::uint8_t> first; ///< #F: which of its corners comes first there
	std::vector<Index> vertex;       ///< #V: the original's number of each restored vertex

	bool empty() const { return vertex.empty(); }
};

/// Order of `original`, whose elements are those of `restored`.
ElementOrder
orderOf(const Triangles& original, const RestoredMesh& restored, const RestoredSource& source);

/// The restored triangles in the original's order and numbering.
Triangles inOrder(const Triangles& restored, const ElementOrder& order);

/// Rows of the restored vertices in the original's order.
template <class Row>
std::vector<Row> inOrder(const std::vector<Row>& rows, const ElementOrder& order)
{
	std::vector<Row> out(rows.size());
	for (std::size_t v = 0; v < rows.size(); ++v)
		out[order.vertex[v]] = rows[v];
	return out;
}

} // namespace wavemesh
