// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A small half-edge mesh, to make connectivity irregular: flips, collapses, vertex insertion and
/// Delaunay flips. Every operation keeps an oriented 2-manifold one, and refuses otherwise.
#pragma once

#include "rng.h"

#include <wavemesh/mesh_data.h>

#include <cstdint>
#include <vector>

namespace wavemesh::test {

/// Half-edge h = 3 f + k runs from corner k to corner k+1 of face f.
class MeshEdit
{
public:
	static constexpr std::uint32_t kNone = 0xffffffffu;

	/// @pre `mesh` is an oriented 2-manifold
	explicit MeshEdit(MeshData mesh);

	std::uint32_t halfEdges() const { return static_cast<std::uint32_t>(twin_.size()); }
	std::uint32_t twin(std::uint32_t h) const { return twin_[h]; }
	std::uint32_t from(std::uint32_t h) const { return mesh_.triangles[h / 3][h % 3]; }
	std::uint32_t to(std::uint32_t h) const { return from(nextOf(h)); }
	static std::uint32_t nextOf(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
	static std::uint32_t prevOf(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }

	/// Vertices joined to `v` by an edge.
	std::vector<std::uint32_t> ring(std::uint32_t v) const;
	bool joined(std::uint32_t a, std::uint32_t b) const;

	/// Replaces the edge of h by the other diagonal of its two faces. False (and nothing done) on
	/// the boundary or if the other diagonal is an edge already.
	bool flip(std::uint32_t h);
	/// Puts a vertex into face f. Returns the vertex.
	std::uint32_t insert(std::uint32_t f, const std::array<double, 3>& position);
	/// Merges the two ends of an interior edge into from(h), which keeps its place. False if the
	/// result would not be manifold, or would touch the boundary.
	bool collapse(std::uint32_t h);

	/// Flips until every interior edge is locally Delaunay in the x-y plane.
	/// @pre the faces do not overlap when seen along z
	void makeDelaunay();

	/// The mesh without what collapses removed.
	MeshData result() const;
	/// As it stands, with removed faces still in. @pre no collapse()
	const MeshData& mesh() const { return mesh_; }
	bool removed(std::uint32_t f) const { return mesh_.triangles[f][0] == kNone; }

private:
	void link(std::uint32_t h, std::uint32_t g);
	void setFace(std::uint32_t f, std::uint32_t a, std::uint32_t b, std::uint32_t c);
	bool onBoundary(std::uint32_t v) const;

	MeshData mesh_;
	std::vector<std::uint32_t> twin_;
	std::vector<std::uint32_t> out_; ///< a half-edge that leaves the vertex, kNone if removed
};

/// Tries `count` flips of random edges.
MeshData flipRandomEdges(const MeshData& mesh, std::uint32_t count, Rng& rng);
/// Tries `count` collapses of random edges.
MeshData collapseRandomEdges(const MeshData& mesh, std::uint32_t count, Rng& rng);

} // namespace wavemesh::test
