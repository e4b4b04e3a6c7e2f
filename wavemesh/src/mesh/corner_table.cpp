// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/corner_table.h"

namespace wavemesh {

Status checkCounts(std::size_t vertices, std::size_t faces)
{
	const bool tooManyVertices = vertices > kMostElements;
	if (!tooManyVertices && faces <= kMostElements)
		return {};
	return {
	    StatusCode::LimitExceeded,
	    "the mesh has " + std::to_string(tooManyVertices ? vertices : faces) +
	        (tooManyVertices ? " vertices" : " faces") + ", more than the " +
	        std::to_string(kMostElements) + " that a .wmc can hold: split it"};
}

std::vector<Index> firstCorners(const CornerTable& table)
{
	std::vector<Index> first(table.vertexCount, kNone);
	for (Index f = 0; f < table.cornerCount(); f += 3)
		for (Index k = 0; k < 3; ++k) {
			const bool fanBegins = table.opposite[f + (k + 2) % 3] == kNone;
			Index& c             = first[table.vertex[f + k]];
			if (c == kNone || fanBegins)
				c = f + k;
		}
	return first;
}

std::vector<Index> valences(const CornerTable& table)
{
	std::vector<Index> valence(table.vertexCount, 0);
	for (Index f = 0; f < table.cornerCount(); f += 3)
		for (Index k = 0; k < 3; ++k) {
			// a boundary fan has one edge more than faces
			const bool fanBegins = table.opposite[f + (k + 2) % 3] == kNone;
			valence[table.vertex[f + k]] += fanBegins ? 2 : 1;
		}
	return valence;
}

namespace {

/// Edges out of each vertex, as one array and offsets.
struct VertexFans
{
	struct Spoke
	{
		Index to;
		Index facing; ///< corner that faces the edge
	};
	std::vector<Index> begin;  ///< #V + 1
	std::vector<Spoke> spokes; ///< #corners

	explicit VertexFans(const CornerTable& t) :
	        begin(std::size_t(t.vertexCount) + 1, 0), spokes(t.cornerCount())
	{
		for (const Index v : t.vertex)
			++begin[v];
		Index sum = 0;
		for (Index& b : begin)
			b = sum += b;
		// Filled from the back: what is left is where each vertex begins.
		for (Index f = t.cornerCount(); f > 0;) {
			f -= 3;
			for (Index k = 3; k-- > 0;)
				spokes[--begin[t.vertex[f + k]]] = {t.vertex[f + (k + 1) % 3], f + (k + 2) % 3};
		}
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
			const Index to = fans.spokes[i].to;
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
	for (Index from = 0; from < t.vertexCount; ++from)
		for (Index i = fans.begin[from]; i < fans.begin[from + 1]; ++i) {
			const auto [to, facing] = fans.spokes[i];
			if (t.opposite[facing] != kNone || fans.size(to) > fans.size(from))
				continue;
			for (Index k = fans.begin[to]; k < fans.begin[to + 1]; ++k)
				if (fans.spokes[k].to == from) {
					t.link(facing, fans.spokes[k].facing);
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

std::vector<Index>
matchCorners(const CornerTable& coded, const CornerTable& own, const std::vector<Index>& source)
{
	const std::vector<Index> first = firstCorners(own), valence = valences(own);
	std::vector<Index> match(coded.cornerCount());
	for (Index f = 0; f < coded.faceCount(); ++f) {
		// From the corner with the smallest fan.
		Index c = 3 * f;
		for (const Index other : {3 * f + 1, 3 * f + 2})
			if (valence[source[coded.vertex[other]]] < valence[source[coded.vertex[c]]])
				c = other;
		const Index to = source[coded.vertex[nextCorner(c)]];
		Index mine     = first[source[coded.vertex[c]]];
		while (own.vertex[nextCorner(mine)] != to)
			mine = own.swingLeft(mine);
		match[c]             = mine;
		match[nextCorner(c)] = nextCorner(mine);
		match[prevCorner(c)] = prevCorner(mine);
	}
	return match;
}

Result<CornerTable>
buildCornerTable(const std::vector<std::array<std::uint32_t, 3>>& triangles, Index vertexCount)
{
	CornerTable t;
	t.vertexCount = vertexCount;
	t.vertex.resize(3 * triangles.size());
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
		for (std::size_t k = 0; k < 3; ++k)
			t.vertex[3 * f + k] = tri[k];
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
