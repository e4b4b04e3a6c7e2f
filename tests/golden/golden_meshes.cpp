// SPDX-License-Identifier: GPL-3.0-or-later
#include "golden_meshes.h"

#include "mesh_families.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace wavemesh::test {
namespace {

using Index  = std::uint32_t;
using Point  = std::array<double, 3>;
using Kind   = AttributeKind;
using Values = std::vector<double>;

/// @return its values, to be filled in
Values& add(MeshData& m, AttributeOf of, Kind kind, NumberType type, int columns, int bits)
{
	Attribute a;
	a.of         = of;
	a.kind       = kind;
	a.type       = type;
	a.components = columns;
	a.bits       = bits;
	m.attributes.reserve(64); // those of others stay where they are
	m.attributes.push_back(a);
	return m.attributes.back().values;
}

/// What is of floats holds floats. (Done number by number where they arise, behind a condition on
/// the type, g++ 12 -O3 leaves some unrounded.)
void roundFloats(MeshData& m)
{
	for (Attribute& a : m.attributes)
		if (a.type == NumberType::Float)
			for (double& x : a.values)
				x = double(float(x));
}

Point unit(const Point& p)
{
	const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
	return length > 0 ? Point {p[0] / length, p[1] / length, p[2] / length} : Point {0, 0, 1};
}

double doubleOf(std::uint64_t bits)
{
	double x;
	std::memcpy(&x, &bits, sizeof x);
	return x;
}

/// The i-th of numbers that comparing and rounding treat in ways of their own.
double oddNumber(std::size_t i, NumberType type)
{
	constexpr double kInfinity = std::numeric_limits<double>::infinity();
	switch (i % 8) {
	case 0:
		return kInfinity;
	case 1:
		return -kInfinity;
	case 2: // with a payload that a float has room for
		return doubleOf(0x7ff8000000000000u | (std::uint64_t(i) & 0xff) << 32);
	case 3: // and a sign
		return doubleOf(0xfff8000020000000u);
	case 4:
		return -0.0;
	case 5:
		return type == NumberType::Float ? double(std::numeric_limits<float>::max()) : -1.5e308;
	case 6:
		return type == NumberType::Float ? double(std::numeric_limits<float>::denorm_min())
		                                 : doubleOf(0x7ff0000000000001u + i);
	default:
		return 0;
	}
}

} // namespace

MeshData notManifold()
{
	MeshData m      = joined({makeIcosphere(3), moved(makeIcosphere(2), 2, 0, 0)});
	const Index own = m.triangles.front()[0], other = m.triangles.back()[0];
	for (auto& t : m.triangles)
		for (auto& v : t)
			if (v == other)
				v = own;
	const auto edge = m.triangles[5];
	m.positions.push_back({0.5, 1.5, 2});
	m.triangles.push_back({edge[1], edge[0], Index(m.positions.size() - 1)});
	return m;
}

MeshData withAttributes(MeshData m)
{
	auto& colour  = add(m, AttributeOf::Vertex, Kind::Colour, NumberType::Integer, 4, 0);
	auto& quality = add(m, AttributeOf::Vertex, Kind::Quality, NumberType::Float, 1, 0);
	auto& normal  = add(m, AttributeOf::Vertex, Kind::Normal, NumberType::Float, 3, 8);
	for (const auto& p : m.positions) {
		colour.insert(
		    colour.end(), {std::floor(99 + 40 * p[0]), std::floor(150 + 9 * p[1] * p[2]), 7, 255});
		quality.push_back(double(float(p[0] * p[1] / 3)));
		const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
		for (const double x : p)
			normal.push_back(length > 0 ? double(float(x / length)) : 0);
	}
	auto& face  = add(m, AttributeOf::Face, Kind::Quality, NumberType::Integer, 1, 0);
	auto& edges = add(m, AttributeOf::Face, Kind::FauxEdges, NumberType::Integer, 1, 0);
	auto& wedge = add(m, AttributeOf::Corner, Kind::TexCoord, NumberType::Double, 3, 10);
	for (std::size_t f = 0; f < m.triangles.size(); ++f) {
		const double chart = m.positions[m.triangles[f][0]][0] > 0.2 ? 1 : 0;
		face.push_back(double(f / 16));
		edges.push_back(f % 3 == 1 ? double(1 << f % 2) : 0);
		for (const Index v : m.triangles[f])
			wedge.insert(wedge.end(), {m.positions[v][1] + chart, m.positions[v][2], chart});
	}
	auto& placed = add(m, AttributeOf::Mesh, Kind::Transform, NumberType::Double, 16, 0);
	for (int k = 0; k < 16; ++k)
		placed.push_back(k % 5 == 0 ? 1 : 0.25 * k);
	m.textures = {"wood.png"};
	return m;
}

MeshData turned(MeshData m)
{
	const auto faces = m.triangles;
	for (std::size_t f = 0; f < faces.size(); ++f) {
		const auto t = faces[f];
		if (f % 3 == 1)
			m.triangles[f] = {t[1], t[0], t[2]};
		if (f % 20 == 7)
			m.triangles.push_back({t[2], t[1], t[0]});
		if (f % 30 == 8)
			m.triangles.push_back({t[1], t[2], t[0]});
	}
	m.triangles.push_back({faces[0][0], faces[0][0], faces[0][1]});
	m.positions.push_back({0.1, 0.2, 0.3});
	m.positions.push_back({0.1, 0.2, 0.3});
	return m;
}

MeshData withCorners(MeshData m, NumberType type, int bits)
{
	Values& wedge  = add(m, AttributeOf::Corner, Kind::TexCoord, type, 3, bits);
	Values& normal = add(m, AttributeOf::Corner, Kind::Normal, type, 3, bits);
	Values& whole  = add(m, AttributeOf::Corner, Kind::Custom, NumberType::Integer, 1, 0);
	for (std::size_t f = 0; f < m.triangles.size(); ++f) {
		const double chart = m.positions[m.triangles[f][0]][0] > 0.2 ? 1 : 0;
		for (const Index v : m.triangles[f]) {
			const Point& p = m.positions[v];
			wedge.insert(wedge.end(), {p[1] + chart, p[2] / 3, chart});
			const Point n = unit({p[0] - 3 * chart, p[1], p[2]});
			normal.insert(normal.end(), n.begin(), n.end());
			whole.push_back(std::floor(4 * p[2]) - 9 * chart);
		}
	}
	roundFloats(m);
	return m;
}

MeshData withNotFinite(MeshData m, NumberType type)
{
	if (type == NumberType::Float)
		for (auto& p : m.positions)
			for (double& x : p)
				x = double(float(x));
	const auto odd = [&](std::size_t i, std::size_t often, double usual) {
		return i % often == 0 ? oddNumber(i / often, type) : usual;
	};
	Values& colour  = add(m, AttributeOf::Vertex, Kind::Colour, NumberType::Integer, 4, 0);
	Values& quality = add(m, AttributeOf::Vertex, Kind::Quality, type, 1, 12);
	Values& radius  = add(m, AttributeOf::Vertex, Kind::Radius, type, 1, 0);
	Values& shade   = add(m, AttributeOf::Vertex, Kind::Colour, type, 3, 0);
	Values& face    = add(m, AttributeOf::Face, Kind::Quality, type, 1, 0);
	Values& corner  = add(m, AttributeOf::Corner, Kind::Custom, type, 2, 0);
	for (std::size_t v = 0; v < m.positions.size(); ++v) {
		const Point p = m.positions[v];
		colour.insert(colour.end(), {std::floor(99 + 40 * p[0]), 128, 7, double(v % 2) * 255});
		quality.push_back(odd(v, 11, p[0] * p[1]));
		radius.push_back(odd(v + 3, 5, std::floor(100 * p[2]) / 100));
		for (std::size_t k = 0; k < 3; ++k)
			shade.push_back(odd(v + k, 7, 0.5 + p[k] / 8));
	}
	for (std::size_t f = 0; f < m.triangles.size(); ++f) {
		// Neighbours with the same: rows that are equal or are not though they compare so.
		face.push_back(odd(f / 6, 3, double(f / 12)));
		for (const Index v : m.triangles[f])
			corner.insert(corner.end(), {f % 5 == 0 ? -0.0 : 0.0, odd(v, 2, m.positions[v][1])});
	}
	for (std::size_t v = 5; v < m.positions.size(); v += 9)
		m.positions[v][v % 3] = oddNumber(v / 9, type);
	roundFloats(m);
	return m;
}

MeshData withNormals(MeshData m)
{
	const auto type = NumberType::Float;
	Values& vertex  = add(m, AttributeOf::Vertex, Kind::Normal, NumberType::Double, 3, 14);
	for (const Point& p : m.positions)
		for (const double x : unit(p))
			vertex.push_back(x);
	Values& face   = add(m, AttributeOf::Face, Kind::Normal, type, 3, 7);
	Values& longer = add(m, AttributeOf::Face, Kind::Normal, type, 3, 9);
	Values& corner = add(m, AttributeOf::Corner, Kind::Normal, type, 3, 12);
	Values& coarse = add(m, AttributeOf::Corner, Kind::Normal, type, 3, 2);
	Values& some   = add(m, AttributeOf::Corner, Kind::Normal, type, 3, 10);
	for (std::size_t f = 0; f < m.triangles.size(); ++f) {
		const Point& q = m.positions[m.triangles[f][0]];
		const Point n  = unit({q[0], q[1], q[2] * (f % 4 == 0 ? -1 : 1)});
		face.insert(face.end(), n.begin(), n.end());
		for (const double x : n)
			longer.push_back(x * (f % 2 == 0 ? 1 : 4));
		for (const Index v : m.triangles[f]) {
			const Point p = m.positions[v];
			const Point u = unit({p[0], p[1] + (p[0] > 0 ? 2 : 0), p[2]});
			corner.insert(corner.end(), u.begin(), u.end());
			coarse.insert(coarse.end(), u.begin(), u.end());
			for (std::size_t k = 0; k < 3; ++k)
				some.push_back(v % 6 == 0 ? oddNumber(v / 6 + k, type) : u[k]);
		}
	}
	roundFloats(m);
	return m;
}

MeshData withFlags(MeshData m)
{
	const auto whole = NumberType::Integer;
	Values& chosen   = add(m, AttributeOf::Vertex, Kind::Selected, whole, 1, 0);
	Values& many     = add(m, AttributeOf::Vertex, Kind::Custom, NumberType::Double, 16, 6);
	Values& normal   = add(m, AttributeOf::Vertex, Kind::Custom, NumberType::Float, 3, 0);
	for (std::size_t v = 0; v < m.positions.size(); ++v) {
		const Point& p = m.positions[v];
		chosen.push_back(p[0] > 0 ? 1 : 0);
		for (int k = 0; k < 16; ++k) // of each three columns one says nothing
			many.push_back(k % 3 == 0 ? -7 : k % 3 == 1 ? double(v % 5) : p[0] * k);
		const Point n = unit(p);
		normal.insert(normal.end(), n.begin(), n.end());
	}
	m.attributes[1].name = "many \xff";
	Values& picked       = add(m, AttributeOf::Face, Kind::Selected, whole, 1, 0);
	Values& edges        = add(m, AttributeOf::Face, Kind::FauxEdges, whole, 1, 0);
	Values& others       = add(m, AttributeOf::Face, Kind::FauxEdges, whole, 2, 0);
	Values& colour       = add(m, AttributeOf::Face, Kind::Colour, whole, 4, 0);
	Values& quality      = add(m, AttributeOf::Face, Kind::Quality, NumberType::Float, 1, 5);
	for (std::size_t f = 0; f < m.triangles.size(); ++f) {
		picked.push_back(f % 7 < 3 ? 1 : 0);
		edges.push_back(double(f * f % 8));
		others.insert(others.end(), {double(f % 2), 5}); // not those of polygons: two columns
		const double x = m.positions[m.triangles[f][0]][0];
		colour.insert(colour.end(), {std::floor(128 + 50 * x), double(f % 3), 255, 255});
		quality.push_back(double(float(x / 7)));
	}
	add(m, AttributeOf::Mesh, AttributeKind(77), whole, 2, 0) = {-9007199254740992.0, 1};
	m.textures = {"wood.png", "", "a\nb\x1b[31m.png"};
	roundFloats(m);
	return m;
}

} // namespace wavemesh::test
