// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Pieces that the meshes of mesh_families.h are put together from.
#pragma once

#include <wavemesh/mesh_data.h>

#include <cmath>
#include <cstdint>
#include <utility>

namespace wavemesh::test {

constexpr double kTau = 6.283185307179586;

/// To a multiple of 2^-20: what the last bits of sin and cos are does not matter any more.
inline double snap(double x)
{
	return std::nearbyint(x * 1048576.0) / 1048576.0;
}

inline std::uint32_t addVertex(MeshData& m, double x, double y, double z)
{
	m.positions.push_back({snap(x), snap(y), snap(z)});
	return static_cast<std::uint32_t>(m.positions.size() - 1);
}

inline void addFace(MeshData& m, std::uint32_t a, std::uint32_t b, std::uint32_t c)
{
	m.triangles.push_back({a, b, c});
}

/// Counter-clockwise a b c d, cut along a-c.
inline void addQuad(MeshData& m, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d)
{
	addFace(m, a, b, c);
	addFace(m, a, c, d);
}

/// Ring of n vertices about the z axis. Returns the first.
inline std::uint32_t addRing(MeshData& m, int n, double radius, double z)
{
	const auto first = static_cast<std::uint32_t>(m.positions.size());
	for (int i = 0; i < n; ++i)
		addVertex(m, radius * std::cos(kTau * i / n), radius * std::sin(kTau * i / n), z);
	return first;
}

/// The wall between two rings of n vertices, `upper` above `lower`, seen from outside.
inline void addWall(MeshData& m, std::uint32_t lower, std::uint32_t upper, int n)
{
	for (int i = 0; i < n; ++i) {
		const auto a = static_cast<std::uint32_t>(i), b = static_cast<std::uint32_t>((i + 1) % n);
		addQuad(m, lower + a, lower + b, upper + b, upper + a);
	}
}

/// A disc: ring of n vertices and its middle, seen from above (`up`) or below.
inline void addCap(MeshData& m, std::uint32_t ring, std::uint32_t middle, int n, bool up)
{
	for (int i = 0; i < n; ++i) {
		auto a = ring + static_cast<std::uint32_t>(i);
		auto b = ring + static_cast<std::uint32_t>((i + 1) % n);
		if (!up)
			std::swap(a, b);
		addFace(m, middle, a, b);
	}
}

inline double waves(double x, double y)
{
	return 0.12 * std::sin(5 * x + 1) * std::cos(4 * y) + 0.05 * std::sin(13 * x * y + 2 * y);
}

} // namespace wavemesh::test
