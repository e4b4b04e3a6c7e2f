// SPDX-License-Identifier: GPL-3.0-or-later
#include "multires/removal_error.h"

#include <algorithm>
#include <limits>

namespace wavemesh {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// A 4:1 merge may make so many times the error of other removals.
constexpr double kCompleteRelief = 4;

} // namespace

RemovalError::RemovalError(
    const CoarsenState& state,
    const std::vector<LatticePoint>& positions,
    const ErrorCriterion& criterion) :
        state_(state),
        positions_(positions), criterion_(criterion)
{
	if (!active() || positions.empty())
		return;
	std::vector<double> least;
	least.reserve(positions.size());
	for (Index v = 0; v < positions.size(); ++v)
		if (const double e = this->least(v); e < kInfinite)
			least.push_back(e);
	if (least.empty())
		return;
	const auto at = least.begin() + static_cast<std::ptrdiff_t>(
	                                    criterion.share * static_cast<double>(least.size() - 1));
	std::nth_element(least.begin(), at, least.end());
	limit_ = *at;
}

/// Of all pairs of parents that v could have.
double RemovalError::least(Index v) const
{
	double best   = kInfinite;
	const Star& s = state_.star(v);
	if (s.size > Star::kMax)
		return best;
	for (int i = 0; i < s.size; ++i)
		for (int k = i + 2; k < s.size; ++k) {
			if (CoarsenState::fits(s, i, k))
				best = std::min(best, ofPlaces({v, s.ring[i], s.ring[k]}, i, k, best));
		}
	return best;
}

double RemovalError::of(const ChildOf& p, double most) const
{
	const Star& s = state_.star(p.child);
	if (s.size > Star::kMax)
		return kInfinite;
	const int a = s.find(p.parentA), b = s.find(p.parentB);
	return a >= 0 && b >= 0 && CoarsenState::fits(s, a, b) ? ofPlaces(p, a, b, most) : kInfinite;
}

double RemovalError::relative(const ChildOf& p) const
{
	const double e = of(p);
	return e > 0 ? e / limit_ : 0;
}

bool RemovalError::allows(const ChildOf& p, bool complete) const
{
	const double most = complete ? kCompleteRelief * limit_ : limit_;
	return !active() || of(p, most) <= most;
}

bool RemovalError::allowsCentre(Index v) const
{
	if (!active())
		return true;
	const Star& s = state_.star(v);
	Vector3 place {};
	for (int i = 0; i < s.size && i < 3; ++i)
		for (std::size_t k = 0; k < 3; ++k)
			place[k] += (double(positions_[s.ring[i]][k]) - positions_[v][k]) / 3;
	return error(v, place) <= limit_;
}

/// What is added to the error at the vertex itself, which is there already.
double RemovalError::error(Index child, const Vector3& place) const
{
	const Quadric& q = criterion_.quadrics->of(child);
	return std::max(0.0, q.at(place) - q.at({0, 0, 0}));
}

double RemovalError::ofPlaces(const ChildOf& p, int placeA, int placeB, double most) const
{
	Vector3 middle;
	for (std::size_t k = 0; k < 3; ++k)
		middle[k] = 0.5 * (double(positions_[p.parentA][k]) + positions_[p.parentB][k]) -
		            positions_[p.child][k];
	const double e = error(p.child, middle);
	if (e > most)
		return kInfinite;
	const Star& s = state_.star(p.child);
	for (int i = 0; i < CoarsenState::sideCount(s); ++i)
		if (folds(CoarsenState::side(s, placeA, placeB, i)))
			return kInfinite;
	return e;
}

/// Does every way to close the side, without its child, turn a face away from the fine ones?
bool RemovalError::folds(const Side& s) const
{
	const auto normal = [&](Index a, Index b, Index c) {
		return cross(
		    difference(positions_[b], positions_[a]), difference(positions_[c], positions_[a]));
	};
	const CornerTable& fine = state_.fine();
	Vector3 before {};
	for (int i = 0; i <= s.count; ++i) {
		const Index c = s.corner[i];
		const Vector3 n =
		    normal(fine.vertex[c], fine.vertex[nextCorner(c)], fine.vertex[prevCorner(c)]);
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

} // namespace wavemesh
