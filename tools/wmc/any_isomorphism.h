// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// As isomorphism.h, for any triangles: edges and vertices that are not manifold, faces not
/// oriented alike, degenerate faces, several times the same face, isolated vertices.
#pragma once

#include "isomorphism.h"

namespace wavemesh::tool {

/// Empty if there is a one-to-one map of the vertices of `a` to those of `b` that keeps labels and
/// takes the faces of `a` to those of `b`, each as often and up to its first corner; otherwise the
/// first difference found. Exact: it is empty for the same mesh, and for no other.
/// @param steps  [out] what it cost, if not null: places looked at
/// Cost O((V + F) log(V + F)), but for meshes whose parts look alike far around and are different.
std::string
whatDiffersInAnyMesh(const LabelledMesh& a, const LabelledMesh& b, std::uint64_t* steps = nullptr);

} // namespace wavemesh::tool
