// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Directions as whole points of an octahedron, |x| + |y| + |z| = radius: about as dense
/// everywhere, two numbers and a sign.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace wavemesh {

/// x, y, z; the sum of magnitudes is the radius.
using OctahedronPoint = std::array<std::int32_t, 3>;

/// The largest magnitude's axis, of equals the first.
template <class Number>
std::size_t dominantAxis(const std::array<Number, 3>& v)
{
	std::size_t axis = 0;
	for (std::size_t k = 1; k < 3; ++k)
		if (std::abs(v[k]) > std::abs(v[axis]))
			axis = k;
	return axis;
}

/// The point next to a direction of any length; that of z if it is none.
inline OctahedronPoint onOctahedron(const std::array<double, 3>& v, std::int32_t radius)
{
	const double sum = std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]);
	if (!(sum > 0) || !std::isfinite(sum))
		return {0, 0, radius};
	const std::size_t w = dominantAxis(v);
	OctahedronPoint out {};
	std::int32_t left = radius;
	for (const std::size_t k : {(w + 1) % 3, (w + 2) % 3}) {
		const auto n = std::int32_t(std::floor(std::abs(v[k]) / sum * radius + 0.5));
		out[k]       = v[k] < 0 ? -n : n;
		left -= n;
	}
	out[w] = v[w] < 0 ? -left : left;
	return out;
}

/// A point's direction, of length 1.
inline std::array<double, 3> directionOf(const OctahedronPoint& p)
{
	const double x = p[0], y = p[1], z = p[2];
	const double length = std::sqrt(x * x + y * y + z * z);
	return {x / length, y / length, z / length};
}

/// No component of a direction is off by more than this, in parts of the radius.
constexpr double kOctahedronError = 1.75;

} // namespace wavemesh
