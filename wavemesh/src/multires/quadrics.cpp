// SPDX-License-Identifier: GPL-3.0-or-later
#include "multires/quadrics.h"

#include <algorithm>
#include <cmath>

namespace wavemesh {
namespace {

Vector3 product(const std::array<double, 6>& a, const Vector3& x)
{
	return {
	    a[0] * x[0] + a[1] * x[1] + a[2] * x[2], a[1] * x[0] + a[3] * x[1] + a[4] * x[2],
	    a[2] * x[0] + a[4] * x[1] + a[5] * x[2]};
}

} // namespace

void Quadric::addPlane(const Vector3& n, double weight)
{
	std::size_t k = 0;
	for (std::size_t i = 0; i < 3; ++i)
		for (std::size_t j = i; j < 3; ++j)
			a[k++] += weight * n[i] * n[j];
}

void Quadric::add(const Quadric& other, const Vector3& offset, double share)
{
	const Vector3 slope = product(other.a, offset);
	c += share * (dot(offset, slope) + 2 * dot(other.b, offset) + other.c);
	for (std::size_t k = 0; k < 3; ++k)
		b[k] += share * (other.b[k] + slope[k]);
	for (std::size_t k = 0; k < 6; ++k)
		a[k] += share * other.a[k];
}

double Quadric::at(const Vector3& x) const
{
	return std::max(0.0, dot(x, product(a, x)) + 2 * dot(b, x) + c);
}

Quadrics::Quadrics(const CornerTable& table, const std::vector<LatticePoint>& positions) :
        quadrics_(table.vertexCount)
{
	for (Index first = 0; first < table.cornerCount(); first += 3) {
		const LatticePoint& origin = positions[table.vertex[first]];
		const Vector3 normal       = cross(
		          difference(positions[table.vertex[first + 1]], origin),
		          difference(positions[table.vertex[first + 2]], origin));
		const double square = squaredNorm(normal);
		if (!(square > 0))
			continue;
		// |normal| is twice the area: (normal / |normal|)^2 * area / 3
		const double weight = 1 / (6 * std::sqrt(square));
		for (Index c = first; c < first + 3; ++c) {
			quadrics_[table.vertex[c]].addPlane(normal, weight);
			if (table.opposite[c] != kNone)
				continue;
			const Index from = table.vertex[nextCorner(c)], to = table.vertex[prevCorner(c)];
			const Vector3 edge   = difference(positions[to], positions[from]);
			const Vector3 across = cross(edge, normal);
			// A boundary edge stands for a square of its length, half to each end.
			const double share = squaredNorm(edge) / (2 * squaredNorm(across));
			quadrics_[from].addPlane(across, share);
			quadrics_[to].addPlane(across, share);
		}
	}
}

void Quadrics::carry(const Coarsening& step, const std::vector<LatticePoint>& finePositions)
{
	std::vector<Quadric> coarse;
	coarse.reserve(step.fineVertex.size());
	for (const Index v : step.fineVertex)
		coarse.push_back(quadrics_[v]);
	const auto give = [&](Index child, Index parent, double share) {
		coarse[parent].add(
		    quadrics_[child],
		    difference(finePositions[step.fineVertex[parent]], finePositions[child]), share);
	};
	const CornerTable& table = step.coarse;
	forEachSplitEdge(table, step.childOnEdge, [&](Index c, Index child) {
		give(child, table.vertex[nextCorner(c)], 0.5);
		give(child, table.vertex[prevCorner(c)], 0.5);
	});
	for (Index f = 0; f < step.centre.size(); ++f)
		if (step.centre[f] != kNone)
			for (Index c = 3 * f; c < 3 * f + 3; ++c)
				give(step.centre[f], table.vertex[c], 1.0 / 3);
	quadrics_ = std::move(coarse);
}

} // namespace wavemesh
