// SPDX-License-Identifier: GPL-3.0-or-later
#include "attribute_options.h"

#include "failure.h"

#include <wavemesh/vcg_attributes.h>

#include <charconv>
#include <map>
#include <sstream>

namespace wavemesh::tool {

namespace {

/// A kind by the name that users give it.
struct Named
{
	const char* name;
	AttributeKind kind;
	unsigned channels;
	bool rounds; ///< may it have bits?
};

constexpr Named kNamed[] = {
    {"colour", AttributeKind::Colour, kVertexColour | kFaceColour, false},
    {"normal", AttributeKind::Normal, kVertexNormal | kFaceNormal, true},
    {"quality", AttributeKind::Quality, kVertexQuality | kFaceQuality, true},
    {"radius", AttributeKind::Radius, kVertexRadius, true},
    {"texcoord", AttributeKind::TexCoord, kVertexTexCoord | kWedgeTexCoord | kTextures, true},
    {"polygons", AttributeKind::FauxEdges, kFauxEdges, false},
    {"custom", AttributeKind::Custom, kCustom, true},
};

const Named& find(const std::string& name)
{
	for (const Named& n : kNamed)
		if (name == n.name || (name == "color" && n.kind == AttributeKind::Colour))
			return n;
	throw UsageError(
	    "'" + name +
	    "' is no attribute: colour, normal, quality, radius, texcoord, polygons, custom");
}

std::vector<std::string> splitAtCommas(const std::string& list)
{
	std::vector<std::string> parts;
	std::istringstream in(list);
	for (std::string part; std::getline(in, part, ',');)
		parts.push_back(part);
	return parts;
}

} // namespace

void AttributeOptions::addTo(CLI::App& command)
{
	const std::string group = "Attributes";
	command
	    .add_option(
	        "--attributes", kept,
	        "Which of the mesh's attributes to keep: none, all, or a list of colour, normal, "
	        "quality, radius, texcoord (with the names of textures), polygons, custom (further "
	        "numbers that a PLY has for each vertex or face)")
	    ->capture_default_str()
	    ->group(group);
	command
	    .add_option(
	        "--attribute-bits", bits,
	        "Bits over the range of an attribute, 1 to 24, or the word exact, as a list; what it "
	        "does not name has texcoord=12,normal=10,quality=16,radius=16, or is exact with "
	        "--exact. Numbers are off by half a step at most. Colours and whole numbers are always "
	        "exact")
	    ->group(group);
}

unsigned AttributeOptions::channels() const
{
	unsigned channels = 0;
	for (const Named& n : kNamed)
		channels |= kept == "all" ? n.channels : 0;
	if (kept != "all" && kept != "none")
		for (const std::string& name : splitAtCommas(kept))
			channels |= find(name).channels;
	return channels;
}

void AttributeOptions::setBits(MeshData& mesh, bool exact) const
{
	std::map<AttributeKind, int> given;
	for (const std::string& part : splitAtCommas(bits)) {
		const auto equals       = std::min(part.find('='), part.size());
		const Named& named      = find(part.substr(0, equals));
		const std::string value = part.substr(std::min(equals + 1, part.size()));
		int n                   = 0;
		const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), n);
		const bool isNumber =
		    error == std::errc() && end == value.data() + value.size() && n >= 1 && n <= 24;
		if (value != "exact" && !isNumber)
			throw UsageError("--attribute-bits: '" + part + "' is not KIND=1..24 or KIND=exact");
		if (!named.rounds && isNumber)
			throw UsageError("--attribute-bits: " + std::string(named.name) + " is always exact");
		given[named.kind] = isNumber ? n : 0;
	}
	for (Attribute& a : mesh.attributes) {
		const auto found = given.find(a.kind);
		a.bits           = found != given.end() ? found->second : exact ? 0 : usualBits(a.kind);
	}
}

std::string nameOf(AttributeKind kind)
{
	for (const Named& n : kNamed)
		if (n.kind == kind)
			return n.name;
	return kind == AttributeKind::Selected    ? "selection"
	       : kind == AttributeKind::Transform ? "transformation"
	                                          : "custom";
}

std::string nameOf(AttributeOf of)
{
	switch (of) {
	case AttributeOf::Vertex:
		return "vertex";
	case AttributeOf::Face:
		return "face";
	case AttributeOf::Corner:
		return "corner";
	case AttributeOf::Mesh:
		return "mesh";
	}
	return "unknown";
}

std::string nameOf(NumberType type)
{
	return type == NumberType::Integer ? "integer" : type == NumberType::Float ? "float" : "double";
}

std::string nameOf(AttributeOf of, AttributeKind kind, const std::string& name)
{
	return nameOf(of) + " " + nameOf(kind) + (name.empty() ? "" : " '" + name + "'");
}

} // namespace wavemesh::tool
