// SPDX-License-Identifier: GPL-3.0-or-later
#include "multires/removal_error.h"

#include <algorithm>

namespace wavemesh {
namespace {

/// A 4:1 merge may make so many times the error of other removals.
constexpr double kCompleteRelief = 4;
/// Vertices that are enough to judge a level by.
constexpr std::size_t kSample = 1024;

std::size_t strideFor(std::size_t count)
{
	return 1 + count / kSample;
}

} // namespace

// ---- one removal --------------------------------------------------------------------------------

/// What is added to the error at the vertex itself, which is there already.
double Removal::error(Index child, const Vector3& place) const
{
	const Quadric& q = quadrics_->of(child);
	return std::max(0.0, q.at(place) - q.c);
}

double Removal::toMiddle(const ChildOf& p) const
{
	const LatticePoint &a = (*positions_)[p.parentA], &b = (*positions_)[p.parentB],
	                   &child = (*positions_)[p.child];
	Vector3 middle;
	for (std::size_t k = 0; k < 3; ++k)
		middle[k] = 0.5 * (double(a[k]) + b[k]) - child[k];
	return error(p.child, middle);
}

double Removal::between(Index child, const Star& s, int placeA, int placeB, double most) const
{
	const double e = toMiddle({child, s.ring[placeA], s.ring[placeB]});
	if (e > most)
		return kInfinite;
	for (int i = 0; i < CoarsenState::sideCount(s); ++i)
		if (folds(CoarsenState::side(s, placeA, placeB, i)))
			return kInfinite;
	return e;
}

double Removal::least(Index v, const Star& s) const
{
	double best = kInfinite;
	for (int i = 0; i < s.size && s.size <= Star::kMax; ++i)
		for (int k = i + 2; k < s.size; ++k)
			if (CoarsenState::fits(s, i, k))
				best = std::min(best, between(v, s, i, k, best));
	return best;
}

double Removal::toCentre(Index v, const Star& s) const
{
	Vector3 place {};
	for (int i = 0; i < s.size && i < 3; ++i)
		for (std::size_t k = 0; k < 3; ++k)
			place[k] += (double((*positions_)[s.ring[i]][k]) - (*positions_)[v][k]) / 3;
	return error(v, place);
}

/// Does every way to close the side, without its child, turn a face away from the fine ones?
bool Removal::folds(const Side& s) const
{
	const auto normal = [&](Index a, Index b, Index c) {
		return cross(
		    difference((*positions_)[b], (*positions_)[a]),
		    difference((*positions_)[c], (*positions_)[a]));
	};
	Vector3 before {};
	for (int i = 0; i <= s.count; ++i) {
		const Index c = s.corner[i];
		const Vector3 n =
		    normal(fine_->vertex[c], fine_->vertex[nextCorner(c)], fine_->vertex[prevCorner(c)]);
		for (std::size_t k = 0; k < 3; ++k)
			before[k] += n[k];
	}
	// A face without area turns nowhere.
	const auto turns = [&](Index a, Index b, Index c) { return dot(before, normal(a, b, c)) < 0; };
	if (s.count == 1)
		return turns(s.from, s.inner[0], s.to);
	return (turns(s.from, s.inner[0], s.to) || turns(s.to, s.inner[0], s.inner[1])) &&
	       (turns(s.from, s.inner[1], s.to) || turns(s.from, s.inner[0], s.inner[1]));
}

// ---- what a step may remove ---------------------------------------------------------------------

RemovalError::RemovalError(
    const CoarsenState& state,
    const std::vector<LatticePoint>& positions,
    const ErrorCriterion& criterion) :
        state_(state)
{
	if (!criterion.active())
		return;
	removal_.emplace(state.fine(), positions, *criterion.quadrics);
	std::vector<double> least;
	const std::size_t stride = strideFor(positions.size());
	for (std::size_t v = 0; v < positions.size(); v += stride)
		if (const double e = removal_->least(Index(v), state.star(Index(v)));
		    e < Removal::kInfinite)
			least.push_back(e);
	if (least.empty())
		return;
	const auto at = least.begin() + static_cast<std::ptrdiff_t>(
	                                    criterion.share * static_cast<double>(least.size() - 1));
	std::nth_element(least.begin(), at, least.end());
	limit_ = *at;
}

double RemovalError::of(const ChildOf& p, double most) const
{
	const Star& s = state_.star(p.child);
	if (s.size > Star::kMax)
		return Removal::kInfinite;
	const int a = s.find(p.parentA), b = s.find(p.parentB);
	return a >= 0 && b >= 0 && CoarsenState::fits(s, a, b)
	           ? removal_->between(p.child, s, a, b, most)
	           : Removal::kInfinite;
}

double RemovalError::relative(const ChildOf& p) const
{
	const double e = active() ? of(p, limit_) : 0;
	return e > 0 ? e / limit_ : 0;
}

bool RemovalError::allows(const ChildOf& p, bool complete) const
{
	const double most = complete ? kCompleteRelief * limit_ : limit_;
	return !active() || of(p, most) <= most;
}

bool RemovalError::allowsCentre(Index v) const
{
	return !active() || removal_->toCentre(v, state_.star(v)) <= limit_;
}

// ---- what a step did ----------------------------------------------------------------------------

double excessError(
    const CornerTable& fine,
    const std::vector<LatticePoint>& positions,
    const Quadrics& quadrics,
    const Coarsening& step)
{
	std::vector<ChildOf> removed;
	const CornerTable& table = step.coarse;
	forEachSplitEdge(table, step.childOnEdge, [&](Index c, Index child) {
		removed.push_back(
		    {child, step.fineVertex[table.vertex[nextCorner(c)]],
		     step.fineVertex[table.vertex[prevCorner(c)]]});
	});
	const std::vector<Index> first = firstCorners(fine);
	const Removal removal(fine, positions, quadrics);
	double made = 0, least = 0;
	const std::size_t stride = strideFor(removed.size());
	for (std::size_t i = 0; i < removed.size(); i += stride) {
		const ChildOf& p = removed[i];
		if (const double e = removal.least(p.child, starAt(fine, first[p.child]));
		    e < Removal::kInfinite) {
			made += removal.toMiddle(p);
			least += e;
		}
	}
	return made > 0 ? made / least : 1;
}

} // namespace wavemesh
