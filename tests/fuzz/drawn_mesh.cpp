// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawn_mesh.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace wavemesh::test {
namespace {

double numberOfBits(std::uint64_t bits)
{
	double x;
	std::memcpy(&x, &bits, sizeof x);
	return x;
}

double floatOfBits(std::uint32_t bits)
{
	float x;
	std::memcpy(&x, &bits, sizeof x);
	return double(x);
}

double special(std::uint32_t i)
{
	constexpr double kInfinity  = std::numeric_limits<double>::infinity();
	constexpr double kSpecial[] = {
	    0.0,   -0.0,   kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN(),
	    1e308, -1e308, 5e-324,    1e-310,     std::numeric_limits<double>::max(),
	    0.1,   3e38,   1e-45,     16777217,   -1e300,
	    1e22};
	return kSpecial[i % 16];
}

/// A number in a style: small and whole, decimal, any float, any double, special, small or special.
double drawnNumber(ByteSource& in, std::uint32_t style)
{
	switch (style) {
	case 0:
		return in.byte();
	case 1:
		return double(std::int16_t(in.word(2))) / 1000;
	case 2:
		return floatOfBits(std::uint32_t(in.word(4)));
	case 3:
		return numberOfBits(in.word(8));
	case 4:
		return special(in.byte());
	default: {
		const std::uint8_t b = in.byte();
		return b < 250 ? b : special(in.byte());
	}
	}
}

/// Into the type's numbers.
double fitted(double x, NumberType type)
{
	if (type == NumberType::Double)
		return x;
	if (type == NumberType::Integer)
		return std::isfinite(x) && std::abs(x) < 9e15 ? std::floor(x) + 0.0 : 0;
	constexpr double kLargest = double(std::numeric_limits<float>::max());
	if (std::isfinite(x) && std::abs(x) > kLargest)
		return 0;
	return std::isnan(x) ? double(std::numeric_limits<float>::quiet_NaN()) : double(float(x));
}

void drawFaces(ByteSource& in, MeshData& mesh)
{
	const auto n        = std::uint32_t(mesh.positions.size());
	std::uint32_t fresh = 0; // vertices in turn, for surfaces that grow
	while (!in.empty() && mesh.triangles.size() < 400) {
		const std::uint8_t what = in.byte();
		const auto& faces       = mesh.triangles;
		const auto last         = faces.empty() ? std::array<std::uint32_t, 3> {0, 1 % n, 2 % n}
		                                        : faces[faces.size() - 1 - what % 16 % faces.size()];
		switch (what >> 4) {
		default: // on to the next vertex, at an edge of a face before
			mesh.triangles.push_back({last[1 + what % 2], last[what % 2], fresh++ % n});
			break;
		case 8:
		case 9: // back to an earlier vertex
			mesh.triangles.push_back({last[2], last[1], in.byte() % n});
			break;
		case 10: // the same face again, either way round
			mesh.triangles.push_back(
			    what & 1 ? last : std::array<std::uint32_t, 3> {last[0], last[2], last[1]});
			break;
		case 11:
			mesh.triangles.push_back({last[0], last[0], last[what % 3]});
			break;
		case 12: // a fan about the first
			mesh.triangles.push_back({0, fresh % n, (fresh + 1) % n});
			++fresh;
			break;
		case 13:
		case 14: { // any
			const std::uint32_t a = in.byte() % n, b = in.byte() % n;
			mesh.triangles.push_back({a, b, in.byte() % n});
			break;
		}
		case 15: // a strip of quads, `what % 16` long
			for (std::uint32_t i = 0; i < what % 16u; ++i, ++fresh) {
				mesh.triangles.push_back({fresh % n, (fresh + 1) % n, (fresh + 17) % n});
				mesh.triangles.push_back({(fresh + 1) % n, (fresh + 18) % n, (fresh + 17) % n});
			}
			break;
		}
	}
}

Attribute drawnAttribute(ByteSource& in, const MeshData& mesh)
{
	Attribute a;
	a.of         = AttributeOf(in.below(4));
	a.kind       = AttributeKind(in.below(12));
	a.type       = NumberType(in.below(3));
	a.components = 1 + int(in.below(5));
	a.name.assign(in.below(4), char(in.byte()));
	const std::uint32_t style = in.below(6), repeat = 1 + in.below(4);
	const std::size_t rows[] = {
	    mesh.positions.size(), mesh.triangles.size(), 3 * mesh.triangles.size(), 1};
	double x = 0;
	for (std::size_t i = 0; i < rows[std::size_t(a.of)] * std::size_t(a.components); ++i) {
		if (i % repeat == 0)
			x = fitted(drawnNumber(in, style), a.type);
		a.values.push_back(x);
	}
	return a;
}

} // namespace

EncodeOptions drawnOptions(ByteSource& in)
{
	EncodeOptions o;
	const std::uint32_t what = in.byte();
	o.mode                   = what & 1 ? Mode::Compact : Mode::Classic;
	o.keepOrder              = (what & 2) != 0;
	o.exact                  = (what & 4) != 0;
	o.effort                 = 1 + int((what >> 3) % 3);
	o.lifting                = int(what >> 6) - 1;
	const std::uint32_t more = in.byte();
	o.bits                   = 1 + int(more % 24);
	o.optimize               = Optimize(in.below(3));
	o.wgc                    = Wgc(in.below(3));
	if (in.byte() >= 250)
		o.step = std::ldexp(1.0, int(in.below(30)) - 10);
	return o;
}

MeshData drawnMesh(ByteSource& in)
{
	MeshData mesh;
	const std::uint32_t vertices = in.byte(), style = in.below(6), attributes = in.below(4);
	for (std::uint32_t v = 0; v < vertices; ++v) {
		// Where the input is short, places are still not all the same.
		mesh.positions.push_back({double(v % 16), double(v / 16), 0});
		if (v < 60)
			for (double& x : mesh.positions.back())
				x = drawnNumber(in, style);
	}
	const std::uint32_t names = in.below(3);
	mesh.textures.assign(names, std::string(names, char(in.byte())));
	std::vector<std::uint8_t> kept; // attributes need the faces, which take what is left
	for (std::uint32_t i = 0; i < 40 * attributes; ++i)
		kept.push_back(in.byte());
	if (vertices > 0)
		drawFaces(in, mesh);
	ByteSource rest(kept.data(), kept.size());
	for (std::uint32_t i = 0; i < attributes; ++i)
		mesh.attributes.push_back(drawnAttribute(rest, mesh));
	return mesh;
}

} // namespace wavemesh::test
