// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_check.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace wavemesh::test {

namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

std::string name(Edge e)
{
	return "edge " + std::to_string(e.first) + "-" + std::to_string(e.second);
}

std::string checkArrays(const MeshData& mesh)
{
	const auto n = mesh.positions.size();
	std::vector<bool> used(n, false);
	for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
		const auto& t = mesh.triangles[f];
		for (std::uint32_t v : t) {
			if (v >= n)
				return "face " + std::to_string(f) + " refers to vertex " + std::to_string(v);
			used[v] = true;
		}
		if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
			return "face " + std::to_string(f) + " is degenerate";
	}
	for (std::size_t v = 0; v < n; ++v) {
		if (!used[v])
			return "vertex " + std::to_string(v) + " is isolated";
		for (double x : mesh.positions[v])
			if (!std::isfinite(x))
				return "vertex " + std::to_string(v) + " is not finite";
	}
	return {};
}

/// Directed edges sorted; no two the same, which also excludes duplicate faces of one orientation.
std::string checkEdges(const std::vector<Edge>& edges)
{
	for (std::size_t i = 1; i < edges.size(); ++i)
		if (edges[i] == edges[i - 1])
			return name(edges[i]) + " has more than two faces or faces of unlike orientation";
	return {};
}

/// A vertex is regular if its faces form one fan: #faces = #neighbours (closed) or #neighbours - 1
/// (open, two boundary edges) and the fan is connected.
std::string checkFans(const MeshData& mesh, const std::vector<Edge>& edges)
{
	const auto n = mesh.positions.size();
	std::vector<std::vector<Edge>> fan(n); // of v: (next, previous) of each face
	for (const auto& t : mesh.triangles)
		for (std::size_t k = 0; k < 3; ++k)
			fan[t[k]].push_back({t[(k + 1) % 3], t[(k + 2) % 3]});
	for (std::uint32_t v = 0; v < n; ++v) {
		auto& f = fan[v];
		std::sort(f.begin(), f.end());
		// Start at the face whose first edge is on the boundary, if there is one.
		auto at = f.begin();
		for (auto i = f.begin(); i != f.end(); ++i)
			if (!std::binary_search(edges.begin(), edges.end(), Edge {i->first, v}))
				at = i;
		std::size_t steps = 0;
		for (auto i = at; i != f.end() && steps <= f.size();) {
			++steps;
			const std::uint32_t next = i->second;
			i                        = std::lower_bound(f.begin(), f.end(), Edge {next, 0});
			if (i == at || i == f.end() || i->first != next)
				break;
		}
		if (steps != f.size())
			return "vertex " + std::to_string(v) + " joins more than one fan of faces";
	}
	return {};
}

std::uint32_t rootOf(std::vector<std::uint32_t>& parent, std::uint32_t v)
{
	while (parent[v] != v)
		v = parent[v] = parent[parent[v]];
	return v;
}

std::uint32_t countRoots(std::vector<std::uint32_t>& parent, const std::vector<bool>& take)
{
	std::uint32_t roots = 0;
	for (std::uint32_t v = 0; v < parent.size(); ++v)
		roots += take[v] && rootOf(parent, v) == v;
	return roots;
}

Topology measure(const MeshData& mesh, const std::vector<Edge>& edges)
{
	const auto n = mesh.positions.size();
	std::vector<std::uint32_t> all(n), rim(n);
	std::iota(all.begin(), all.end(), 0u);
	rim = all;
	std::vector<bool> onRim(n, false);
	Topology t;
	std::int64_t e = 0;
	for (Edge edge : edges) {
		all[rootOf(all, edge.first)] = rootOf(all, edge.second);
		const bool inner =
		    std::binary_search(edges.begin(), edges.end(), Edge {edge.second, edge.first});
		e += inner ? 1 : 2;
		if (inner)
			continue;
		++t.boundaryEdges;
		onRim[edge.first] = onRim[edge.second] = true;
		rim[rootOf(rim, edge.first)]           = rootOf(rim, edge.second);
	}
	t.components    = countRoots(all, std::vector<bool>(n, true));
	t.boundaryLoops = countRoots(rim, onRim);
	t.euler =
	    static_cast<std::int64_t>(n) - e / 2 + static_cast<std::int64_t>(mesh.triangles.size());
	t.genus = (2 * std::int64_t {t.components} - std::int64_t {t.boundaryLoops} - t.euler) / 2;
	return t;
}

} // namespace

std::string whatIsNotManifold(const MeshData& mesh, Topology* topology)
{
	if (std::string s = checkArrays(mesh); !s.empty())
		return s;
	std::vector<Edge> edges;
	edges.reserve(mesh.triangles.size() * 3);
	for (const auto& t : mesh.triangles)
		for (std::size_t k = 0; k < 3; ++k)
			edges.push_back({t[k], t[(k + 1) % 3]});
	std::sort(edges.begin(), edges.end());
	if (std::string s = checkEdges(edges); !s.empty())
		return s;
	if (std::string s = checkFans(mesh, edges); !s.empty())
		return s;
	auto faces = mesh.triangles;
	for (auto& t : faces)
		std::sort(t.begin(), t.end());
	std::sort(faces.begin(), faces.end());
	for (std::size_t i = 1; i < faces.size(); ++i)
		if (faces[i] == faces[i - 1])
			return "two faces have the same three vertices";
	if (topology)
		*topology = measure(mesh, edges);
	return {};
}

} // namespace wavemesh::test
