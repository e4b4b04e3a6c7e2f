// SPDX-License-Identifier: GPL-3.0-or-later
#include "die.h"

#include "rng.h"
#include "shaping.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace wavemesh::samples {
namespace {

using Place = std::array<double, 2>; ///< on a side, -1..1

constexpr double kRoundness = 24; ///< exponent of the superellipsoid: a cube, nearly
constexpr int kCells        = 16; ///< along an edge
constexpr int kColumns      = 3;  ///< of charts in the texture
constexpr int kRows         = 2;
constexpr int kTile         = 96;   ///< pixels of a chart
constexpr double kInset     = 0.94; ///< of a side within its chart: the rest is for filters to read
constexpr double kPip       = 0.21; ///< radius

/// Opposite sides have seven pips together.
struct Side
{
	int pips;
	std::array<int, 3> out, right; ///< unit vectors
};
constexpr Side kSides[] = {{1, {0, 0, 1}, {1, 0, 0}},  {2, {0, -1, 0}, {1, 0, 0}},
                           {3, {1, 0, 0}, {0, 1, 0}},  {4, {-1, 0, 0}, {0, -1, 0}},
                           {5, {0, 1, 0}, {-1, 0, 0}}, {6, {0, 0, -1}, {1, 0, 0}}};

std::array<int, 3> cross(const std::array<int, 3>& a, const std::array<int, 3>& b)
{
	return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

std::vector<Place> pipsOf(int count)
{
	constexpr double d = 0.5;
	std::vector<Place> pips;
	if (count % 2 == 1)
		pips.push_back({0, 0});
	if (count >= 2)
		pips.insert(pips.end(), {{-d, d}, {d, -d}});
	if (count >= 4)
		pips.insert(pips.end(), {{d, d}, {-d, -d}});
	if (count == 6)
		pips.insert(pips.end(), {{-d, 0}, {d, 0}});
	return pips;
}

/// How far the nearest pip's centre is, in its radius.
double nearestPip(int count, const Place& at)
{
	double nearest = 100;
	for (const Place& pip : pipsOf(count))
		nearest = std::min(
		    nearest,
		    std::sqrt((at[0] - pip[0]) * (at[0] - pip[0]) + (at[1] - pip[1]) * (at[1] - pip[1])) /
		        kPip);
	return nearest;
}

/// Shows three sides to whoever looks along the z axis.
Point turned(const Point& p)
{
	constexpr double c = 0.8, s = 0.6, d = 12. / 13, t = 5. / 13;
	const Point q = {c * p[0] - s * p[2], p[1], s * p[0] + c * p[2]};
	return {q[0], d * q[1] - t * q[2], t * q[1] + d * q[2]};
}

Point inSpace(const Side& side, const Place& at)
{
	const auto up = cross(side.out, side.right);
	Point p {};
	for (std::size_t k = 0; k < 3; ++k)
		p[k] = side.out[k] + at[0] * side.right[k] + at[1] * up[k];
	double powers = 0;
	for (const double x : p)
		powers += std::pow(std::fabs(x), kRoundness);
	const double near  = nearestPip(side.pips, at);
	const double dent  = near < 1 ? 0.07 * (1 - near * near) : 0;
	const double round = (1 - dent) / std::pow(powers, 1 / kRoundness);
	for (double& x : p)
		x *= round;
	return turned(p);
}

/// Where a place on a side is in the texture, 0..1.
Place inTexture(std::size_t side, const Place& at)
{
	const double column = double(side % kColumns), row = double(side / kColumns);
	return {
	    (column + 0.5 + 0.5 * kInset * at[0]) / kColumns,
	    1 - (row + 0.5 - 0.5 * kInset * at[1]) / kRows};
}

} // namespace

MeshData makeDie()
{
	test::Rng rng(601);
	MeshData mesh;
	Attribute texture;
	texture.of         = AttributeOf::Corner;
	texture.kind       = AttributeKind::TexCoord;
	texture.type       = NumberType::Float;
	texture.components = 3;
	std::map<Point, std::uint32_t> rowOf; // the sides share the vertices of their edges
	for (std::size_t s = 0; s < std::size(kSides); ++s) {
		std::vector<std::uint32_t> grid;
		std::vector<Place> places;
		for (int j = 0; j <= kCells; ++j)
			for (int i = 0; i <= kCells; ++i) {
				const bool inside = i % kCells != 0 && j % kCells != 0;
				const auto along  = [&](int cell) {
                    const double shift = inside ? rng.between(-0.3, 0.3) : 0;
                    return 2 * (cell + shift) / kCells - 1;
				};
				const double x = along(i), y = along(j);
				places.push_back({x, y});
				MeshData corner;
				corner.positions = {inSpace(kSides[s], places.back())};
				const Point p    = snapped(corner).positions[0];
				grid.push_back(
				    rowOf.emplace(p, std::uint32_t(mesh.positions.size())).first->second);
				if (grid.back() == mesh.positions.size())
					mesh.positions.push_back(p);
			}
		const auto addFace = [&](const std::array<std::size_t, 3>& corners) {
			mesh.triangles.push_back({grid[corners[0]], grid[corners[1]], grid[corners[2]]});
			for (const std::size_t c : corners) {
				const Place uv = inTexture(s, places[c]);
				texture.values.insert(texture.values.end(), {uv[0], uv[1], 0});
			}
		};
		for (std::size_t j = 0; j < kCells; ++j)
			for (std::size_t i = 0; i < kCells; ++i) {
				const std::size_t a = j * (kCells + 1) + i, b = a + 1, c = b + kCells + 1,
				                  d = c - 1;
				if (rng.below(2) == 0) {
					addFace({a, b, c});
					addFace({a, c, d});
				}
				else {
					addFace({b, c, d});
					addFace({b, d, a});
				}
			}
	}
	mesh.attributes.push_back(std::move(texture));
	mesh.textures.push_back("die.png");
	return mesh;
}

Texture dieTexture()
{
	Texture t;
	t.width   = kColumns * kTile;
	t.height  = kRows * kTile;
	t.colours = {{{244, 236, 214}}, {{222, 206, 172}}, {{150, 88, 84}}, {{112, 22, 38}}};
	for (int y = 0; y < t.height; ++y)
		for (int x = 0; x < t.width; ++x) {
			const std::size_t side = std::size_t(y / kTile * kColumns + x / kTile);
			const auto along       = [](int pixel) {
                return (2 * (pixel % kTile + 0.5) / kTile - 1) / kInset;
			};
			const Place at      = {along(x), -along(y)};
			const double pip    = nearestPip(kSides[side].pips, at);
			const double border = std::max(std::fabs(at[0]), std::fabs(at[1]));
			t.pixels.push_back(pip < 0.92 ? 3 : pip < 1.08 ? 2 : border > 0.9 ? 1 : 0);
		}
	return t;
}

namespace {

void putBig(std::string& out, std::uint32_t value)
{
	for (int shift = 24; shift >= 0; shift -= 8)
		out += char(value >> shift & 255);
}

std::uint32_t crc32(const std::string& bytes)
{
	std::uint32_t crc = 0xffffffffu;
	for (const char c : bytes) {
		crc ^= std::uint8_t(c);
		for (int bit = 0; bit < 8; ++bit)
			crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0);
	}
	return ~crc;
}

void putChunk(std::string& out, const std::string& type, const std::string& data)
{
	putBig(out, std::uint32_t(data.size()));
	out += type + data;
	putBig(out, crc32(type + data));
}

/// One block, as it is.
std::string zlibStream(const std::string& data)
{
	std::uint32_t a = 1, b = 0; // Adler-32
	for (const char c : data) {
		a = (a + std::uint8_t(c)) % 65521;
		b = (b + a) % 65521;
	}
	std::string out = "\x78\x01\x01";
	for (const std::size_t size : {data.size(), ~data.size()}) {
		out += char(size & 255);
		out += char(size >> 8 & 255);
	}
	out += data;
	putBig(out, b << 16 | a);
	return out;
}

} // namespace

std::string asPng(const Texture& texture)
{
	std::string head, palette, rows;
	putBig(head, std::uint32_t(texture.width));
	putBig(head, std::uint32_t(texture.height));
	head += std::string("\x02\x03\x00\x00\x00", 5); // two bits a pixel, from a palette
	for (const auto& colour : texture.colours)
		for (const std::uint8_t c : colour)
			palette += char(c);
	const auto width = std::size_t(texture.width);
	for (std::size_t i = 0; i < texture.pixels.size(); i += 4) {
		if (i % width == 0)
			rows += char(0); // no filter
		int four = 0;
		for (std::size_t k = 0; k < 4; ++k)
			four = four << 2 | texture.pixels[i + k];
		rows += char(four);
	}
	std::string out = "\x89PNG\r\n\x1a\n";
	putChunk(out, "IHDR", head);
	putChunk(out, "PLTE", palette);
	putChunk(out, "IDAT", zlibStream(rows));
	putChunk(out, "IEND", "");
	return out;
}

} // namespace wavemesh::samples
