// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the names of a PLY's properties mean.
#pragma once

#include "ply_reader.h"

#include <wavemesh/mesh_data.h>

namespace wavemesh::tool {

/// Has the name a meaning in a PLY of this mesh, for a vertex or a face?
bool isNameInPly(const MeshData& mesh, AttributeOf of, const std::string& name);

namespace ply {

/// What a property is a part of, in the order of attributes. A place is that of a vertex, or the
/// list of a face's vertices.
enum Group { kPlace, kColour, kNormal, kQuality, kTexture, kRadius, kFaux, kWedges, kOwn };

/// A property whose name has a meaning.
struct Known
{
	const char* name;
	Group group;
	std::size_t column;
	int way         = 0;     ///< the same may be written in two
	bool isOptional = false; ///< the others of the group and way do without it
};

/// An attribute for the columns of a group.
Attribute attributeOf(AttributeOf of, Group group);
unsigned channelOf(AttributeOf of, Group group); ///< of VcgChannel (wavemesh/vcg_attributes.h)

/// The first of this name, or nullptr.
const Property* find(const Element& e, const std::string& name);
/// Has the element all of what belongs together, of types that fit?
bool isWhole(AttributeOf of, const Element& e, Group group, int way = 0);
/// What the property is in this element; nullptr if just numbers of that name.
const Known* whatItIs(AttributeOf of, const Element& e, const Property& p);

} // namespace ply
} // namespace wavemesh::tool
