// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A mesh out of the bytes of a file, by format. Polygons are cut into triangles, and their edges
/// inside are kFauxEdges. All throw Failure with what is wrong, without the file's name.
#pragma once

#include "file_io.h"

#include <wavemesh/codec.h>
#include <wavemesh/mesh_data.h>

#include <string>
#include <vector>

namespace wavemesh::tool {

/// Triangles of polygons, triangle strips or a range grid; polygons are fans. Of a property for
/// which there is no channel, numbers and lists of three become attributes of its name.
/// @param channels  of Channel (wavemesh/vcg_attributes.h): attributes to take
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
