// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The question of isomorphism.h for meshes that are no manifolds: any faces, the same one several
/// times, degenerate ones, isolated vertices.
#pragma once

#include "isomorphism.h"

namespace wavemesh::tool {

/// Empty if there is a one-to-one map of the vertices of `a` to those of `b` that keeps labels and
/// takes the faces of `a`, with orientation and number, to those of `b`; otherwise what differs, or
/// that no map was found: vertices are told apart by what is around them, and where that does not
/// help, by trying; a map that is found is checked. @pre all indices exist
std::string whatDiffersInAnyMesh(const LabelledMesh& a, const LabelledMesh& b);

} // namespace wavemesh::tool
