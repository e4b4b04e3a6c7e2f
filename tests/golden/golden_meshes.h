// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Meshes of the goldens that are about attributes, orientation and exact numbers.
#pragma once

#include <wavemesh/mesh_data.h>

namespace wavemesh::test {

/// A sphere one of whose vertices belongs to another sphere too, and an edge with three faces.
MeshData notManifold();
/// The mesh with every third face turned, some of them twice, turned and not; a face that is an
/// edge, vertices without faces.
MeshData turned(MeshData mesh);

/// One attribute of each coding: on lattices, on an octahedron, exact; of vertices, faces, corners
/// with a seam, the mesh; and edges of polygons.
MeshData withAttributes(MeshData mesh);
/// Corners only: texture coordinates with a seam, normals with a crease, whole numbers.
/// @param bits  of texture coordinates and normals; 0: exact
MeshData withCorners(MeshData mesh, NumberType type, int bits);
/// Not-a-numbers of many kinds, infinities, zeros of both signs: in coordinates, and in exact
/// attributes of vertices, faces and corners next to colours.
MeshData withNotFinite(MeshData mesh, NumberType type);
/// Normals in each way to code them: of vertices, faces, corners; on octahedra, on lattices since
/// they are not of length 1, exact since some are no numbers.
MeshData withNormals(MeshData mesh);
/// Selection, colour, quality of faces, edges of polygons, names of textures; many columns, some
/// of them all the same.
MeshData withFlags(MeshData mesh);

} // namespace wavemesh::test
