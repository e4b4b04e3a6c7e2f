// SPDX-License-Identifier: GPL-3.0-or-later
// The open meshes.
#include "mesh_build.h"
#include "mesh_edit.h"
#include "mesh_families.h"

#include <array>
#include <utility>

namespace wavemesh::test {

MeshData makeTriangle()
{
	return makeStrip(1);
}

MeshData makeTwoTriangles()
{
	return makeStrip(2);
}

MeshData makeGrid(int n, int m)
{
	MeshData g;
	for (int y = 0; y < m; ++y)
		for (int x = 0; x < n; ++x)
			addVertex(g, double(x) / n, double(y) / n, waves(double(x) / n, double(y) / n));
	for (int y = 0; y + 1 < m; ++y)
		for (int x = 0; x + 1 < n; ++x) {
			const auto a  = static_cast<std::uint32_t>(y * n + x),
			           up = static_cast<std::uint32_t>(n);
			addQuad(g, a, a + 1, a + 1 + up, a + up);
		}
	return g;
}

MeshData makeFlatGrid(int n, int m)
{
	MeshData g = makeGrid(n, m);
	for (auto& p : g.positions)
		p[2] = 0;
	g.triangles.clear();
	for (int y = 0; y + 1 < m; ++y)
		for (int x = 0; x + 1 < n; ++x) {
			const auto a  = static_cast<std::uint32_t>(y * n + x),
			           up = static_cast<std::uint32_t>(n);
			if ((x + y) % 2)
				addQuad(g, a, a + 1, a + 1 + up, a + up);
			else
				addQuad(g, a + 1, a + 1 + up, a + up, a);
		}
	return g;
}

MeshData makeTerrain(std::uint32_t vertices, std::uint64_t seed)
{
	Rng rng(seed);
	// Half of the points on a disturbed grid, the rest thrown into random faces.
	int n = 2;
	while (2u * static_cast<std::uint32_t>(n) * static_cast<std::uint32_t>(n) < vertices)
		++n;
	MeshData g = makeFlatGrid(n, n);
	for (int y = 1; y + 1 < n; ++y)
		for (int x = 1; x + 1 < n; ++x) {
			auto& p = g.positions[static_cast<std::size_t>(y * n + x)];
			p[0]    = snap(p[0] + rng.between(-0.22, 0.22) / n);
			p[1]    = snap(p[1] + rng.between(-0.22, 0.22) / n);
		}
	MeshEdit edit(std::move(g));
	while (edit.mesh().positions.size() < vertices) {
		const std::uint32_t f = rng.below(edit.halfEdges() / 3);
		const double u = rng.between(0.2, 0.5), v = rng.between(0.2, 0.8 - u);
		const auto& t = edit.mesh().triangles[f];
		const auto& p = edit.mesh().positions;
		std::array<double, 3> at {};
		for (std::size_t k = 0; k < 2; ++k)
			at[k] = snap(p[t[0]][k] * u + p[t[1]][k] * v + p[t[2]][k] * (1 - u - v));
		edit.insert(f, at);
	}
	edit.makeDelaunay();
	MeshData m = edit.result();
	for (auto& p : m.positions)
		p[2] = snap(waves(3 * p[0], 3 * p[1]) + 0.02 * waves(31 * p[0], 37 * p[1]));
	return m;
}

MeshData makeFan(int n)
{
	MeshData m;
	addVertex(m, 0, 0, 0.3);
	addCap(m, addRing(m, n, 1, 0), 0, n, true);
	return m;
}

MeshData makeStrip(int n)
{
	MeshData m;
	for (int i = 0; i < n + 2; ++i)
		addVertex(m, 0.5 * i, i & 1, 0.1 * (i % 3));
	for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n); ++i)
		i & 1 ? addFace(m, i, i + 1, i + 2) : addFace(m, i, i + 2, i + 1);
	return m;
}

MeshData makeAnnulus(int n)
{
	MeshData m;
	const auto outer = addRing(m, n, 1, 0);
	addWall(m, outer, addRing(m, n, 0.5, 0.1), n);
	return m;
}

MeshData makeCylinder(int n, int rings)
{
	MeshData m;
	for (int i = 0; i < rings; ++i) {
		const auto ring = addRing(m, n, 1, 0.25 * i);
		if (i > 0)
			addWall(m, ring - static_cast<std::uint32_t>(n), ring, n);
	}
	return m;
}

} // namespace wavemesh::test
