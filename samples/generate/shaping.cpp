// SPDX-License-Identifier: GPL-3.0-or-later
#include "shaping.h"

#include "mesh_edit.h"

#include <cmath>

namespace wavemesh::samples {

using test::MeshEdit;
using test::Rng;

namespace {

Point minus(const Point& a, const Point& b)
{
	return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double dot(const Point& a, const Point& b)
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Point cross(const Point& a, const Point& b)
{
	return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double length(const Point& a)
{
	return std::sqrt(dot(a, a));
}

/// Cotangent of the angle at c in triangle a b c.
double cotangent(const Point& a, const Point& b, const Point& c)
{
	const Point u = minus(a, c), v = minus(b, c);
	return dot(u, v) / (length(cross(u, v)) + 1e-30);
}

bool wantsFlip(const std::vector<Point>& p, const MeshEdit& edit, std::uint32_t h)
{
	const std::uint32_t g = edit.twin(h);
	if (g == MeshEdit::kNone)
		return false;
	const Point &a = p[edit.from(h)], &b = p[edit.to(h)];
	const Point &c = p[edit.from(MeshEdit::prevOf(h))], &d = p[edit.from(MeshEdit::prevOf(g))];
	if (cotangent(a, b, c) + cotangent(b, a, d) > -1e-6)
		return false;
	auto turned = [&](const Point& n, const Point& m) {
		return dot(n, m) < 0.9 * length(n) * length(m);
	};
	const Point before = cross(minus(b, a), minus(c, a)), beside = cross(minus(d, a), minus(b, a));
	const Point after = cross(minus(d, a), minus(c, a)), other = cross(minus(d, b), minus(c, b));
	const Point back = {-other[0], -other[1], -other[2]};
	return !turned(before, beside) && !turned(before, after) && !turned(before, back);
}

} // namespace

std::vector<bool> boundaryVertices(const MeshData& mesh)
{
	const MeshEdit edit(mesh);
	std::vector<bool> rim(mesh.positions.size(), false);
	for (std::uint32_t h = 0; h < edit.halfEdges(); ++h)
		if (edit.twin(h) == MeshEdit::kNone)
			rim[edit.from(h)] = rim[edit.to(h)] = true;
	return rim;
}

MeshData
relaxed(MeshData mesh, int rounds, double weight, const std::function<bool(std::uint32_t)>& isFree)
{
	const auto rim = boundaryVertices(mesh);
	for (int round = 0; round < rounds; ++round) {
		std::vector<Point> sum(mesh.positions.size(), Point {});
		std::vector<double> count(mesh.positions.size(), 0);
		for (const auto& t : mesh.triangles)
			for (std::size_t k = 0; k < 3; ++k)
				for (std::size_t i = 1; i < 3; ++i) {
					const Point& q = mesh.positions[t[(k + i) % 3]];
					for (std::size_t x = 0; x < 3; ++x)
						sum[t[k]][x] += q[x];
					count[t[k]] += 1;
				}
		for (std::uint32_t v = 0; v < sum.size(); ++v)
			if (!rim[v] && (!isFree || isFree(v)))
				for (std::size_t x = 0; x < 3; ++x)
					mesh.positions[v][x] += weight * (sum[v][x] / count[v] - mesh.positions[v][x]);
	}
	return mesh;
}

MeshData withBetterAngles(const MeshData& mesh, int rounds)
{
	MeshEdit edit(mesh);
	for (int round = 0; round < rounds; ++round)
		for (std::uint32_t h = 0; h < edit.halfEdges(); ++h)
			if (wantsFlip(mesh.positions, edit, h))
				edit.flip(h);
	return edit.result();
}

MeshData irregular(const MeshData& mesh, double share, std::uint64_t seed)
{
	Rng rng(seed);
	const auto want = static_cast<double>(mesh.positions.size()) * (1 - share);
	MeshData m      = mesh;
	// A collapse takes one vertex; some are refused.
	while (static_cast<double>(m.positions.size()) > want) {
		const auto missing = static_cast<double>(m.positions.size()) - want;
		m = test::collapseRandomEdges(m, static_cast<std::uint32_t>(std::ceil(missing)), rng);
		m = withBetterAngles(relaxed(m, 1, 0.5), 2);
	}
	return m;
}

MeshData snapped(MeshData mesh)
{
	for (Point& p : mesh.positions)
		for (double& x : p)
			x = std::nearbyint(x * 65536) / 65536;
	return mesh;
}

} // namespace wavemesh::samples
