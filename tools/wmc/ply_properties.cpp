// SPDX-License-Identifier: GPL-3.0-or-later
#include "ply_properties.h"

#include "ply_reader.h"

#include <algorithm>
#include <cmath>

namespace wavemesh::tool {
namespace {

using namespace ply;

enum : unsigned { kFloat = 1, kDouble = 2, kByte = 4, kInt = 8, kReal = kFloat | kDouble };

/// A property as VCGLib's importer takes it.
struct Known
{
	const char* name;
	unsigned types;
};

constexpr Known kOfVertex[] = {
    {"x", kReal},
    {"y", kReal},
    {"z", kReal},
    {"nx", kReal},
    {"ny", kReal},
    {"nz", kReal},
    {"quality", kReal},
    {"confidence", kFloat},
    {"radius", kReal},
    {"red", kByte},
    {"green", kByte},
    {"blue", kByte},
    {"alpha", kByte},
    {"diffuse_red", kByte},
    {"diffuse_green", kByte},
    {"diffuse_blue", kByte},
    {"diffuse_alpha", kByte},
    {"texture_u", kReal},
    {"texture_v", kReal},
    {"s", kFloat},
    {"t", kFloat},
    {"flags", kInt}};

constexpr Known kOfFace[] = {{"nx", kReal},         {"ny", kReal},        {"nz", kReal},
                             {"quality", kReal},    {"red", kByte},       {"green", kByte},
                             {"blue", kByte},       {"alpha", kByte},     {"flags", kInt},
                             {"texnumber", kInt},   {"texcoord", kFloat}, {"vertex_indices", kInt},
                             {"vertex_index", kInt}};

const Known* find(AttributeOf of, const std::string& name)
{
	const auto isIt    = [&](const Known& k) { return name == k.name; };
	const Known* end   = of == AttributeOf::Vertex ? std::end(kOfVertex) : std::end(kOfFace);
	const Known* found = std::find_if(
	    of == AttributeOf::Vertex ? std::begin(kOfVertex) : std::begin(kOfFace), end, isIt);
	return found == end ? nullptr : found;
}

bool isKnown(AttributeOf of, const Element& e, const Property& p)
{
	if (isFaceList(e, p))
		return true;
	const Known* known   = find(of, p.name);
	const unsigned type  = p.item.isFloating ? (p.item.bytes == 4 ? kFloat : kDouble)
	                       : p.item.bytes == 4 && p.item.isSigned  ? kInt
	                       : p.item.bytes == 1 && !p.item.isSigned ? kByte
	                                                               : 0u;
	const auto isQuality = [](const Property& q) { return q.name == "quality"; };
	// Both are the quality; the importer takes one.
	if (p.name == "confidence" && std::any_of(e.properties.begin(), e.properties.end(), isQuality))
		return false;
	return known && (known->types & type) && p.isList == (p.name == "texcoord");
}

/// A property on its way to become an attribute.
struct Column
{
	bool isRead   = false;
	bool isBroken = false; ///< a list that has other than three numbers somewhere
	Attribute attribute;
	std::size_t rowBegins = 0;
};

Column columnOf(AttributeOf of, const Element& e, std::size_t i)
{
	const Property& p = e.properties[i];
	Column c;
	c.isRead =
	    !isKnown(of, e, p) && std::none_of(
	                              e.properties.begin(), e.properties.begin() + std::ptrdiff_t(i),
	                              [&](const Property& q) { return q.name == p.name; });
	c.attribute.of         = of;
	c.attribute.name       = p.name;
	c.attribute.components = p.isList ? 3 : 1;
	c.attribute.type       = !p.item.isFloating  ? NumberType::Integer
	                         : p.item.bytes == 4 ? NumberType::Float
	                                             : NumberType::Double;
	return c;
}

/// Reads a property of an element. @return of a list, how long it is
std::size_t readInto(Column& c, const Property& p, Numbers& numbers)
{
	double count = 1;
	if (p.isList && !numbers.next(p.count, count))
		return 0;
	const auto n = static_cast<std::size_t>(count);
	if (!c.isRead || (p.isList && n != 3)) {
		c.isBroken = c.isRead || c.isBroken;
		c.isRead   = false;
		numbers.skip(n, p.item);
		return n;
	}
	c.rowBegins = c.attribute.values.size();
	for (std::size_t k = 0; k < n; ++k) {
		double x = 0;
		numbers.next(p.item, x);
		const bool isNarrow = p.item.isFloating && p.item.bytes == 4;
		c.attribute.values.push_back(isNarrow ? double(static_cast<float>(x)) : x);
	}
	return n;
}

/// The row again, for the other triangles of a polygon.
void repeatRow(Column& c, std::size_t times)
{
	auto& values = c.attribute.values;
	for (std::size_t i = 0; c.isRead && i < times; ++i)
		for (int k = 0; k < c.attribute.components; ++k)
			values.push_back(values[c.rowBegins + std::size_t(k)]);
}

bool isWhole(double x)
{
	return std::abs(x) <= 9007199254740992.0 && x == std::floor(x);
}

void readElement(const Element& e, Numbers& numbers, PlyProperties& out)
{
	const bool isFace    = e.name == "face";
	const AttributeOf of = isFace ? AttributeOf::Face : AttributeOf::Vertex;
	std::vector<Column> columns;
	for (std::size_t i = 0; i < e.properties.size(); ++i)
		columns.push_back(columnOf(of, e, i));
	for (std::uint64_t row = 0; row < e.number; ++row) {
		std::size_t corners = 3;
		for (std::size_t i = 0; i < columns.size(); ++i) {
			const std::size_t n = readInto(columns[i], e.properties[i], numbers);
			if (isFaceList(e, e.properties[i]))
				corners = n;
		}
		for (Column& c : columns)
			repeatRow(c, corners - 3);
	}
	for (Column& c : columns) {
		auto& values = c.attribute.values;
		// A text may have anything.
		if (c.attribute.type == NumberType::Integer &&
		    !std::all_of(values.begin(), values.end(), isWhole))
			c.attribute.type = NumberType::Double;
		if (c.isRead && !values.empty())
			out.attributes.push_back(std::move(c.attribute));
		else if (c.isBroken)
			out.notRead.push_back(e.name + " list '" + c.attribute.name + "'");
	}
}

} // namespace

PlyProperties readPlyProperties(const Bytes& file)
{
	PlyProperties out;
	Head head;
	if (!parseHead(file, head).empty())
		return out;
	Numbers numbers(file, head);
	for (const Element& e : head.elements) {
		if (e.name == "vertex" || e.name == "face") {
			readElement(e, numbers, out);
			continue;
		}
		if (e.number > 0 && e.name != "tristrips" && e.name != "range_grid")
			out.notRead.push_back("element '" + e.name + "'");
		for (std::uint64_t row = 0; row < e.number; ++row)
			for (const Property& p : e.properties) {
				double count = 1;
				if (p.isList)
					numbers.next(p.count, count);
				numbers.skip(static_cast<std::uint64_t>(count), p.item);
			}
	}
	return out;
}

bool isNameInPly(AttributeOf of, const std::string& name)
{
	return find(of, name) != nullptr;
}

} // namespace wavemesh::tool
