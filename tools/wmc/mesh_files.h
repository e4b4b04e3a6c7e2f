// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Meshes from and to PLY, OBJ, OFF and STL, in double precision.
#pragma once

#include <wavemesh/mesh_data.h>

#include <string>
#include <vector>

namespace wavemesh::tool {

enum class Format { Ply, Obj, Off, Stl, Unknown };
/// By the file's name.
Format formatOf(const std::string& path);

/// Reads a mesh; the format is that of the file's name. Corners of an STL at the same place become
/// one vertex. Polygons are cut into triangles. Throws Failure, also where a file is damaged.
/// @param channels  of VcgChannel (wavemesh/vcg_attributes.h): attributes that are taken if the
///                  file has them
/// @param notRead   [out] if not null and kCustom is taken: what else a PLY has, in a user's words
MeshData loadMesh(
    const std::string& path, unsigned channels = 0, std::vector<std::string>* notRead = nullptr);

/// Throws UsageError if no mesh can be written under this name.
void checkMeshFormat(const std::string& path);
/// Is it named like a mesh that can be written, as .ply?
bool isNamedAsMesh(const std::string& path);

/// Writes a mesh whole or not at all, with the attributes that the format has; an OBJ with textures
/// also gets a material library, .mtl. PLY (binary), OBJ and OFF keep every bit of the coordinates,
/// STL is float. Throws Failure, UsageError.
/// @return names of the attributes that were not written
std::vector<std::string> saveMesh(const MeshData& mesh, const std::string& path);

} // namespace wavemesh::tool
