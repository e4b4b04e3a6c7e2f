// SPDX-License-Identifier: GPL-3.0-or-later
#include "multires/hierarchy.h"

#include "multires/quadrics.h"
#include "multires/refine.h"
#include "multires/removal_error.h"

namespace wavemesh {
namespace {

/// Below this many vertices even a step that removes a single one is taken.
constexpr Index kSmall = 48;
/// ErrorCriterion::share where a smaller one leaves too much.
constexpr double kLenientShare = 0.95;
/// A free step may make so many times the error that the same vertices must make. On scanned shapes
/// it makes up to 9 times (on regular grids 14), on planes and edges more than 12: they lose most
/// at a few vertices.
constexpr double kFreeExcess = 10;

bool worthwhile(Index coarse, Index fine)
{
	return coarse < fine && (fine <= kSmall || coarse <= fine - fine / 16);
}

/// Seams that leave less to remove cost the surface beside them more than they are worth.
bool worthItsSeams(Index coarse, Index fine)
{
	return coarse <= fine - fine / 6;
}

template <class Value>
std::vector<Value> pick(const std::vector<Value>& values, const std::vector<Index>& rows)
{
	std::vector<Value> out;
	out.reserve(rows.size());
	for (const Index row : rows)
		out.push_back(values[row]);
	return out;
}

/// The refinement in the decoder's order; appends the new vertices' sources.
Refinement canonical(const CornerTable& parent, const Coarsening& step, std::vector<Index>& source)
{
	const std::vector<Index> match = matchCorners(parent, step.coarse, source);
	for (Index& v : source)
		v = step.fineVertex[v];

	Refinement r;
	r.parentVertices = r.childVertices = parent.vertexCount;
	r.childOnEdge.assign(parent.cornerCount(), kNone);
	r.faceCode.assign(parent.faceCount(), kFaceNone);
	for (Index c = 0; c < parent.cornerCount(); ++c) {
		const Index child = step.childOnEdge[match[c]], d = parent.opposite[c];
		if (child == kNone || (d != kNone && d < c))
			continue;
		r.childOnEdge[c] = r.childVertices++;
		if (d != kNone)
			r.childOnEdge[d] = r.childOnEdge[c];
		source.push_back(child);
	}
	std::vector<std::uint8_t> flipped(parent.faceCount(), 0);
	for (Index f = 0; f < parent.faceCount(); ++f) {
		const Index mine    = match[3 * f] / 3;
		const FaceCode code = step.faceCode[mine];
		if (code == kFaceCentre) {
			++r.childVertices;
			r.hasCentres = true;
			source.push_back(step.centre[mine]);
		}
		if (code == kFaceFlip1 || code == kFaceFlip2) {
			if (flipped[f])
				continue; // the face across has told already
			const Index corner = faceShape(r.childOnEdge, f).corner;
			const Index edge   = code == kFaceFlip1 ? nextCorner(corner) : prevCorner(corner);
			flipped[f] = flipped[parent.opposite[edge] / 3] = 1;
		}
		r.faceCode[f] = code;
	}
	return r;
}

/// One step by its error; with less choice, and at last without, where that removes too little.
Coarsening steer(
    const CornerTable& fine,
    const std::vector<LatticePoint>& points,
    const std::vector<std::uint8_t>& kept,
    ErrorCriterion criterion,
    const Seams& seams)
{
	Coarsening step;
	for (const double share : {criterion.share, kLenientShare}) {
		criterion.share = share;
		step            = coarsen(fine, points, {}, kept, criterion, &seams);
		if (worthwhile(step.coarse.vertexCount, fine.vertexCount))
			return step;
	}
	return seams.any() ? step : coarsen(fine, points, {}, kept);
}

/// One step by connectivity, and the geometrical criterion.
Coarsening coarsenFreely(
    const CornerTable& fine,
    const std::vector<LatticePoint>& points,
    const GeometricalCriterion& criterion,
    const std::vector<std::uint8_t>& kept,
    const Seams& seams)
{
	Coarsening step = coarsen(fine, points, criterion, kept, {}, &seams);
	// Where nearly everything is sharp the criterion would stop the coarsening for good.
	if (criterion.active && step.coarse.vertexCount > fine.vertexCount - fine.vertexCount / 4)
		step = coarsen(fine, points, {}, kept, {}, &seams);
	return step;
}

} // namespace

std::vector<Coarsening> coarsenAll(
    const CornerTable& table,
    const std::vector<LatticePoint>& positions,
    const GeometricalCriterion& criterion,
    const Steering& steering,
    const std::function<bool(double)>& step,
    const std::vector<std::uint8_t>& kept,
    Seams seams)
{
	std::vector<Coarsening> steps;
	const CornerTable* fine          = &table;
	std::vector<LatticePoint> points = positions;
	std::vector<std::uint8_t> stay   = kept;
	Quadrics quadrics;
	const bool steered = steering.freeSteps != Steering::kNever;
	double share       = steering.finestShare;
	bool regular       = true; // so far
	for (;;) {
		const int i = int(steps.size());
		Coarsening next;
		if (regular || i < steering.freeSteps)
			next = coarsenFreely(*fine, points, criterion, stay, seams);
		if (steered && i == 0)
			quadrics = Quadrics(table, positions);
		const bool isRegular =
		    regular && isRegularSplit(next.coarse.vertexCount, fine->vertexCount);
		const bool free =
		    isRegular || (i < steering.freeSteps &&
		                  (!steered || excessError(*fine, points, quadrics, next) <= kFreeExcess));
		if (!free)
			next = steer(*fine, points, stay, {&quadrics, share}, seams);
		if (seams.any() && !worthItsSeams(next.coarse.vertexCount, fine->vertexCount)) {
			seams = {};
			continue;
		}
		if (!worthwhile(next.coarse.vertexCount, fine->vertexCount))
			break;
		regular = isRegular;
		if (i == 0 && !regular)
			share = free ? steering.shareAfterFree : steering.share;
		seams.carry(next);
		if (steered)
			quadrics.carry(next, points);
		points = pick(points, next.fineVertex);
		if (!stay.empty())
			stay = pick(stay, next.fineVertex);
		steps.push_back(std::move(next));
		fine = &steps.back().coarse;
		if (!step(1 - double(fine->vertexCount) / double(table.vertexCount)))
			break;
	}
	return steps;
}

Replay replay(std::vector<Coarsening> coarsenings, CornerTable base, std::vector<Index> source)
{
	Replay out;
	out.source = std::move(source);
	out.finest = std::move(base);
	for (; !coarsenings.empty(); coarsenings.pop_back()) {
		ReplayedLevel level;
		level.parent     = std::move(out.finest);
		level.refinement = canonical(level.parent, coarsenings.back(), out.source);
		out.finest       = refine(level.parent, level.refinement);
		out.levels.push_back(std::move(level));
	}
	return out;
}

} // namespace wavemesh
