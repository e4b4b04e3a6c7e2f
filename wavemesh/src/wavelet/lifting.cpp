// SPDX-License-Identifier: GPL-3.0-or-later
#include "wavelet/lifting.h"

#include "mesh/integer_math.h"

namespace wavemesh {
namespace {

std::int64_t ceilDivide(std::int64_t a, std::int64_t b)
{
	return a >= 0 ? (a + b - 1) / b : -(-a / b);
}

/// Adds sign * floor(alpha D) to the parents, (24).
void update(
    const UpdateWeights& weights,
    const std::vector<LatticePoint>& details,
    std::vector<LatticePoint>& positions,
    std::size_t parentCount,
    bool add)
{
	if (weights.begin.empty())
		return;
	std::vector<std::array<std::uint64_t, 3>> sums(parentCount, {0, 0, 0});
	for (std::size_t child = 0; child < details.size(); ++child)
		for (Index e = weights.begin[child]; e < weights.begin[child + 1]; ++e)
			for (std::size_t k = 0; k < 3; ++k)
				sums[weights.vertex[e]][k] +=
				    static_cast<std::uint64_t>(std::int64_t(weights.alpha[e]) * details[child][k]);
	for (std::size_t v = 0; v < parentCount; ++v)
		for (std::size_t k = 0; k < 3; ++k) {
			const auto shift =
			    static_cast<std::int32_t>(static_cast<std::int64_t>(sums[v][k]) >> 16);
			positions[v][k] = add ? wrappingAdd(positions[v][k], shift)
			                      : wrappingSubtract(positions[v][k], shift);
		}
}

} // namespace

Parents parentsOf(const CornerTable& parent, const Refinement& r)
{
	Parents parents(r.childVertices - r.parentVertices);
	Index centre = r.childVertices - r.parentVertices;
	for (const FaceCode code : r.faceCode)
		centre -= code == kFaceCentre;
	forEachSplitEdge(parent, r.childOnEdge, [&](Index c, Index child) {
		parents[child - r.parentVertices] = {
		    parent.vertex[nextCorner(c)], parent.vertex[prevCorner(c)], kNone};
	});
	for (Index f = 0; f < parent.faceCount(); ++f)
		if (r.faceCode[f] == kFaceCentre)
			parents[centre++] = {
			    parent.vertex[3 * f], parent.vertex[3 * f + 1], parent.vertex[3 * f + 2]};
	return parents;
}

LatticePoint middle(const std::vector<LatticePoint>& positions, const std::array<Index, 3>& parents)
{
	LatticePoint m;
	const LatticePoint &a = positions[parents[0]], &b = positions[parents[1]];
	for (std::size_t k = 0; k < 3; ++k) {
		const std::int64_t sum = std::int64_t(a[k]) + b[k];
		m[k]                   = static_cast<std::int32_t>(
            parents[2] == kNone ? (sum + 1) >> 1 : ceilDivide(sum + positions[parents[2]][k], 3));
	}
	return m;
}

void keepStill(const Glue& glue, UpdateWeights& weights)
{
	if (glue.empty())
		return;
	for (std::size_t e = 0; e < weights.vertex.size(); ++e)
		if (glue.isShared(weights.vertex[e]))
			weights.alpha[e] = 0;
}

std::vector<LatticePoint>
analyse(const Parents& parents, const UpdateWeights& weights, std::vector<LatticePoint>& positions)
{
	const std::size_t parentCount = positions.size() - parents.size();
	std::vector<LatticePoint> details(parents.size());
	for (std::size_t i = 0; i < parents.size(); ++i) {
		const LatticePoint m = middle(positions, parents[i]);
		for (std::size_t k = 0; k < 3; ++k)
			details[i][k] = wrappingSubtract(positions[parentCount + i][k], m[k]);
	}
	update(weights, details, positions, parentCount, true);
	return details;
}

void synthesise(
    const Parents& parents,
    const UpdateWeights& weights,
    const std::vector<LatticePoint>& details,
    std::vector<LatticePoint>& positions)
{
	const std::size_t parentCount = positions.size();
	update(weights, details, positions, parentCount, false);
	positions.resize(parentCount + parents.size());
	for (std::size_t i = 0; i < parents.size(); ++i) {
		const LatticePoint m = middle(positions, parents[i]);
		for (std::size_t k = 0; k < 3; ++k)
			positions[parentCount + i][k] = wrappingAdd(details[i][k], m[k]);
	}
}

} // namespace wavemesh
