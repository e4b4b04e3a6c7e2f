// SPDX-License-Identifier: GPL-3.0-or-later
#include "multires/sharpness.h"

#include "mesh/vector_math.h"

namespace wavemesh {
Sharpness::Sharpness(
    const CornerTable& fine,
    const std::vector<LatticePoint>& positions,
    const GeometricalCriterion& criterion) :
        positions_(positions),
        criterion_(criterion)
{
	if (!criterion.active)
		return;
	std::vector<Vector3> normal(fine.faceCount());
	for (Index f = 0; f < fine.faceCount(); ++f) {
		const auto& a = positions[fine.vertex[3 * f]];
		normal[f]     = cross(
		        difference(positions[fine.vertex[3 * f + 1]], a),
		        difference(positions[fine.vertex[3 * f + 2]], a));
	}
	const double threshold = criterion.sharpness * criterion.sharpness;
	sharp_.assign(fine.vertexCount, 0);
	for (Index c = 0; c < fine.cornerCount(); ++c) {
		const Index across = fine.opposite[c];
		if (across != kNone && across < c)
			continue;
		bool sharp = across == kNone;
		if (!sharp) {
			// |n1 x n2| compared squared, which needs no normalisation
			const Vector3 &n1 = normal[c / 3], &n2 = normal[across / 3];
			sharp = squaredNorm(cross(n1, n2)) > threshold * squaredNorm(n1) * squaredNorm(n2);
		}
		if (sharp)
			sharp_[fine.vertex[nextCorner(c)]] = sharp_[fine.vertex[prevCorner(c)]] = 1;
	}
}

bool Sharpness::allows(const ChildOf& p) const
{
	if (!criterion_.active || !isSharp(p.child))
		return true;
	const auto& a       = positions_[p.parentA];
	const auto& b       = positions_[p.parentB];
	const Vector3 edge  = difference(a, b);
	const Vector3 twice = {
	    2.0 * positions_[p.child][0] - a[0] - b[0], 2.0 * positions_[p.child][1] - a[1] - b[1],
	    2.0 * positions_[p.child][2] - a[2] - b[2]};
	const double length = squaredNorm(edge);
	const double limit  = 2 * criterion_.deviation * length;
	return squaredNorm(cross(twice, edge)) < limit * limit;
}

} // namespace wavemesh
