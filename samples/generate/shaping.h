// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What makes a made-up mesh look like a real one: irregular connectivity, decent triangles.
#pragma once

#include <wavemesh/mesh_data.h>

#include <cstdint>
#include <functional>

namespace wavemesh::samples {

using Point = std::array<double, 3>;

/// Moves every vertex that `isFree` names towards the middle of its neighbours.
MeshData relaxed(
    MeshData mesh,
    int rounds,
    double weight,
    const std::function<bool(std::uint32_t)>& isFree = {});

/// Flips edges whose two opposite angles are larger together than a half turn, where the faces on
/// both sides are nearly in a plane.
MeshData withBetterAngles(const MeshData& mesh, int rounds);

/// `mesh` with `share` of its vertices taken out by random edge collapses, edges flipped at random
/// first and for better angles then.
MeshData irregular(const MeshData& mesh, double share, std::uint64_t seed);

std::vector<bool> boundaryVertices(const MeshData& mesh);

/// Every coordinate to a multiple of 2^-16: the same file from every mathematical library, and
/// exact in single precision.
MeshData snapped(MeshData mesh);

} // namespace wavemesh::samples
