// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Polygons from triangles whose common edges are told to be inside of one.
#pragma once

#include <wavemesh/mesh_data.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace wavemesh::tool {

/// The faces of a mesh, polygons put together.
struct Polygons
{
	/// Corners 3 * face + k of triangles, face after face and counter-clockwise in each. Where the
	/// triangles of a polygon are a fan, its first corner is the one that they share.
	std::vector<std::uint32_t> corners;
	std::vector<std::size_t> begin {0}; ///< of each face in `corners`, and the end
	bool complete = true;               ///< no edge inside a polygon is left between two faces

	std::size_t count() const { return begin.size() - 1; }
};

/// Triangles that are no polygon together stay triangles: rings, what has vertices inside or twice,
/// edges inside a polygon without a face behind them.
/// @param alike  may these corners of a vertex be one? Callable with two of them
Polygons
polygonsOf(const MeshData& mesh, const std::function<bool(std::uint32_t, std::uint32_t)>& alike);

} // namespace wavemesh::tool
