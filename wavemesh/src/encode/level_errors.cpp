// SPDX-License-Identifier: GPL-3.0-or-later
#include "encode/level_errors.h"

#include "mesh/vector_math.h"
#include "wavelet/lifting.h"

#include <cmath>

namespace wavemesh {
namespace {

/// Twice the area vector of each vertex' fan. #V
std::vector<Vector3>
fanNormals(const CornerTable& table, const std::vector<LatticePoint>& positions)
{
	std::vector<Vector3> normals(table.vertexCount, Vector3 {});
	for (Index c = 0; c < table.cornerCount(); c += 3) {
		const LatticePoint& origin = positions[table.vertex[c]];
		const Vector3 n            = cross(
		               difference(positions[table.vertex[c + 1]], origin),
		               difference(positions[table.vertex[c + 2]], origin));
		for (Index i = c; i < c + 3; ++i)
			for (std::size_t k = 0; k < 3; ++k)
				normals[table.vertex[i]][k] += n[k];
	}
	return normals;
}

double areaOf(const CornerTable& table, const std::vector<LatticePoint>& positions)
{
	double sum = 0;
	for (Index c = 0; c < table.cornerCount(); c += 3) {
		const LatticePoint& origin = positions[table.vertex[c]];
		sum += std::sqrt(squaredNorm(cross(
		           difference(positions[table.vertex[c + 1]], origin),
		           difference(positions[table.vertex[c + 2]], origin)))) /
		       2;
	}
	return sum;
}

/// Squared distance times area that a split adds: each child a tent over its fan, as high as the
/// child lies above its parents' middle.
double errorOfSplit(
    const CornerTable& child, const Parents& parents, const std::vector<LatticePoint>& positions)
{
	const std::vector<Vector3> normals = fanNormals(child, positions);
	const std::size_t first            = child.vertexCount - parents.size();
	double sum                         = 0;
	for (std::size_t i = 0; i < parents.size(); ++i) {
		const Vector3& n  = normals[first + i];
		const double size = squaredNorm(n);
		if (!(size > 0))
			continue;
		const double height =
		    dot(n, difference(positions[first + i], middle(positions, parents[i])));
		// (height / |n|)^2 over an area of |n| / 2; the square of a tent has a sixth of its box.
		sum += height * height / std::sqrt(size) / 12;
	}
	return sum;
}

} // namespace

std::vector<double> levelErrors(const Levels& levels)
{
	std::vector<double> errors(levels.splits() + 1, 0);
	const double area = areaOf(levels.replay.finest, levels.positions);
	if (!(area > 0))
		return errors;
	for (std::size_t i = levels.splits(); i-- > 0;) {
		const ReplayedLevel& level = levels.replay.levels[i];
		const double added         = errorOfSplit(
		            levels.table(i + 1), parentsOf(level.parent, level.refinement), levels.positions);
		// What splits move adds up: coarse surfaces lie on the inner side, all of them.
		errors[i] = errors[i + 1] + std::sqrt(added / area);
	}
	return errors;
}

} // namespace wavemesh
