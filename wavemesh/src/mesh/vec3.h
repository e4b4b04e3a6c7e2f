// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Arithmetic of points and displacements in double. For filters and the encoder's choices, never
/// for what a decoder must repeat; only IEEE operations, so that every machine chooses the same.
#pragma once

#include <array>
#include <cmath>

namespace wavemesh {

using Vec3 = std::array<double, 3>;

inline Vec3 operator+(const Vec3& a, const Vec3& b)
{
	return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vec3 operator-(const Vec3& a, const Vec3& b)
{
	return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vec3 operator*(double s, const Vec3& a)
{
	return {s * a[0], s * a[1], s * a[2]};
}
inline double dot(const Vec3& a, const Vec3& b)
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vec3 cross(const Vec3& a, const Vec3& b)
{
	return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Vec3& a)
{
	return std::sqrt(dot(a, a));
}
/// Of length 1, or 0.
inline Vec3 unit(const Vec3& a)
{
	const double l = length(a);
	return l > 0 ? (1 / l) * a : Vec3 {0, 0, 0};
}

} // namespace wavemesh
