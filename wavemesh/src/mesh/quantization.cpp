// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/quantization.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wavemesh {
namespace {

/// Nearest 32-bit float at or below x (side < 0), or at or above; infinite beyond the largest.
double roundedToFloat(double x, int side)
{
	constexpr double kInfinity = std::numeric_limits<double>::infinity();
	if (std::abs(x) > double(std::numeric_limits<float>::max()))
		return side * kInfinity;
	const float f = static_cast<float>(x);
	if (side < 0 ? double(f) > x : double(f) < x)
		return double(std::nextafter(f, float(side) * std::numeric_limits<float>::infinity()));
	return double(f);
}

/// The largest coordinate there is.
double farCorner(const Lattice& lattice)
{
	const double extent = lattice.step * double((1 << lattice.bits) - 1);
	return *std::max_element(lattice.origin.begin(), lattice.origin.end()) + extent;
}

Status tooLarge()
{
	return {StatusCode::InvalidArgument, "the bounding box is too large for a double"};
}

} // namespace

Result<Lattice>
makeLattice(const std::vector<std::array<double, 3>>& positions, int bits, double step)
{
	if (bits < 1 || bits > kMaxBits)
		return Status(StatusCode::InvalidArgument, "bits per coordinate must be 1 to 24");
	if (!std::isfinite(step) || step < 0)
		return Status(StatusCode::InvalidArgument, "the step must be a positive, finite length");

	std::array<double, 3> low {}, high {};
	for (std::size_t i = 0; i < positions.size(); ++i)
		for (std::size_t k = 0; k < 3; ++k) {
			const double x = positions[i][k];
			if (!std::isfinite(x))
				return Status(
				    StatusCode::InvalidArgument,
				    "vertex " + std::to_string(i) +
				        " has a coordinate that is not finite: only exact coordinates keep it");
			low[k]  = i == 0 ? x : std::min(low[k], x);
			high[k] = i == 0 ? x : std::max(high[k], x);
		}
	const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
	if (!std::isfinite(extent))
		return tooLarge();

	Lattice lattice;
	lattice.origin = low;
	if (step > 0) {
		const double steps = std::round(extent / step);
		if (!(steps < double(1 << kMaxBits)))
			return Status(
			    StatusCode::InvalidArgument,
			    "the step is too small: the bounding box would have 2^24 steps or more");
		lattice.step = step;
		lattice.bits = 1;
		while (double((1 << lattice.bits) - 1) < steps)
			++lattice.bits;
		for (const double x : low)
			if (!std::isfinite(x + step * steps))
				return tooLarge();
		return lattice;
	}
	lattice.bits       = bits;
	const double steps = double((1 << bits) - 1);
	// A box that starts and ends on 32-bit floats takes half the room in the file; take it if it is
	// hardly larger.
	std::array<double, 3> start {};
	double wide = 0;
	for (std::size_t k = 0; k < 3; ++k) {
		start[k] = roundedToFloat(low[k], -1);
		wide     = std::max(wide, high[k] - start[k]);
	}
	wide = roundedToFloat(wide, +1);
	if (wide > 0 && std::isfinite(wide) && wide <= extent * (1 + 1.0 / 65536)) {
		lattice.origin = start;
		lattice.step   = wide / steps;
	}
	else
		lattice.step = extent / steps;
	if (!(extent > 0))
		lattice.step = 1;
	else if (std::round(extent / lattice.step) > steps) // rounded down, among the denormals
		lattice.step = std::nextafter(lattice.step, 1);
	constexpr int kRounding = 64; // steps may be rounded up, next to the largest double
	for (int i = 0; !std::isfinite(farCorner(lattice)); ++i) {
		if (i == kRounding)
			return tooLarge();
		lattice.step = std::nextafter(lattice.step, 0);
	}
	return lattice;
}

std::vector<std::array<double, 3>> finitePositions(std::vector<std::array<double, 3>> positions)
{
	constexpr double kLargest = 1e300; // the extent stays finite
	std::array<double, 3> low {};
	std::array<bool, 3> any {};
	for (const auto& p : positions)
		for (std::size_t k = 0; k < 3; ++k)
			if (std::isfinite(p[k])) {
				low[k] = any[k] ? std::min(low[k], p[k]) : p[k];
				any[k] = true;
			}
	for (auto& p : positions)
		for (std::size_t k = 0; k < 3; ++k)
			p[k] = std::clamp(std::isfinite(p[k]) ? p[k] : low[k], -kLargest, kLargest);
	return positions;
}

std::vector<LatticePoint>
quantise(const std::vector<std::array<double, 3>>& positions, const Lattice& lattice)
{
	std::vector<LatticePoint> points(positions.size());
	for (std::size_t i = 0; i < positions.size(); ++i)
		for (std::size_t k = 0; k < 3; ++k) {
			const double steps = std::round((positions[i][k] - lattice.origin[k]) / lattice.step);
			// No number at all is 0 as well.
			points[i][k] =
			    steps > 0
			        ? static_cast<std::int32_t>(std::min(steps, double((1 << lattice.bits) - 1)))
			        : 0;
		}
	return points;
}

} // namespace wavemesh
