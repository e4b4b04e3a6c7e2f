// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Are two meshes the same up to the numbering of vertices and faces and the first corner of each
/// face? Exact, and linear but for meshes with many places that look alike far around.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace wavemesh::tool {

/// A mesh whose vertices carry labels, here points of a lattice; several may have the same.
struct LabelledMesh
{
	std::vector<std::array<std::int64_t, 3>> labels;     ///< #V by 3
	std::vector<std::array<std::uint32_t, 3>> triangles; ///< #F by 3
};

/// Empty if there is a one-to-one map of the vertices of `a` to those of `b` that keeps labels and
/// takes the faces of `a`, with their orientation, to those of `b`; otherwise the first difference
/// found. Both must be oriented 2-manifolds; where `a` is not, says so.
std::string whatDiffers(const LabelledMesh& a, const LabelledMesh& b);

} // namespace wavemesh::tool
