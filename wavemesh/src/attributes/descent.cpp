// SPDX-License-Identifier: GPL-3.0-or-later
#include "attributes/descent.h"

namespace wavemesh {
namespace {

/// The corner of face f at vertex v, or kNone.
Index cornerAt(const CornerTable& table, Index f, Index v)
{
	for (Index c = 3 * f; c < 3 * f + 3; ++c)
		if (table.vertex[c] == v)
			return c;
	return kNone;
}

/// #F_j: descendants of a face are contiguous, in the order of the faces.
std::vector<Index> parentFaces(const CornerTable& parent, const Refinement& r)
{
	std::vector<Index> faces;
	for (Index f = 0; f < parent.faceCount(); ++f) {
		const int splits = faceShape(r.childOnEdge, f).splits;
		faces.insert(faces.end(), r.faceCode[f] == kFaceCentre ? 3 : std::size_t(splits + 1), f);
	}
	return faces;
}

/// A corner that a flip put into a face that its vertex does not come from takes what the one
/// before it in the fan has, else the one behind.
void fillGaps(const Fans& fans, std::vector<std::array<Index, 2>>& corner)
{
	for (std::size_t v = 0; v + 1 < fans.begin.size(); ++v) {
		std::array<Index, 2> last {kNone, kNone};
		const auto fill = [&](Index c) {
			if (corner[c][0] == kNone)
				corner[c] = last;
			else
				last = corner[c];
		};
		for (Index i = fans.begin[v]; i < fans.begin[v + 1]; ++i)
			fill(fans.corner[i]);
		for (Index i = fans.begin[v + 1]; i-- > fans.begin[v];)
			fill(fans.corner[i]);
	}
}

} // namespace

Fans::Fans(const CornerTable& table)
{
	const std::vector<Index> first = firstCorners(table);
	begin.reserve(table.vertexCount + 1);
	corner.reserve(table.cornerCount());
	for (const Index start : first) {
		begin.push_back(Index(corner.size()));
		Index c = start;
		while (c != kNone && corner.size() < table.cornerCount()) {
			corner.push_back(c);
			c = table.swingLeft(c);
			if (c == start)
				break;
		}
	}
	begin.push_back(Index(corner.size()));
}

Descent descentOf(
    const CornerTable& parent,
    const CornerTable& child,
    const Refinement& r,
    const Parents& parents,
    const Fans& fans)
{
	Descent d;
	d.edge.assign(parents.size(), kNone);
	forEachSplitEdge(
	    parent, r.childOnEdge, [&](Index c, Index v) { d.edge[v - r.parentVertices] = c; });
	d.face = parentFaces(parent, r);
	d.corner.resize(child.cornerCount(), {kNone, kNone});
	for (Index c = 0; c < child.cornerCount(); ++c) {
		const Index f = d.face[c / 3], v = child.vertex[c];
		if (v < r.parentVertices)
			d.corner[c] = {cornerAt(parent, f, v), kNone};
		else {
			const auto& p = parents[v - r.parentVertices];
			const Index a = cornerAt(parent, f, p[0]), b = cornerAt(parent, f, p[1]);
			if (a != kNone && b != kNone)
				d.corner[c] = {a, b};
		}
	}
	fillGaps(fans, d.corner);
	return d;
}

} // namespace wavemesh
