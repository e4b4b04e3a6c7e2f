// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the known part of a surface tells about its vertices: normals, Laplacians, and where in its
/// cell a vertex is likely to be. Positions are in sixteenths of a lattice unit or cell, below
/// 2^29.
#pragma once

#include "mesh/glue.h"

namespace wavemesh {

/// Vector between positions.
using Vector = std::array<std::int64_t, 3>;

inline Vector operator+(const Vector& a, const Vector& b)
{
	return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vector operator-(const Vector& a, const Vector& b)
{
	return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vector& operator+=(Vector& a, const Vector& b)
{
	return a = a + b;
}

/// Unit vector in 1/16384, or zero.
using UnitVector = std::array<std::int32_t, 3>;

/// n in the length of a unit vector. |n| < 2^60.
UnitVector normalised(const Vector& n);

/// a.n in the units of a. |a| < 2^40
inline std::int64_t along(const Vector& a, const UnitVector& n)
{
	return (a[0] * n[0] + a[1] * n[1] + a[2] * n[2]) >> 14;
}

/// Cross product; coordinates are clamped to 2^20 - 1 in magnitude first.
Vector clampedCross(Vector a, Vector b);

/// Area-weighted vertex normals. #V. Linear.
std::vector<UnitVector>
vertexNormals(const CornerTable& table, const std::vector<LatticePoint>& positions);

/// Mean of the neighbours, each counted once for each face shared, less the vertex. #V. Linear.
std::vector<LatticePoint>
laplacians(const CornerTable& table, const std::vector<LatticePoint>& positions);

/// Middle of a cell of 2^bits, in 1/16 of its parts: the mean of 16 times their indices.
inline LatticePoint middleOfCell(const LatticePoint& cell, int bits)
{
	LatticePoint m;
	for (std::size_t k = 0; k < 3; ++k)
		m[k] = 16 * cell[k] * (1 << bits) + 8 * ((1 << bits) - 1);
	return m;
}

/// Middles of all cells. #V by 3.
std::vector<LatticePoint> middlesOfCells(const std::vector<LatticePoint>& cells, int bits);

/// Where in its cell each vertex is likely to be: moved from the middle along the normal, half the
/// way to where the surface is smoothest, but never out of the cell.
///
/// @param cells  #V by 3
/// @param bits   a cell has 2^bits parts along each axis; 0: the middles themselves
/// @param glue   of the base mesh: vertices that lie at the same place stay in the middle
/// @return #V by 3, in 1/16 of a part. Linear.
std::vector<LatticePoint> likelyPositions(
    const CornerTable& table, const std::vector<LatticePoint>& cells, int bits, const Glue& glue);

} // namespace wavemesh
