// SPDX-License-Identifier: GPL-3.0-or-later
#include "multires/seams.h"

#include "multires/coarsen.h"

#include <algorithm>

namespace wavemesh {

Seams::Seams(const CornerTable& table, const std::vector<std::uint8_t>& onSeam)
{
	std::vector<std::uint8_t> meets(table.vertexCount, 0);
	for (Index c = 0; c < table.cornerCount(); ++c)
		if (onSeam[c])
			meets[table.vertex[nextCorner(c)]] = meets[table.vertex[prevCorner(c)]] = 1;
	if (std::count(meets.begin(), meets.end(), 1) == 0)
		return;
	along_.resize(table.vertexCount, {kNone, kNone});
	const auto add = [&](Index v, Index neighbour) {
		auto& n = along_[v];
		if (!meets[v] || n[0] == v)
			return;
		if (n[0] == kNone)
			n[0] = neighbour;
		else if (n[1] == kNone)
			n[1] = neighbour;
		else
			n = {v, v};
	};
	for (Index c = 0; c < table.cornerCount(); ++c) {
		const Index d = table.opposite[c];
		if (d == kNone || (onSeam[c] && c < d)) {
			add(table.vertex[nextCorner(c)], table.vertex[prevCorner(c)]);
			add(table.vertex[prevCorner(c)], table.vertex[nextCorner(c)]);
		}
	}
	for (Index v = 0; v < table.vertexCount; ++v)
		if (along_[v][0] != kNone && along_[v][1] == kNone)
			along_[v] = {v, v};
}

void Seams::carry(const Coarsening& step)
{
	if (!any())
		return;
	std::vector<Index> coarse(along_.size(), kNone);
	for (Index v = 0; v < step.fineVertex.size(); ++v)
		coarse[step.fineVertex[v]] = v;
	std::vector<std::array<Index, 2>> out;
	out.reserve(step.fineVertex.size());
	for (const Index v : step.fineVertex) {
		auto n = along_[v];
		for (Index& to : n) {
			if (to != kNone && coarse[to] == kNone) // gone: the seam leads on behind it
				to = along_[to][along_[to][0] == v ? 1 : 0];
			if (to != kNone)
				to = coarse[to];
		}
		out.push_back(n);
	}
	along_ = std::move(out);
}

} // namespace wavemesh
