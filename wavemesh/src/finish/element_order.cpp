// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish/element_order.h"

namespace wavemesh {

ElementOrder
orderOf(const Triangles& original, const RestoredMesh& restored, const RestoredSource& source)
{
	ElementOrder order;
	order.vertex = source.vertex;
	order.face.resize(restored.triangles.size());
	order.first.resize(restored.triangles.size(), 0);
	for (Index f = 0; f < restored.triangles.size(); ++f) {
		const Index i = source.face[f];
		order.face[i] = f;
		const auto& t = restored.triangles[f];
		for (std::uint8_t first = 0; first < 3; ++first) {
			bool same = true;
			for (std::size_t k = 0; k < 3; ++k)
				same = same && source.vertex[t[(first + k) % 3]] == original[i][k];
			if (same) {
				order.first[i] = first;
				break;
			}
		}
	}
	return order;
}

Triangles inOrder(const Triangles& restored, const ElementOrder& order)
{
	Triangles out(restored.size());
	for (std::size_t i = 0; i < out.size(); ++i)
		for (std::size_t k = 0; k < 3; ++k)
			out[i][k] = order.vertex[restored[order.face[i]][(order.first[i] + k) % 3]];
	return out;
}

} // namespace wavemesh
