// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a PLY has of its own: properties of vertices and faces that no format names, as
/// user-defined attributes. VCGLib's importer would want their names first, and writes beyond its
/// faces where one of these is a polygon.
#pragma once

#include "file_io.h"

#include <wavemesh/mesh_data.h>

#include <string>
#include <vector>

namespace wavemesh::tool {

struct PlyProperties
{
	/// Numbers, and lists that have three numbers everywhere. As many rows as vertices or as
	/// triangles, those of a polygon one after the other.
	std::vector<Attribute> attributes;
	/// In a user's words; all else that neither these nor VCGLib take.
	std::vector<std::string> notRead;
};

/// @pre whatIsWrongWithPly(file) is empty
PlyProperties readPlyProperties(const Bytes& file);

/// Has the name a meaning in a PLY, for a vertex or a face?
bool isNameInPly(AttributeOf of, const std::string& name);

} // namespace wavemesh::tool
