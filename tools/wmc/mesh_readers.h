// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A mesh out of the bytes of a file, by format. Polygons are cut into triangles, and their edges
/// inside are FauxEdges. All throw Failure with what is wrong, without the file's name.
#pragma once

#include "file_io.h"

#include <wavemesh/codec.h>
#include <wavemesh/mesh_data.h>

#include <string>
#include <vector>

namespace wavemesh::tool {

/// Of triangle k, 1..n - 2, in the fan of a polygon with n corners: its first corner, k and k + 1.
/// @return as in AttributeKind::FauxEdges
constexpr int edgesInside(std::size_t k, std::size_t n)
{
	return (k > 1 ? 1 : 0) + (k + 2 < n ? 4 : 0);
}

/// Triangles of polygons, triangle strips or a range grid; polygons are fans. Of a property for
/// which there is no channel, numbers and lists of three become attributes of its name.
/// @param channels  of VcgChannel (wavemesh/vcg_attributes.h): attributes to take
/// @param notRead   what else there is, in a user's words; added to if kCustom is taken
MeshData readPly(
    const Bytes& file,
    unsigned channels,
    std::vector<std::string>& notRead,
    const Progress& progress);

/// Coordinates, normals, texture coordinates and colours of vertices, colours of faces.
MeshData readOff(const Bytes& file, unsigned channels, const Progress& progress);

/// Text or binary. Corners at the same place become one vertex.
MeshData readStl(const Bytes& file);

/// Coordinates, colours and normals of vertices, texture coordinates of corners, colours of
/// materials as those of faces. What it says is taken as VCGLib takes it.
/// @param path  of the file, for its materials
MeshData
readObj(const Bytes& file, const std::string& path, unsigned channels, const Progress& progress);

} // namespace wavemesh::tool
