// SPDX-License-Identifier: GPL-3.0-or-later
#include "ply_properties.h"

#include "ply_reader.h"

#include <wavemesh/vcg_attributes.h>

#include <algorithm>
#include <cmath>

namespace wavemesh::tool {
namespace {

using namespace ply;

enum : unsigned { kFloat = 1, kDouble = 2, kByte = 4, kInt = 8, kReal = kFloat | kDouble };

/// Properties that say something only together.
enum Group { kAlone, kNormal, kColour, kDiffuse, kTexture, kSt, kWedges };

/// A property as VCGLib's importer takes it.
struct Known
{
	const char* name;
	unsigned types;
	Group group     = kAlone;
	bool isOptional = false; ///< the others of the group do without it
};

constexpr Known kOfVertex[] = {
    {"x", kReal},
    {"y", kReal},
    {"z", kReal},
    {"nx", kReal, kNormal},
    {"ny", kReal, kNormal},
    {"nz", kReal, kNormal},
    {"quality", kReal},
    {"radius", kFloat}, // doubles where there is room for a float
    {"red", kByte, kColour},
    {"green", kByte, kColour},
    {"blue", kByte, kColour},
    {"alpha", kByte, kColour, true},
    {"diffuse_red", kByte, kDiffuse},
    {"diffuse_green", kByte, kDiffuse},
    {"diffuse_blue", kByte, kDiffuse},
    {"diffuse_alpha", kByte, kDiffuse, true},
    {"texture_u", kReal, kTexture},
    {"texture_v", kReal, kTexture},
    {"s", kFloat, kSt},
    {"t", kFloat, kSt}};

constexpr Known kOfFace[] = {
    {"nx", kReal, kNormal},
    {"ny", kReal, kNormal},
    {"nz", kReal, kNormal},
    {"quality", kReal},
    {"red", kByte, kColour},
    {"green", kByte, kColour},
    {"blue", kByte, kColour},
    {"alpha", kByte, kColour, true},
    {"texnumber", kInt, kWedges, true},
    {"texcoord", kFloat, kWedges},
    {"vertex_indices", kInt},
    {"vertex_index", kInt}};

unsigned channelOf(AttributeOf of, Group group)
{
	const bool ofVertex = of == AttributeOf::Vertex;
	switch (group) {
	case kNormal:
		return ofVertex ? kVertexNormal : kFaceNormal;
	case kColour:
	case kDiffuse:
		return ofVertex ? kVertexColour : kFaceColour;
	case kTexture:
	case kSt:
		return kVertexTexCoord;
	case kWedges:
		return kWedgeTexCoord;
	case kAlone:
		break;
	}
	return 0;
}

/// Of vertices or faces.
struct Names
{
	const Known *begin, *end;
};
Names namesOf(AttributeOf of)
{
	if (of == AttributeOf::Vertex)
		return {std::begin(kOfVertex), std::end(kOfVertex)};
	return {std::begin(kOfFace), std::end(kOfFace)};
}

const Known* find(AttributeOf of, const std::string& name)
{
	const Names names  = namesOf(of);
	const auto isIt    = [&](const Known& k) { return name == k.name; };
	const Known* found = std::find_if(names.begin, names.end, isIt);
	return found == names.end ? nullptr : found;
}

unsigned typeOf(const Property& p)
{
	if (p.item.isFloating)
		return p.item.bytes == 4 ? kFloat : kDouble;
	if (p.item.bytes == 4)
		return p.item.isSigned ? kInt : 0u;
	return p.item.bytes == 1 && !p.item.isSigned ? kByte : 0u;
}

/// The name that the importer knows it by, if it is of a type that it takes.
const Known* whatItIs(AttributeOf of, const Property& p)
{
	const Known* known = find(of, p.name);
	const bool fits = known && (known->types & typeOf(p)) && p.isList == (p.name == "texcoord") &&
	                  (!p.isList || (p.count.bytes == 1 && !p.count.isSigned));
	return fits ? known : nullptr;
}

/// Has the element all of a group, and of one type?
bool isWhole(AttributeOf of, const Element& e, Group group)
{
	const Names names = namesOf(of);
	unsigned types    = ~0u;
	for (const Known* k = names.begin; k != names.end; ++k) {
		if (k->group != group || k->isOptional)
			continue;
		const auto isIt  = [&](const Property& p) { return whatItIs(of, p) == k; };
		const auto found = std::find_if(e.properties.begin(), e.properties.end(), isIt);
		if (found == e.properties.end())
			return false;
		types &= typeOf(*found);
	}
	return types != 0;
}

bool isKnown(AttributeOf of, const Element& e, const Property& p)
{
	if (isFaceList(e, p))
		return true;
	const Known* known = whatItIs(of, p);
	return known && (known->group == kAlone || isWhole(of, e, known->group));
}

bool isReal(const Element& e, const char* name, unsigned types)
{
	return std::any_of(e.properties.begin(), e.properties.end(), [&](const Property& p) {
		return p.name == name && !p.isList && (typeOf(p) & types);
	});
}

/// What the importer takes for a channel of vertices and gets wrong: it puts floats where there is
/// room for doubles, or the other way round, and makes a grey of an intensity.
unsigned misreadChannels(const Element& vertex)
{
	unsigned channels = 0;
	if (isReal(vertex, "radius", kDouble))
		channels |= kVertexRadius;
	if (isReal(vertex, "confidence", kFloat)) // for both there is one place
		channels |= kVertexQuality;
	if (isReal(vertex, "intensity", kFloat) && !isWhole(AttributeOf::Vertex, vertex, kColour) &&
	    !isWhole(AttributeOf::Vertex, vertex, kDiffuse))
		channels |= kVertexColour;
	return channels;
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
	const bool isFirst = std::none_of(
	    e.properties.begin(), e.properties.begin() + std::ptrdiff_t(i),
	    [&](const Property& q) { return q.name == p.name; });
	c.isRead               = isFirst && !isKnown(of, e, p);
	c.attribute.of         = of;
	c.attribute.name       = p.name;
	const unsigned misread = of == AttributeOf::Vertex ? misreadChannels(e) : 0;
	if (p.name == "radius" && (misread & kVertexRadius)) {
		c.attribute.kind = AttributeKind::Radius;
		c.attribute.name.clear();
	}
	const char* quality = isReal(e, "quality", kReal) ? "quality" : "confidence";
	if (p.name == quality && (misread & kVertexQuality)) {
		c.isRead         = isFirst;
		c.attribute.kind = AttributeKind::Quality;
		c.attribute.name.clear();
	}
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

bool isWholeNumber(double x)
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
		    !std::all_of(values.begin(), values.end(), isWholeNumber))
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

unsigned channelsNotToTake(const Bytes& file)
{
	Head head;
	unsigned part = 0, whole = 0, misread = 0;
	if (!parseHead(file, head).empty())
		return 0;
	for (const Element& e : head.elements) {
		if (e.name != "vertex" && e.name != "face")
			continue;
		const AttributeOf of = e.name == "face" ? AttributeOf::Face : AttributeOf::Vertex;
		if (of == AttributeOf::Vertex)
			misread = misreadChannels(e);
		for (const Property& p : e.properties)
			if (const Known* known = whatItIs(of, p); known && known->group != kAlone)
				(isWhole(of, e, known->group) ? whole : part) |= channelOf(of, known->group);
	}
	return (part & ~whole) | misread;
}

bool isNameInPly(const MeshData& mesh, AttributeOf of, const std::string& name)
{
	const Known* known = find(of, name);
	if (!known || known->group == kAlone)
		return known != nullptr;
	if (channelsOf(mesh) & channelOf(of, known->group))
		return true;
	const Names names  = namesOf(of);
	const auto isThere = [&](const Known& k) {
		return k.group != known->group || k.isOptional ||
		       std::any_of(mesh.attributes.begin(), mesh.attributes.end(), [&](const Attribute& a) {
			       return a.of == of && a.kind == AttributeKind::Custom && a.name == k.name;
		       });
	};
	return std::all_of(names.begin, names.end, isThere);
}

} // namespace wavemesh::tool
