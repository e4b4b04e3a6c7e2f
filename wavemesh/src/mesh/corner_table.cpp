// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/corner_table.h"

namespace wavemesh {

std::vector<Index> firstCorners(const CornerTable& table)
{
	std::vector<Index> first(table.vertexCount, kNone);
	for (Index c = 0; c < table.cornerCount(); ++c) {
		const Index v = table.vertex[c];
		if (first[v] == kNone || table.swingRight(c) == kNone)
			first[v] = c;
	}
	return first;
}

std::vector<Index> valences(const CornerTable& table)
{
	std::vector<Index> valence(table.vertexCount, 0);
	for (Index c = 0; c < table.cornerCount(); ++c) {
		++valence[table.vertex[c]];
		if (table.swingRight(c) == kNone)
			++valence[table.vertex[c]]; // a boundary fan has one edge more than faces
	}
	return valence;
}

namespace {

/// Corners sorted by vertex, as one array and offsets.
struct VertexFans
{
	std::vector<Index> begin;   ///< #V + 1
	std::vector<Index> corners; ///< #corners

	explicit VertexFans(const CornerTable& t) :
	        begin(std::size_t(t.vertexCount) + 1, 0), corners(t.cornerCount())
	{
		for (const Index v : t.vertex)
			++begin[v + 1];
		for (Index v = 0; v < t.vertexCount; ++v)
			begin[v + 1] += begin[v];
		std::vector<Index> at(begin.begin(), begin.end() - 1);
		for (Index c = 0; c < t.cornerCount(); ++c)
			corners[at[t.vertex[c]]++] = c;
	}
	Index size(Index v) const { return begin[v + 1] - begin[v]; }
};

std::string edgeName(Index a, Index b)
{
	return "edge " + std::to_string(a) + "-" + std::to_string(b);
}

/// No two faces may run along the same edge in the same direction.
Status checkDirectedEdges(const CornerTable& t, const VertexFans& fans)
{
	std::vector<Index> seenFrom(t.vertexCount, kNone);
	for (Index v = 0; v < t.vertexCount; ++v) {
		if (fans.size(v) == 0)
			return {StatusCode::Unsupported, "vertex " + std::to_string(v) + " belongs to no face"};
		for (Index i = fans.begin[v]; i < fans.begin[v + 1]; ++i) {
			const Index to = t.vertex[nextCorner(fans.corners[i])];
			if (seenFrom[to] == v)
				return {
				    StatusCode::Unsupported,
				    edgeName(v, to) + " is non-manifold or its faces are oriented inconsistently"};
			seenFrom[to] = v;
		}
	}
	return {};
}

/// Links each edge from the end with the smaller fan, so that hubs cost nothing.
void linkEdges(CornerTable& t, const VertexFans& fans)
{
	for (Index c = 0; c < t.cornerCount(); ++c) {
		const Index to     = t.vertex[nextCorner(c)];
		const Index from   = t.vertex[c];
		const Index facing = prevCorner(c); // faces the edge from -> to
		if (t.opposite[facing] != kNone || fans.size(to) > fans.size(from))
			continue;
		for (Index i = fans.begin[to]; i < fans.begin[to + 1]; ++i)
			if (t.vertex[nextCorner(fans.corners[i])] == from) {
				t.link(facing, prevCorner(fans.corners[i]));
				break;
			}
	}
}

/// Each vertex must have one fan.
Status checkFans(const CornerTable& t, const VertexFans& fans)
{
	const std::vector<Index> first = firstCorners(t);
	for (Index v = 0; v < t.vertexCount; ++v) {
		Index count = 0, c = first[v];
		do {
			++count;
			c = t.swingLeft(c);
		} while (c != kNone && c != first[v]);
		if (count != fans.size(v))
			return {
			    StatusCode::Unsupported,
			    "vertex " + std::to_string(v) + " is non-manifold (its faces form several fans)"};
	}
	return {};
}

} // namespace

Result<CornerTable>
buildCornerTable(const std::vector<std::array<std::uint32_t, 3>>& triangles, Index vertexCount)
{
	CornerTable t;
	t.vertexCount = vertexCount;
	t.vertex.reserve(3 * triangles.size());
	for (std::size_t f = 0; f < triangles.size(); ++f) {
		const auto& tri = triangles[f];
		for (const Index v : tri)
			if (v >= vertexCount)
				return Status(
				    StatusCode::InvalidArgument, "face " + std::to_string(f) +
				                                     " refers to vertex " + std::to_string(v) +
				                                     ", which does not exist");
		if (tri[0] == tri[1] || tri[1] == tri[2] || tri[2] == tri[0])
			return Status(StatusCode::Unsupported, "face " + std::to_string(f) + " is degenerate");
		t.vertex.insert(t.vertex.end(), tri.begin(), tri.end());
	}
	t.opposite.assign(t.vertex.size(), kNone);

	const VertexFans fans(t);
	if (Status s = checkDirectedEdges(t, fans); !s.ok())
		return s;
	linkEdges(t, fans);
	if (Status s = checkFans(t, fans); !s.ok())
		return s;
	return t;
}

} // namespace wavemesh
