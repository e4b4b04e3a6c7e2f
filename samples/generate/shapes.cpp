// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes.h"

#include "mesh_edit.h"
#include "mesh_families.h"
#include "shaping.h"

#include <algorithm>
#include <cmath>

namespace wavemesh::samples {

using namespace wavemesh::test;

namespace {

Point direction(const Point& p)
{
	const double l = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
	return {p[0] / l, p[1] / l, p[2] / l};
}

MeshData irregularSphere(int n, double share, std::uint64_t seed)
{
	Rng rng(seed);
	MeshData m = makeIcosphere(n);
	m          = flipRandomEdges(m, static_cast<std::uint32_t>(m.positions.size()), rng);
	m          = irregular(m, share, seed + 1);
	for (int i = 0; i < 3; ++i) {
		m = withBetterAngles(relaxed(m, 2, 0.6), 2);
		for (Point& p : m.positions)
			p = direction(p);
	}
	return m;
}

/// How far the organic shape reaches in a direction: lobes of unlike width.
double lobes(const Point& d)
{
	struct Lobe
	{
		Point axis;
		double height, width;
	};
	static const Lobe all[] = {{{0.0, 0.0, 1.0}, 0.55, 0.25},    {{0.8, 0.3, 0.52}, 0.6, 0.12},
	                           {{-0.7, 0.5, -0.51}, 0.75, 0.2},  {{0.1, -0.95, 0.3}, 0.5, 0.09},
	                           {{-0.5, -0.6, 0.62}, 0.35, 0.15}, {{0.6, -0.4, -0.69}, 0.45, 0.3}};
	double r                = 1;
	for (const Lobe& lobe : all) {
		const Point a  = direction(lobe.axis);
		const double c = 1 - (a[0] * d[0] + a[1] * d[1] + a[2] * d[2]);
		r += lobe.height * std::exp(-c / lobe.width);
	}
	return r + 0.015 * std::sin(17 * d[0] + 5 * d[1]) * std::cos(14 * d[2]);
}

MeshData blobOver(MeshData sphere)
{
	for (Point& p : sphere.positions) {
		const double r = lobes(p);
		p              = {p[0] * r, p[1] * r, p[2] * r * 0.85};
	}
	return withBetterAngles(sphere, 3);
}

double ridges(double x, double y)
{
	double h = 0, scale = 1;
	for (int octave = 0; octave < 6; ++octave) {
		const double w = std::sin(3.1 * x / scale + 1.7 * octave) +
		                 std::sin(2.7 * y / scale - octave) +
		                 std::sin(2.2 * (x + y) / scale + 0.6 * octave * octave);
		h += scale * (1 - std::fabs(w) / 1.5);
		scale *= 0.47;
	}
	return h;
}

/// Without the faces at the vertices that `drown` names, as long as what remains is manifold.
MeshData withoutVertices(const MeshData& mesh, const std::vector<bool>& drown)
{
	MeshData out;
	std::vector<std::uint32_t> row(mesh.positions.size(), MeshEdit::kNone);
	for (const auto& t : mesh.triangles) {
		if (drown[t[0]] || drown[t[1]] || drown[t[2]])
			continue;
		auto kept = t;
		for (std::uint32_t& v : kept) {
			if (row[v] == MeshEdit::kNone) {
				row[v] = static_cast<std::uint32_t>(out.positions.size());
				out.positions.push_back(mesh.positions[v]);
			}
			v = row[v];
		}
		out.triangles.push_back(kept);
	}
	return out;
}

double profile(double t) // of the vase, 0 foot .. 1 lip
{
	return 0.42 + 0.2 * std::sin(5.2 * t - 0.3) + 0.12 * std::exp(-80 * (1 - t) * (1 - t));
}

} // namespace

MeshData makeBlob()
{
	return snapped(blobOver(irregularSphere(27, 0.35, 101)));
}

MeshData makePebble()
{
	return snapped(blobOver(irregularSphere(3, 0.3, 107)));
}

MeshData makePretzel()
{
	MeshData m = irregular(relaxed(makeHoledPlate(3, 13), 6, 0.7), 0.3, 211);
	for (int i = 0; i < 8; ++i)
		m = withBetterAngles(relaxed(m, 5, 0.6), 2);
	return snapped(scaled(m, 1, 1, 1.6));
}

MeshData makeIsland()
{
	MeshData m = makeTerrain(6500, 307);
	std::vector<bool> drown(m.positions.size());
	for (std::size_t v = 0; v < drown.size(); ++v) {
		Point& p       = m.positions[v];
		const double x = p[0] - 0.5, y = p[1] - 0.5;
		p[2] = 0.09 * ridges(2.4 * x, 2.4 * y) + 0.25 * std::exp(-9 * (x * x + y * y));
		const double coast =
		    std::sqrt(x * x + y * y) + 0.03 * std::sin(9 * x) + 0.02 * std::cos(23 * y);
		drown[v] = coast > 0.47 || (x - 0.17) * (x - 0.17) + (y + 0.1) * (y + 0.1) < 0.003;
	}
	return snapped(scaled(withoutVertices(m, drown), 4, 4, 2));
}

MeshData makePieces()
{
	return snapped(joined(
	    {blobOver(irregularSphere(9, 0.2, 401)),
	     moved(irregular(makeTorus(48, 20), 0.2, 403), 3.2, 0, 0),
	     moved(makeStarPrism(11, 9), -3.2, 0, -1.3), moved(makeCylinder(36, 14), 0, 3.4, -1.6),
	     moved(makeTerrain(400, 405), 2.6, 2.8, 0), moved(makeTetrahedron(), -3.2, 3.4, 0),
	     moved(makeHoledPlate(1, 5), -1.5, -4.5, 0)}));
}

MeshData makeVase()
{
	constexpr int kAround = 72, kRings = 80;
	MeshData m = scaled(makeCylinder(kAround, kRings), 1, 1, 0.35);
	Rng rng(503);
	m = irregular(flipRandomEdges(m, 3000, rng), 0.25, 509);
	for (Point& p : m.positions) {
		const double t = p[2] / (0.35 * 0.25 * (kRings - 1));
		const double l = std::sqrt(p[0] * p[0] + p[1] * p[1]);
		const double a = std::atan2(p[1], p[0]);
		const double r = profile(t) * (1 + 0.03 * std::cos(9 * a + 14 * t));
		p              = {r * p[0] / l, r * p[1] / l, 2 * t};
	}
	return snapped(withBetterAngles(m, 3));
}

std::vector<std::array<std::uint8_t, 4>> vaseColours(const MeshData& vase)
{
	std::vector<std::array<std::uint8_t, 4>> colours;
	for (const Point& p : vase.positions) {
		const double a    = std::atan2(p[1], p[0]);
		const double wave = 0.5 + 0.5 * std::sin(12 * p[2] + 2 * std::sin(5 * a));
		auto shade        = [&](double low, double high) {
            return static_cast<std::uint8_t>(std::lround(low + (high - low) * wave));
		};
		colours.push_back({shade(30, 235), shade(70, 205), shade(140, 150), 255});
	}
	return colours;
}

} // namespace wavemesh::samples
