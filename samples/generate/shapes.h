// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The sample meshes. All lengths in no unit in particular.
#pragma once

#include <wavemesh/mesh_data.h>

#include <cstdint>
#include <vector>

namespace wavemesh::samples {

MeshData makeBlob();    ///< smooth, closed, irregular
MeshData makePretzel(); ///< smooth, closed, genus 3
MeshData makeBracket(); ///< CAD: sharp edges, fillets, holes, long triangles; genus 8
MeshData makeIsland();  ///< terrain, open, with a lake that is a hole
MeshData makePieces();  ///< seven components, closed and open
MeshData makeVase();    ///< open; see vaseColours()
MeshData makePebble();  ///< the same kind as the blob, but tiny

/// RGBA of each vertex of the vase: glazed bands.
std::vector<std::array<std::uint8_t, 4>> vaseColours(const MeshData& vase);

} // namespace wavemesh::samples
