// SPDX-License-Identifier: GPL-3.0-or-later
// The closed meshes.
#include "mesh_build.h"
#include "mesh_edit.h"
#include "mesh_families.h"

#include <array>
#include <cmath>
#include <map>

namespace wavemesh::test {

MeshData makeTetrahedron()
{
	return {
	    {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
	    {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
}

MeshData makeOctahedron()
{
	return makeBipyramid(4);
}

MeshData makeCube()
{
	MeshData m;
	for (int i = 0; i < 8; ++i)
		addVertex(m, i & 1, i >> 1 & 1, i >> 2);
	addQuad(m, 0, 2, 3, 1);
	addQuad(m, 4, 5, 7, 6);
	addQuad(m, 0, 1, 5, 4);
	addQuad(m, 3, 2, 6, 7);
	addQuad(m, 2, 0, 4, 6);
	addQuad(m, 1, 3, 7, 5);
	return m;
}

MeshData makeIcosahedron()
{
	return makeIcosphere(1);
}

MeshData makeIcosphere(int n)
{
	MeshData ico;
	const double g = 1.618033988749895;
	for (int s = 0; s < 4; ++s) {
		const double a = s & 1 ? -1 : 1, b = s & 2 ? -g : g;
		ico.positions.push_back({0, a, b});
		ico.positions.push_back({a, b, 0});
		ico.positions.push_back({b, 0, a});
	}
	// Faces are the triples at distance 2 from each other, oriented outwards.
	auto dist2 = [&](std::size_t i, std::size_t j) {
		double d = 0;
		for (std::size_t k = 0; k < 3; ++k)
			d += (ico.positions[i][k] - ico.positions[j][k]) *
			     (ico.positions[i][k] - ico.positions[j][k]);
		return d;
	};
	for (std::uint32_t i = 0; i < 12; ++i)
		for (std::uint32_t j = i + 1; j < 12; ++j)
			for (std::uint32_t k = j + 1; k < 12; ++k) {
				if (dist2(i, j) > 4.5 || dist2(j, k) > 4.5 || dist2(k, i) > 4.5)
					continue;
				const auto& p    = ico.positions[i];
				const auto& q    = ico.positions[j];
				const auto& r    = ico.positions[k];
				const double det = p[0] * (q[1] * r[2] - q[2] * r[1]) -
				                   p[1] * (q[0] * r[2] - q[2] * r[0]) +
				                   p[2] * (q[0] * r[1] - q[1] * r[0]);
				det > 0 ? addFace(ico, i, j, k) : addFace(ico, i, k, j);
			}

	MeshData m;
	std::map<std::array<std::int64_t, 3>, std::uint32_t> at;
	auto vertex = [&](const std::array<std::uint32_t, 3>& t, int u, int v) {
		double p[3], length = 0;
		for (std::size_t k = 0; k < 3; ++k) {
			p[k] = ico.positions[t[0]][k] * (n - u - v) + ico.positions[t[1]][k] * u +
			       ico.positions[t[2]][k] * v;
			length += p[k] * p[k];
		}
		length = std::sqrt(length);
		std::array<std::int64_t, 3> key;
		for (std::size_t k = 0; k < 3; ++k)
			key[k] = std::llround(p[k] / length * 1e6);
		const auto [i, isNew] = at.emplace(key, static_cast<std::uint32_t>(m.positions.size()));
		if (isNew)
			addVertex(m, p[0] / length, p[1] / length, p[2] / length);
		return i->second;
	};
	for (const auto& t : ico.triangles)
		for (int u = 0; u < n; ++u)
			for (int v = 0; u + v < n; ++v) {
				// One by one: compilers evaluate arguments in orders of their own.
				const auto c = vertex(t, u, v + 1), b = vertex(t, u + 1, v), a = vertex(t, u, v);
				addFace(m, a, b, c);
				if (u + v + 1 < n)
					addFace(m, b, vertex(t, u + 1, v + 1), c);
			}
	return m;
}

MeshData makeBumpySphere(std::uint32_t vertices, std::uint64_t seed)
{
	int n = 1;
	while (10u * static_cast<std::uint32_t>(n) * static_cast<std::uint32_t>(n) + 2 < vertices)
		++n;
	MeshData m = makeIcosphere(n);
	for (auto& p : m.positions) {
		const double r = 1 + waves(p[0] + p[2], p[1] - 0.5 * p[2]);
		p              = {snap(p[0] * r), snap(p[1] * r), snap(p[2] * r)};
	}
	Rng rng(seed);
	return flipRandomEdges(m, static_cast<std::uint32_t>(m.positions.size() / 2), rng);
}

MeshData makeBipyramid(int n)
{
	return makeDoubleCone(n, 1);
}

MeshData makeDoubleCone(int n, int rings)
{
	MeshData m;
	const auto bottom  = addVertex(m, 0, 0, -1);
	std::uint32_t ring = 0;
	for (int i = 1 - rings; i < rings; ++i) {
		const double z  = double(i) / rings;
		const auto next = addRing(m, n, 1 - std::fabs(z), z);
		if (i == 1 - rings)
			addCap(m, next, bottom, n, false);
		else
			addWall(m, ring, next, n);
		ring = next;
	}
	addCap(m, ring, addVertex(m, 0, 0, 1), n, true);
	return m;
}

MeshData makeKleetope(const MeshData& mesh, double height)
{
	MeshData m = mesh;
	m.triangles.clear();
	for (const auto& t : mesh.triangles) {
		double c[3];
		for (std::size_t k = 0; k < 3; ++k)
			c[k] = (mesh.positions[t[0]][k] + mesh.positions[t[1]][k] + mesh.positions[t[2]][k]) *
			       (1 + height) / 3;
		const auto v = addVertex(m, c[0], c[1], c[2]);
		for (std::size_t k = 0; k < 3; ++k)
			addFace(m, t[k], t[(k + 1) % 3], v);
	}
	return m;
}

MeshData makeStarPrism(int points, int layers)
{
	MeshData m;
	const int n        = 2 * points;
	const auto bottom  = addVertex(m, 0, 0, 0);
	std::uint32_t ring = 0;
	for (int z = 0; z <= layers; ++z) {
		const auto next = addRing(m, n, 1, 0.3 * z);
		for (int i = 1; i < n; i += 2)
			for (std::size_t k = 0; k < 2; ++k) {
				double& x = m.positions[next + static_cast<std::uint32_t>(i)][k];
				x         = snap(x * 0.6);
			}
		if (z == 0)
			addCap(m, next, bottom, n, false);
		else
			addWall(m, ring, next, n);
		ring = next;
	}
	addCap(m, ring, addVertex(m, 0, 0, 0.3 * layers), n, true);
	return m;
}

MeshData makeTorus(int n, int m)
{
	MeshData t;
	for (int i = 0; i < n; ++i)
		for (int j = 0; j < m; ++j) {
			const double a = kTau * i / n, b = kTau * j / m, r = 1 + 0.4 * std::cos(b);
			addVertex(t, r * std::cos(a), r * std::sin(a), 0.4 * std::sin(b));
		}
	auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i % n * m + j % m); };
	for (int i = 0; i < n; ++i)
		for (int j = 0; j < m; ++j)
			addQuad(t, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
	return t;
}

MeshData makeHoledPlate(int genus, int n)
{
	const int nx = (2 * genus + 1) * n, ny = 3 * n;
	MeshData m;
	std::map<std::array<int, 3>, std::uint32_t> vertexAt;
	auto vertex = [&](int x, int y, int z) {
		const auto [i, isNew] = vertexAt.emplace(
		    std::array<int, 3> {x, y, z}, static_cast<std::uint32_t>(m.positions.size()));
		if (isNew)
			addVertex(m, double(x) / n, double(y) / n, 0.5 * z + waves(0.3 * x / n, 0.3 * y / n));
		return i->second;
	};
	auto full = [&](int x, int y) {
		return x >= 0 && y >= 0 && x < nx && y < ny && !(y / n == 1 && x / n % 2 == 1);
	};
	for (int y = 0; y < ny; ++y)
		for (int x = 0; x < nx; ++x) {
			if (!full(x, y))
				continue;
			auto quad = [&](int x0, int y0, int z0, int x1, int y1, int z1, int x2, int y2, int z2,
			                int x3, int y3, int z3) {
				const auto d = vertex(x3, y3, z3), c = vertex(x2, y2, z2);
				const auto b = vertex(x1, y1, z1), a = vertex(x0, y0, z0);
				addQuad(m, a, b, c, d);
			};
			quad(x, y, 1, x + 1, y, 1, x + 1, y + 1, 1, x, y + 1, 1);
			quad(x, y, 0, x, y + 1, 0, x + 1, y + 1, 0, x + 1, y, 0);
			if (!full(x - 1, y))
				quad(x, y, 0, x, y, 1, x, y + 1, 1, x, y + 1, 0);
			if (!full(x + 1, y))
				quad(x + 1, y, 0, x + 1, y + 1, 0, x + 1, y + 1, 1, x + 1, y, 1);
			if (!full(x, y - 1))
				quad(x, y, 0, x + 1, y, 0, x + 1, y, 1, x, y, 1);
			if (!full(x, y + 1))
				quad(x, y + 1, 0, x, y + 1, 1, x + 1, y + 1, 1, x + 1, y + 1, 0);
		}
	return m;
}

} // namespace wavemesh::test
