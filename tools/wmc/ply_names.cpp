// SPDX-License-Identifier: GPL-3.0-or-later
#include "ply_names.h"

#include <wavemesh/vcg_attributes.h>

#include <algorithm>

namespace wavemesh::tool {

namespace ply {
namespace {

const std::vector<Known>& namesOf(AttributeOf of)
{
	static const std::vector<Known> ofVertex = {
	    {"x", kPlace, 0},
	    {"y", kPlace, 1},
	    {"z", kPlace, 2},
	    {"red", kColour, 0},
	    {"green", kColour, 1},
	    {"blue", kColour, 2},
	    {"alpha", kColour, 3, 0, true},
	    {"diffuse_red", kColour, 0, 1},
	    {"diffuse_green", kColour, 1, 1},
	    {"diffuse_blue", kColour, 2, 1},
	    {"diffuse_alpha", kColour, 3, 1, true},
	    {"nx", kNormal, 0},
	    {"ny", kNormal, 1},
	    {"nz", kNormal, 2},
	    {"quality", kQuality, 0},
	    {"confidence", kQuality, 0, 1},
	    {"texture_u", kTexture, 0},
	    {"texture_v", kTexture, 1},
	    {"s", kTexture, 0, 1},
	    {"t", kTexture, 1, 1},
	    {"radius", kRadius, 0}};
	static const std::vector<Known> ofFace = {
	    {"vertex_indices", kPlace, 0},
	    {"vertex_index", kPlace, 0, 1},
	    {"red", kColour, 0},
	    {"green", kColour, 1},
	    {"blue", kColour, 2},
	    {"alpha", kColour, 3, 0, true},
	    {"nx", kNormal, 0},
	    {"ny", kNormal, 1},
	    {"nz", kNormal, 2},
	    {"quality", kQuality, 0},
	    {"texcoord", kWedges, 0},
	    {"texnumber", kWedges, 2, 0, true}};
	return of == AttributeOf::Vertex ? ofVertex : ofFace;
}

const Known* known(AttributeOf of, const std::string& name)
{
	const auto& names = namesOf(of);
	const auto found =
	    std::find_if(names.begin(), names.end(), [&](const Known& k) { return name == k.name; });
	return found == names.end() ? nullptr : &*found;
}

bool fits(AttributeOf of, const Known& known, const Property& p)
{
	const bool isPlaceOfFace = known.group == kPlace && of == AttributeOf::Face;
	if (isPlaceOfFace || (known.group == kWedges && !known.isOptional))
		return p.isList;
	return !p.isList && (known.group != kColour || (p.item.bytes == 1 && !p.item.isSigned)) &&
	       (known.group != kWedges || !p.item.isFloating);
}

} // namespace

Attribute attributeOf(AttributeOf of, Group group)
{
	constexpr struct
	{
		AttributeKind kind;
		NumberType type;
		int components;
	} kGroups[] = {
	    {AttributeKind::Custom, NumberType::Double, 3},
	    {AttributeKind::Colour, NumberType::Integer, 4},
	    {AttributeKind::Normal, NumberType::Double, 3},
	    {AttributeKind::Quality, NumberType::Double, 1},
	    {AttributeKind::TexCoord, NumberType::Double, 3},
	    {AttributeKind::Radius, NumberType::Double, 1},
	    {AttributeKind::FauxEdges, NumberType::Integer, 1},
	    {AttributeKind::TexCoord, NumberType::Double, 3},
	    {AttributeKind::Custom, NumberType::Double, 1}};
	const auto& g = kGroups[group];
	return vcg_detail::attribute(
	    group == kWedges ? AttributeOf::Corner : of, g.kind, g.type, g.components);
}

unsigned channelOf(AttributeOf of, Group group)
{
	MeshData only;
	only.attributes.push_back(attributeOf(of, group));
	return channelsOf(only);
}

const Property* find(const Element& e, const std::string& name)
{
	const auto isIt  = [&](const Property& p) { return p.name == name; };
	const auto found = std::find_if(e.properties.begin(), e.properties.end(), isIt);
	return found == e.properties.end() ? nullptr : &*found;
}

bool isWhole(AttributeOf of, const Element& e, Group group, int way)
{
	const auto& names = namesOf(of);
	return std::all_of(names.begin(), names.end(), [&](const Known& k) {
		const Property* p = find(e, k.name);
		return k.group != group || k.way != way || k.isOptional || (p && fits(of, k, *p));
	});
}

const Known* whatItIs(AttributeOf of, const Element& e, const Property& p)
{
	const Known* k = known(of, p.name);
	if (!k || !fits(of, *k, p) || !isWhole(of, e, k->group, k->way))
		return nullptr;
	// Of colours and texture coordinates the later are taken, but a confidence is no quality.
	const bool isSecond = k->way == 1 && (k->group == kQuality || k->group == kPlace);
	return isSecond && isWhole(of, e, k->group) ? nullptr : k;
}

} // namespace ply

bool isNameInPly(const MeshData& mesh, AttributeOf of, const std::string& name)
{
	using namespace ply;
	const Known* k = known(of, name);
	if (!k || k->group == kPlace)
		return k != nullptr;
	if (channelsOf(mesh) & channelOf(of, k->group))
		return k->group != kQuality || k->way == 0;
	// Alone it is a number like others.
	const auto isThere = [&](const Known& other) {
		return other.group != k->group || other.way != k->way || other.isOptional ||
		       std::any_of(mesh.attributes.begin(), mesh.attributes.end(), [&](const Attribute& a) {
			       return a.of == of && a.kind == AttributeKind::Custom && a.name == other.name;
		       });
	};
	const auto& names = namesOf(of);
	return std::all_of(names.begin(), names.end(), isThere);
}

} // namespace wavemesh::tool
