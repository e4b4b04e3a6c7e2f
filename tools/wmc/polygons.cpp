// SPDX-License-Identifier: GPL-3.0-or-later
#include "polygons.h"

#include <algorithm>
#include <array>
#include <unordered_map>

namespace wavemesh::tool {
namespace {

using Corner = std::uint32_t;

constexpr Corner kNone = ~Corner {0};

/// An edge is named by the corner it begins at.
Corner next(Corner c)
{
	return c % 3 == 2 ? c - 2 : c + 1;
}

class Joiner
{
public:
	Joiner(const MeshData& mesh, const std::function<bool(Corner, Corner)>& alike) :
	        mesh_(mesh), alike_(alike), inside_(3 * mesh.triangles.size(), 0)
	{
		for (const Attribute& a : mesh.attributes)
			if (a.of == AttributeOf::Face && a.kind == AttributeKind::FauxEdges &&
			    a.components == 1)
				for (Corner c = 0; c < inside_.size(); ++c)
					inside_[c] = std::uint8_t(unsigned(a.values[c / 3]) >> c % 3 & 1);
		for (Corner c = 0; c < inside_.size(); ++c)
			if (inside_[c])
				if (const auto [it, isNew] = cornerOf_.insert({key(c, next(c)), c}); !isNew)
					it->second = kNone;
	}

	Polygons run()
	{
		Polygons out;
		std::vector<std::uint8_t> done(mesh_.triangles.size(), 0);
		std::vector<Corner> part, outline;
		for (Corner f = 0; f < done.size(); ++f) {
			if (done[f])
				continue;
			if (!inside_[3 * f] && !inside_[3 * f + 1] && !inside_[3 * f + 2]) {
				add(out, {3 * f, 3 * f + 1, 3 * f + 2});
				continue;
			}
			const bool isPolygon = collect(f, done, part) && walk(part, outline);
			out.complete         = out.complete && isPolygon;
			if (isPolygon)
				add(out, outline);
			else
				for (const Corner face : part)
					add(out, {3 * face, 3 * face + 1, 3 * face + 2});
		}
		return out;
	}

private:
	std::uint32_t vertex(Corner c) const { return mesh_.triangles[c / 3][c % 3]; }
	std::uint64_t key(Corner from, Corner to) const
	{
		return std::uint64_t(vertex(from)) << 32 | vertex(to);
	}
	/// The same edge in the face behind it, or kNone.
	Corner behind(Corner c) const
	{
		const auto it = cornerOf_.find(key(next(c), c));
		return it == cornerOf_.end() ? kNone : it->second;
	}

	static void add(Polygons& out, const std::vector<Corner>& face)
	{
		out.corners.insert(out.corners.end(), face.begin(), face.end());
		out.begin.push_back(out.corners.size());
	}

	/// All triangles connected with one over edges inside. False if there is none behind an edge.
	bool collect(Corner first, std::vector<std::uint8_t>& done, std::vector<Corner>& part) const
	{
		bool good = true;
		part.assign(1, first);
		done[first] = 1;
		for (std::size_t i = 0; i < part.size(); ++i)
			for (Corner c = 3 * part[i]; c < 3 * part[i] + 3; ++c) {
				if (!inside_[c])
					continue;
				const Corner d = behind(c);
				good           = good && d != kNone && behind(d) == c;
				if (d != kNone && !done[d / 3]) {
					done[d / 3] = 1;
					part.push_back(d / 3);
				}
			}
		return good;
	}

	/// Is a vertex in all triangles?
	bool isApex(std::uint32_t v, const std::vector<Corner>& part) const
	{
		return std::all_of(part.begin(), part.end(), [&](Corner f) {
			const auto& t = mesh_.triangles[f];
			return std::find(t.begin(), t.end(), v) != t.end();
		});
	}

	/// The corner at which the outline begins; kNone if there is no outline.
	Corner start(const std::vector<Corner>& part) const
	{
		Corner any = kNone;
		std::array<bool, 3> isApexOf {};
		const auto& first = mesh_.triangles[part[0]];
		for (std::size_t k = 0; k < 3; ++k)
			isApexOf[k] = isApex(first[k], part);
		for (const Corner face : part)
			for (Corner c = 3 * face; c < 3 * face + 3; ++c) {
				if (inside_[c])
					continue;
				any = std::min(any, c);
				for (std::size_t k = 0; k < 3; ++k)
					if (isApexOf[k] && vertex(c) == first[k])
						return c;
			}
		return any;
	}

	/// Walks around connected triangles. False if they are no polygon.
	bool walk(const std::vector<Corner>& part, std::vector<Corner>& outline) const
	{
		outline.clear();
		const Corner first = start(part);
		if (first == kNone)
			return false;
		std::vector<std::uint32_t> vertices;
		Corner c = first;
		do {
			outline.push_back(c);
			vertices.push_back(vertex(c));
			Corner d = next(c);
			for (std::size_t turns = 0; inside_[d]; ++turns) {
				const Corner e = next(behind(d));
				if (turns > part.size() || !alike_(d, e))
					return false;
				d = e;
			}
			c = d;
		} while (c != first && outline.size() <= part.size() + 2);
		std::sort(vertices.begin(), vertices.end());
		return c == first && outline.size() == part.size() + 2 &&
		       std::adjacent_find(vertices.begin(), vertices.end()) == vertices.end();
	}

	const MeshData& mesh_;
	const std::function<bool(Corner, Corner)>& alike_;
	std::vector<std::uint8_t> inside_; ///< #corners: is the edge inside a polygon?
	/// Edges inside by their ends; kNone if there are several.
	std::unordered_map<std::uint64_t, Corner> cornerOf_;
};

} // namespace

Polygons polygonsOf(const MeshData& mesh, const std::function<bool(Corner, Corner)>& alike)
{
	return Joiner(mesh, alike).run();
}

} // namespace wavemesh::tool
