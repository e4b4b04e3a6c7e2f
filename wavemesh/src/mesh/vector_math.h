// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Vectors between lattice points in double, for the encoder's choices: only IEEE operations, so
/// that every machine makes the same ones.
#pragma once

#include "mesh/corner_table.h"
#include "mesh/vec3.h"

namespace wavemesh {

using Vector3 = Vec3;

inline Vector3 difference(const LatticePoint& a, const LatticePoint& b)
{
	return {double(a[0]) - b[0], double(a[1]) - b[1], double(a[2]) - b[2]};
}
inline double squaredNorm(const Vector3& a)
{
	return dot(a, a);
}

} // namespace wavemesh
