// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Meshes from and to PLY, OBJ, OFF and STL, through VCGLib and in double precision.
#pragma once

#include <wavemesh/mesh_data.h>

#include <string>

namespace wavemesh::tool {

/// Reads a mesh; the format is that of the file's name. Corners of an STL at the same place become
/// one vertex. Polygons are cut into triangles. Throws Failure, also where a file is damaged.
MeshData loadMesh(const std::string& path);

/// Throws UsageError if no mesh can be written under this name.
void checkMeshFormat(const std::string& path);

/// Writes a mesh whole or not at all. PLY (binary), OBJ and OFF keep every bit of the
/// coordinates, STL is float. Throws Failure, UsageError.
void saveMesh(const MeshData& mesh, const std::string& path);

} // namespace wavemesh::tool
