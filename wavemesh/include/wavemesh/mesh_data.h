// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The plain arrays that cross the codec's border.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace wavemesh {

/// A triangle mesh as arrays. Faces are oriented counter-clockwise seen from outside.
struct MeshData
{
	std::vector<std::array<double, 3>> positions;        ///< #V by 3, model units
	std::vector<std::array<std::uint32_t, 3>> triangles; ///< #F by 3, rows of `positions`
};

} // namespace wavemesh
