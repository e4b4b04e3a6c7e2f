// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a PLY has of its own: properties of vertices and faces that no format names, or of which it
/// has a part only, such as red without green and blue; as user-defined attributes. VCGLib's
/// importer would want their names first, and writes beyond its faces where one of these is a
/// polygon.
#pragma once

#include "file_io.h"

#include <wavemesh/mesh_data.h>

#include <string>
#include <vector>

namespace wavemesh::tool {

struct PlyProperties
{
	/// Numbers, and lists that have three numbers everywhere. As many rows as vertices or as
	/// triangles, those of a polygon one after the other. Also radius and quality that VCGLib
	/// would misread.
	std::vector<Attribute> attributes;
	/// In a user's words; all else that neither these nor VCGLib take.
	std::vector<std::string> notRead;
};

/// @pre whatIsWrongWithPly(file) is empty
PlyProperties readPlyProperties(const Bytes& file);

/// Channels of VcgChannel (wavemesh/vcg_attributes.h) that VCGLib gets wrong: of which the file has
/// a part only, or in types for which there is no room.
unsigned channelsNotToTake(const Bytes& file);

/// Has the name a meaning in a PLY of this mesh, for a vertex or a face?
bool isNameInPly(const MeshData& mesh, AttributeOf of, const std::string& name);

} // namespace wavemesh::tool
