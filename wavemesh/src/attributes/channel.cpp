// SPDX-License-Identifier: GPL-3.0-or-later
#include "attributes/channel.h"

#include "attributes/octahedron.h"
#include "mesh/integer_math.h"

namespace wavemesh {
namespace {

constexpr int kFauxBits = 3; ///< one for each edge of a triangle

std::size_t rowsOf(const MeshData& mesh, AttributeOf of)
{
	switch (of) {
	case AttributeOf::Vertex:
		return mesh.positions.size();
	case AttributeOf::Face:
		return mesh.triangles.size();
	case AttributeOf::Corner:
		return 3 * mesh.triangles.size();
	case AttributeOf::Mesh:
		return 1;
	}
	return 0;
}

bool fits(double x, NumberType type)
{
	if (type == NumberType::Integer)
		return isDecimal(x, {true, 0});
	return type == NumberType::Double || isFloat(x);
}

Status wrong(const std::string& what)
{
	return {StatusCode::InvalidArgument, what};
}

struct Extent
{
	double low = 0, high = 0;
	bool finite = true, whole = true;

	double size() const { return high - low; }
};

Extent extentOf(const Attribute& a, std::size_t column)
{
	Extent e;
	for (std::size_t i = column; i < a.values.size(); i += std::size_t(a.components)) {
		const double x = a.values[i];
		e.finite       = e.finite && std::isfinite(x);
		e.whole        = e.whole && isDecimal(x, {true, 0});
		e.low          = i == column ? x : std::min(e.low, x);
		e.high         = i == column ? x : std::max(e.high, x);
	}
	return e;
}

int bitsFor(double steps)
{
	return bitLength(std::uint64_t(steps));
}

NumberFormat exactFormat(const Attribute& a)
{
	if (a.type == NumberType::Integer)
		return {true, 0};
	// What a prediction is off by, about: a hundredth of the range.
	double low = 0, high = 0;
	std::vector<std::array<double, 3>> rows;
	rows.reserve(a.values.size() / 3 + 1);
	for (std::size_t i = 0; i < a.values.size(); ++i) {
		if (i % 3 == 0)
			rows.push_back({a.values[i], a.values[i], a.values[i]});
		rows.back()[i % 3] = a.values[i];
		if (std::isfinite(a.values[i])) {
			low  = std::min(low, a.values[i]);
			high = std::max(high, a.values[i]);
		}
	}
	const double spread = (high - low) / 100;
	return formatOf(rows, std::isfinite(spread) ? spread : 1);
}

/// 0: normals that are not all of length 1, or are to be exact.
int octahedronBits(const Attribute& a)
{
	if (a.type == NumberType::Integer || a.bits < 2 || a.bits > Channel::kMostOctahedronBits)
		return 0;
	for (std::size_t i = 0; i < a.values.size(); i += 3) {
		const double x = a.values[i], y = a.values[i + 1], z = a.values[i + 2];
		if (!(std::abs(x * x + y * y + z * z - 1) < 1e-4))
			return 0;
	}
	return a.bits;
}

/// Lattices of the columns; none if the attribute has to be exact otherwise.
std::vector<Column> columnsOf(const Attribute& a)
{
	constexpr double kMostSteps = (1 << Column::kMostBits) - 1;

	std::vector<Extent> extents;
	double largest = 0; // of the columns that are rounded
	const int bits = a.type == NumberType::Integer ? 0 : a.bits;
	for (std::size_t k = 0; k < std::size_t(a.components); ++k) {
		Extent e = extentOf(a, k);
		e.whole  = e.whole && e.size() <= kMostSteps &&
		          (bits == 0 || bitsFor(e.size()) <= std::max(bits, 8));
		if (!e.finite || !std::isfinite(e.size()) || (!e.whole && bits == 0))
			return {};
		if (!e.whole)
			largest = std::max(largest, e.size());
		extents.push_back(e);
	}
	const bool isFaux = a.kind == AttributeKind::FauxEdges && a.of == AttributeOf::Face &&
	                    a.components == 1 && extents[0].whole && extents[0].low >= 0 &&
	                    extents[0].high < (1 << kFauxBits);
	if (isFaux)
		return {{0, 1, kFauxBits, true}};
	const double step = largest / double((std::uint32_t(1) << bits) - (bits > 0 ? 1u : 0u));
	std::vector<Column> columns;
	for (const Extent& e : extents) {
		if (e.whole)
			columns.push_back({e.low, 1, bitsFor(e.size()), true});
		else if (!(step > 0) || e.size() / step > kMostSteps)
			return {}; // steps too small to be told apart
		else
			columns.push_back({e.low, step, bitsFor(std::floor(e.size() / step + 0.5)), false});
	}
	return columns;
}

} // namespace

bool Channel::isFauxEdges() const
{
	return kind == AttributeKind::FauxEdges && of == AttributeOf::Face && columns.size() == 1 &&
	       columns[0].whole && columns[0].low == 0 && columns[0].bits == kFauxBits;
}

int Channel::bits() const
{
	int most = octahedron;
	for (const Column& c : columns)
		most = c.whole ? most : std::max(most, c.bits);
	return most;
}

double Channel::step() const
{
	if (octahedron > 0)
		return 2 * kOctahedronError / (1 << (octahedron - 1));
	for (const Column& c : columns)
		if (!c.whole)
			return c.step;
	return 0;
}

Status checkAttributes(const MeshData& mesh)
{
	if (mesh.attributes.size() > Channel::kMost)
		return wrong("the mesh has more than 64 attributes");
	if (mesh.textures.size() > 0xffff)
		return wrong("the mesh has more than 65535 textures");
	for (const std::string& name : mesh.textures)
		if (name.size() > 0xffff)
			return wrong("a texture's name is longer than 65535 bytes");
	for (std::size_t i = 0; i < mesh.attributes.size(); ++i) {
		const Attribute& a     = mesh.attributes[i];
		const std::string name = "attribute " + std::to_string(i) + " (" + a.name + ")";
		if (a.components < 1 || a.components > int(Channel::kMostColumns) || a.name.size() > 255 ||
		    a.of > AttributeOf::Mesh || a.type > NumberType::Double)
			return wrong(name + " is not well formed");
		if (a.bits < 0 || a.bits > Column::kMostBits)
			return wrong(name + " is to have other than 0 to 24 bits");
		const auto width = std::size_t(a.components);
		if (a.values.size() != rowsOf(mesh, a.of) * width)
			return wrong(name + " does not have one row for each element");
		for (std::size_t k = 0; k < a.values.size(); ++k)
			if (!fits(a.values[k], a.type))
				return wrong(
				    name + " has a number in row " + std::to_string(k / width) +
				    " that is not of its type");
	}
	return {};
}

Channel makeChannel(const Attribute& a)
{
	Channel c;
	c.of         = a.of;
	c.kind       = a.kind;
	c.type       = a.type;
	c.components = a.components;
	c.name       = a.name;
	c.octahedron = c.isNormal() ? octahedronBits(a) : 0;
	if (c.octahedron == 0)
		c.columns = columnsOf(a);
	if (c.octahedron == 0 && !c.onLattice())
		c.exact = exactFormat(a);
	return c;
}

std::vector<double> pickedRows(
    const std::vector<double>& rows, const std::vector<std::uint32_t>& from, std::size_t width)
{
	std::vector<double> out;
	out.reserve(from.size() * width);
	for (const std::uint32_t row : from)
		out.insert(
		    out.end(), rows.begin() + std::ptrdiff_t(row * width),
		    rows.begin() + std::ptrdiff_t((row + 1) * width));
	return out;
}

std::vector<double> turnedFauxEdges(
    const std::vector<double>& rows,
    const std::vector<std::uint32_t>& from,
    const std::vector<std::uint32_t>& corner)
{
	std::vector<double> out;
	out.reserve(from.size());
	for (std::size_t f = 0; f < from.size(); ++f) {
		const auto old     = std::uint64_t(rows[from[f]]);
		std::uint64_t turn = old & ~std::uint64_t(7);
		for (std::size_t k = 0; k < 3; ++k) {
			const std::uint32_t a = corner[3 * f + k] % 3, b = corner[3 * f + (k + 1) % 3] % 3;
			turn |= ((old >> (b == (a + 1) % 3 ? a : b)) & 1) << k;
		}
		out.push_back(double(turn));
	}
	return out;
}

std::vector<double> toRows(const Channel& channel, const std::vector<double>& values)
{
	std::vector<double> rows = values;
	for (std::size_t i = 0; channel.octahedron > 0 && i < rows.size(); i += 3) {
		const OctahedronPoint p =
		    onOctahedron({rows[i], rows[i + 1], rows[i + 2]}, 1 << (channel.octahedron - 1));
		std::copy(p.begin(), p.end(), rows.begin() + std::ptrdiff_t(i));
	}
	for (std::size_t i = 0; channel.onLattice() && i < rows.size(); ++i) {
		const Column& c = channel.columns[i % channel.width()];
		const double n  = std::floor((rows[i] - c.low) / c.step + 0.5);
		rows[i]         = std::clamp(n, 0.0, double((std::uint32_t(1) << c.bits) - 1));
	}
	return rows;
}

Attribute toAttribute(const Channel& channel, const std::vector<double>& rows)
{
	Attribute a;
	a.of               = channel.of;
	a.kind             = channel.kind;
	a.type             = channel.type;
	a.components       = channel.components;
	a.name             = channel.name;
	a.bits             = channel.bits();
	a.values           = rows;
	const auto rounded = [&](double x) {
		return channel.type == NumberType::Float ? double(nearestFloat(x)) : x;
	};
	for (std::size_t i = 0; channel.octahedron > 0 && i < rows.size(); i += 3) {
		const auto v = directionOf(
		    {std::int32_t(rows[i]), std::int32_t(rows[i + 1]), std::int32_t(rows[i + 2])});
		for (std::size_t k = 0; k < 3; ++k)
			a.values[i + k] = rounded(v[k]);
	}
	for (std::size_t i = 0; channel.onLattice() && i < rows.size(); ++i) {
		const Column& c = channel.columns[i % channel.width()];
		a.values[i]     = rounded(c.low + c.step * rows[i]);
	}
	return a;
}

} // namespace wavemesh
