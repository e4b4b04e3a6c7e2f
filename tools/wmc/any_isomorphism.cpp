// SPDX-License-Identifier: GPL-3.0-or-later
#include "any_isomorphism.h"

#include <algorithm>
#include <map>

namespace wavemesh::tool {
namespace {

using Colours  = std::vector<std::uint64_t>; ///< #V
using Triangle = std::array<std::uint32_t, 3>;

std::uint64_t mixed(std::uint64_t x)
{
	x = (x ^ (x >> 31)) * 0x9e3779b97f4a7c15u;
	x = (x ^ (x >> 29)) * 0xbf58476d1ce4e5b9u;
	return x ^ (x >> 32);
}

Colours coloursOf(const LabelledMesh& m)
{
	Colours colours;
	colours.reserve(m.labels.size());
	for (const auto& label : m.labels) {
		std::uint64_t colour = 1;
		for (const std::int64_t x : label)
			colour = mixed(colour * 3 + std::uint64_t(x));
		colours.push_back(colour);
	}
	return colours;
}

Colours sorted(Colours colours)
{
	std::sort(colours.begin(), colours.end());
	return colours;
}

std::size_t classes(const Colours& inOrder)
{
	std::size_t n = inOrder.empty() ? 0 : 1;
	for (std::size_t i = 1; i < inOrder.size(); ++i)
		n += inOrder[i] != inOrder[i - 1];
	return n;
}

/// Each vertex's colour takes on those around it.
void spread(const LabelledMesh& m, Colours& colours)
{
	Colours next = colours;
	for (const Triangle& t : m.triangles)
		for (std::size_t k = 0; k < 3; ++k)
			next[t[k]] += mixed(
			    colours[t[k]] +
			    mixed(colours[t[(k + 1) % 3]] * 5 + mixed(colours[t[(k + 2) % 3]])));
	for (std::uint64_t& c : next)
		c = mixed(c);
	colours = std::move(next);
}

/// Spreads both until no class splits any more; false if they turn out different.
bool refineBoth(const LabelledMesh& a, const LabelledMesh& b, Colours& ofA, Colours& ofB)
{
	for (std::size_t before = 0;;) {
		const Colours inOrder = sorted(ofA);
		if (inOrder != sorted(ofB))
			return false;
		const std::size_t now = classes(inOrder);
		if (now == before || now == ofA.size())
			return true;
		before = now;
		spread(a, ofA);
		spread(b, ofB);
	}
}

/// For each vertex the lowest of its component.
std::vector<std::uint32_t> componentsOf(const LabelledMesh& m)
{
	std::vector<std::uint32_t> root(m.labels.size());
	for (std::uint32_t v = 0; v < root.size(); ++v)
		root[v] = v;
	const auto find = [&](std::uint32_t v) {
		while (root[v] != v)
			v = root[v] = root[root[v]];
		return v;
	};
	for (const Triangle& t : m.triangles)
		for (std::size_t k = 1; k < 3; ++k) {
			const std::uint32_t p = find(t[0]), q = find(t[k]);
			root[std::max(p, q)] = std::min(p, q);
		}
	for (std::uint32_t v = 0; v < root.size(); ++v)
		root[v] = find(v);
	return root;
}

/// Vertices by colour.
std::map<std::uint64_t, std::vector<std::uint32_t>> byColour(const Colours& colours)
{
	std::map<std::uint64_t, std::vector<std::uint32_t>> rows;
	for (std::uint32_t v = 0; v < colours.size(); ++v)
		rows[colours[v]].push_back(v);
	return rows;
}

/// Pairs one vertex of a class that is still mixed with one of the other mesh; in one go for
/// classes that have nothing to do with each other.
void tellApart(const LabelledMesh& a, Colours& ofA, Colours& ofB)
{
	const auto inA = byColour(ofA), inB = byColour(ofB);
	const auto component = componentsOf(a);
	std::vector<std::vector<std::uint32_t>> members(a.labels.size());
	for (std::uint32_t v = 0; v < component.size(); ++v)
		members[component[v]].push_back(v);
	std::map<std::uint64_t, bool> taken;
	std::uint64_t fresh = 0x5851f42d4c957f2du;
	const Colours old   = ofA;
	for (const auto& [colour, rows] : inA) {
		if (rows.size() < 2 || taken[colour])
			continue;
		for (const std::uint32_t v : members[component[rows[0]]])
			taken[old[v]] = true;
		fresh                     = mixed(fresh + colour);
		ofA[rows[0]]              = fresh;
		ofB[inB.at(colour).at(0)] = fresh;
	}
}

/// Faces in b's numbering, turned so that the lowest vertex comes first, in order.
std::vector<Triangle>
canonical(std::vector<Triangle> triangles, const std::vector<std::uint32_t>& to)
{
	for (Triangle& t : triangles) {
		for (std::uint32_t& v : t)
			v = to[v];
		Triangle best = t;
		for (int turn = 0; turn < 2; ++turn) {
			std::rotate(t.begin(), t.begin() + 1, t.end());
			best = std::min(best, t);
		}
		t = best;
	}
	std::sort(triangles.begin(), triangles.end());
	return triangles;
}

} // namespace

std::string whatDiffersInAnyMesh(const LabelledMesh& a, const LabelledMesh& b)
{
	if (a.labels.size() != b.labels.size())
		return "the numbers of vertices differ";
	if (a.triangles.size() != b.triangles.size())
		return "the numbers of faces differ";
	Colours ofA = coloursOf(a), ofB = coloursOf(b);
	if (sorted(ofA) != sorted(ofB))
		return "the vertices have other positions";
	constexpr int kRounds = 400;
	for (int round = 0; round < kRounds; ++round) {
		if (!refineBoth(a, b, ofA, ofB))
			return round == 0 ? "the faces connect other vertices"
			                  : "no way was found to match the vertices";
		if (classes(sorted(ofA)) == ofA.size())
			break;
		tellApart(a, ofA, ofB);
	}
	std::vector<std::uint32_t> to(ofA.size()), same(ofA.size());
	const auto inA = byColour(ofA), inB = byColour(ofB);
	for (const auto& [colour, rows] : inA) {
		const auto at = inB.find(colour);
		if (at == inB.end() || at->second.size() != rows.size())
			return "the faces connect other vertices";
		for (std::size_t i = 0; i < rows.size(); ++i)
			to[rows[i]] = at->second[i];
	}
	for (std::uint32_t v = 0; v < same.size(); ++v)
		same[v] = v;
	for (std::size_t v = 0; v < to.size(); ++v)
		if (a.labels[v] != b.labels[to[v]])
			return "the vertices have other positions";
	return canonical(a.triangles, to) == canonical(b.triangles, same)
	           ? std::string()
	           : "the faces connect other vertices";
}

} // namespace wavemesh::tool
