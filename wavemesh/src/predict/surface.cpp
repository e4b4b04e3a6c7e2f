// SPDX-License-Identifier: GPL-3.0-or-later
#include "predict/surface.h"

#include "mesh/integer_math.h"

#include <algorithm>

namespace wavemesh {
namespace {

std::int64_t largest(const Vector& a)
{
	return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
}

Vector between(const LatticePoint& from, const LatticePoint& to)
{
	return {
	    std::int64_t(to[0]) - from[0], std::int64_t(to[1]) - from[1],
	    std::int64_t(to[2]) - from[2]};
}

/// Floor of the square root.
std::uint32_t squareRoot(std::uint32_t x)
{
	std::uint32_t root = 0;
	for (std::uint32_t bit = 1u << 15; bit != 0; bit >>= 1) {
		const std::uint32_t tried = root | bit;
		if (std::uint64_t(tried) * tried <= x)
			root = tried;
	}
	return root;
}

/// For each vertex the sum of its neighbours' values, each counted once for each face shared.
std::vector<Vector> ringSums(
    const CornerTable& table,
    const std::vector<LatticePoint>& values,
    std::vector<std::int32_t>& counts)
{
	std::vector<Vector> sums(table.vertexCount, {0, 0, 0});
	counts.assign(table.vertexCount, 0);
	for (Index c = 0; c < table.cornerCount(); c += 3) {
		const Index* v = &table.vertex[c];
		Vector all {0, 0, 0};
		for (std::size_t k = 0; k < 3; ++k)
			for (std::size_t i = 0; i < 3; ++i)
				all[k] += values[v[i]][k];
		for (std::size_t i = 0; i < 3; ++i) {
			for (std::size_t k = 0; k < 3; ++k)
				sums[v[i]][k] += all[k] - values[v[i]][k];
			counts[v[i]] += 2;
		}
	}
	return sums;
}

std::vector<LatticePoint>
ringMeansLessOwn(const CornerTable& table, const std::vector<LatticePoint>& values)
{
	std::vector<std::int32_t> counts;
	const std::vector<Vector> sums = ringSums(table, values, counts);
	std::vector<LatticePoint> out(values.size());
	for (std::size_t v = 0; v < out.size(); ++v)
		for (std::size_t k = 0; k < 3; ++k)
			out[v][k] = static_cast<std::int32_t>(
			    counts[v] == 0 ? 0 : sums[v][k] / counts[v] - values[v][k]);
	return out;
}

} // namespace

UnitVector normalised(const Vector& n)
{
	const std::int64_t size = largest(n);
	if (size == 0)
		return {0, 0, 0};
	const int length = bitLength(static_cast<std::uint64_t>(size));
	std::int32_t v[3]; // at most 2^15 in magnitude
	std::uint32_t squares = 0;
	for (std::size_t k = 0; k < 3; ++k) {
		v[k] = static_cast<std::int32_t>(
		    length > 15 ? n[k] >> (length - 15) : n[k] * (1 << (15 - length)));
		squares += static_cast<std::uint32_t>(v[k] * v[k]);
	}
	const auto root = static_cast<std::int32_t>(squareRoot(squares));
	UnitVector out;
	for (std::size_t k = 0; k < 3; ++k)
		out[k] = v[k] * 16384 / root;
	return out;
}

Vector clampedCross(Vector a, Vector b)
{
	constexpr std::int64_t kMost = (1 << 20) - 1;
	for (std::size_t k = 0; k < 3; ++k) {
		a[k] = std::clamp(a[k], -kMost, kMost);
		b[k] = std::clamp(b[k], -kMost, kMost);
	}
	return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

std::vector<UnitVector>
vertexNormals(const CornerTable& table, const std::vector<LatticePoint>& positions)
{
	std::vector<Vector> sums(table.vertexCount, {0, 0, 0});
	for (Index c = 0; c < table.cornerCount(); c += 3) {
		const Index* v        = &table.vertex[c];
		const LatticePoint& a = positions[v[0]];
		const Vector n = clampedCross(between(a, positions[v[1]]), between(a, positions[v[2]]));
		for (std::size_t i = 0; i < 3; ++i)
			sums[v[i]] += n;
	}
	std::vector<UnitVector> out(sums.size());
	for (std::size_t v = 0; v < out.size(); ++v)
		out[v] = normalised(sums[v]);
	return out;
}

std::vector<LatticePoint>
laplacians(const CornerTable& table, const std::vector<LatticePoint>& positions)
{
	return ringMeansLessOwn(table, positions);
}

std::vector<LatticePoint> middlesOfCells(const std::vector<LatticePoint>& cells, int bits)
{
	std::vector<LatticePoint> out;
	out.reserve(cells.size());
	for (const LatticePoint& cell : cells)
		out.push_back(middleOfCell(cell, bits));
	return out;
}

std::vector<LatticePoint> likelyPositions(
    const CornerTable& table, const std::vector<LatticePoint>& cells, int bits, const Glue& glue)
{
	std::vector<LatticePoint> out = middlesOfCells(cells, bits);
	if (bits == 0)
		return out;
	const std::vector<UnitVector> normals  = vertexNormals(table, out);
	const std::vector<LatticePoint> first  = laplacians(table, out);
	const std::vector<LatticePoint> second = ringMeansLessOwn(table, first);
	const std::int64_t reach               = 8 * ((std::int64_t(1) << bits) - 1);
	for (std::size_t v = 0; v < out.size(); ++v) {
		if (glue.isShared(Index(v)))
			continue;
		// Minus the Laplacian of the Laplacian.
		const Vector bend {
		    -std::int64_t(second[v][0]), -std::int64_t(second[v][1]), -std::int64_t(second[v][2])};
		const std::int64_t shift = along(bend, normals[v]);
		for (std::size_t k = 0; k < 3; ++k)
			out[v][k] +=
			    static_cast<std::int32_t>(std::clamp((shift * normals[v][k]) >> 15, -reach, reach));
	}
	return out;
}

} // namespace wavemesh
