// SPDX-License-Identifier: GPL-3.0-or-later
#include "multires/coarsen_state.h"

#include <algorithm>
#include <cassert>

namespace wavemesh {

CoarsenState::CoarsenState(const CornerTable& fine) :
        fine_(fine), first_(firstCorners(fine)), valence_(valences(fine)),
        parents_(fine.vertexCount, {kNone, kNone, kNone}), childCount_(fine.vertexCount, 0),
        coarseValence_(valence_.begin(), valence_.end()),
        flip_(fine.vertexCount, {Pattern::Invalid, Pattern::Invalid}),
        edgeHead_(fine.vertexCount, kNone)
{
}

// ---- stars and sides --------------------------------------------------------------------------

Star CoarsenState::star(Index v) const
{
	Star s;
	if (valence_[v] > Star::kMax) {
		s.size = Star::kMax + 1;
		return s;
	}
	const Index begin = first_[v];
	Index c           = begin;
	do {
		s.ring[s.size]     = fine_.vertex[nextCorner(c)];
		s.corner[s.size++] = c;
		const Index left   = fine_.swingLeft(c);
		if (left == kNone) {
			s.boundary         = true;
			s.ring[s.size]     = fine_.vertex[prevCorner(c)];
			s.corner[s.size++] = kNone;
		}
		c = left;
	} while (c != kNone && c != begin);
	return s;
}

int CoarsenState::sides(const Star& star, Index parentA, Index parentB, Side side[2]) const
{
	if (star.size > Star::kMax)
		return 0;
	const int a = star.find(parentA), b = star.find(parentB);
	if (a < 0 || b < 0 || a == b)
		return 0;
	const auto fill = [&](Side& s, int from, int to) {
		s.count = (to - from - 1 + star.size) % star.size;
		if (s.count < 1 || s.count > 2)
			return false;
		s.from = star.ring[from];
		s.to   = star.ring[to];
		for (int i = 0; i <= s.count; ++i) {
			const int at = (from + i) % star.size;
			s.corner[i]  = star.corner[at];
			if (i > 0)
				s.inner[i - 1] = star.ring[at];
		}
		return true;
	};
	if (star.boundary) {
		if (std::min(a, b) != 0 || std::max(a, b) != star.size - 1)
			return 0;
		return fill(side[0], 0, star.size - 1) ? 1 : 0;
	}
	return fill(side[0], a, b) && fill(side[1], b, a) ? 2 : 0;
}

int CoarsenState::sides(Index child, Side side[2]) const
{
	return sides(star(child), parents_[child][0], parents_[child][1], side);
}

// ---- patterns ---------------------------------------------------------------------------------

/// Pattern of a side that needs no flip; Invalid where only a flip may help, or nothing.
Pattern CoarsenState::patternWithoutFlip(const Side& s) const
{
	const Index first = s.inner[0];
	if (s.count == 1) {
		if (!isChild(first))
			return Pattern::Two;
		if (hasParents(first, s.from, across(s.corner[1])))
			return Pattern::ThreeBehindFrom;
		if (hasParents(first, s.to, across(s.corner[0])))
			return Pattern::ThreeBehindTo;
		return Pattern::Invalid;
	}
	const Index last = s.inner[1];
	if (isChild(first) && isChild(last)) {
		const Index apex = across(s.corner[1]);
		const bool four =
		    apex != kNone && hasParents(first, s.from, apex) && hasParents(last, s.to, apex);
		return four ? Pattern::Four : Pattern::Invalid;
	}
	if (isChild(first) && hasParents(first, s.from, last))
		return Pattern::ThreeFrom;
	if (isChild(last) && hasParents(last, s.to, first))
		return Pattern::ThreeTo;
	return Pattern::Invalid;
}

/// May the edge between two children be the flip of two 1:2 faces, seen from the neighbour? Its
/// side that holds `child` must have one more inner vertex, which stays.
bool CoarsenState::flipsWith(Index child, Index neighbour) const
{
	Side side[2];
	const int n = sides(neighbour, side);
	for (int i = 0; i < n; ++i)
		for (int k = 0; k < side[i].count; ++k)
			if (side[i].inner[k] == child)
				return side[i].count == 2 && !isChild(side[i].inner[1 - k]);
	return false;
}

Pattern CoarsenState::pattern(Index child, const Side& side, int sideIndex) const
{
	const Pattern p = patternWithoutFlip(side);
	return p != Pattern::Invalid ? p : flip_[child][std::size_t(sideIndex)];
}

/// Makes sure the side has a pattern, reserving or releasing the edge of a flip.
bool CoarsenState::settleSide(Index child, const Side& s, int sideIndex)
{
	const Pattern held = flip_[child][std::size_t(sideIndex)];
	if (patternWithoutFlip(s) != Pattern::Invalid) {
		if (held != Pattern::Invalid)
			release(child, s, sideIndex);
		return true;
	}
	if (s.count != 2 || (isChild(s.inner[0]) && isChild(s.inner[1])))
		return false;
	for (int i = 0; i < 2; ++i)
		if (isChild(s.inner[i])) {
			const Pattern flip = i == 0 ? Pattern::TwoFlipAtFrom : Pattern::TwoFlipAtTo;
			return flipsWith(child, s.inner[i]) && reserve(child, s, sideIndex, flip);
		}
	if (held != Pattern::Invalid)
		return true;
	// The edge that comes back adds one to the valences at its ends: prefer the lower ones.
	const int atFrom     = coarseValence_[s.from] + coarseValence_[s.inner[1]];
	const int atTo       = coarseValence_[s.to] + coarseValence_[s.inner[0]];
	const Pattern better = atFrom <= atTo ? Pattern::TwoFlipAtFrom : Pattern::TwoFlipAtTo;
	const Pattern other  = atFrom <= atTo ? Pattern::TwoFlipAtTo : Pattern::TwoFlipAtFrom;
	return reserve(child, s, sideIndex, better) || reserve(child, s, sideIndex, other);
}

namespace {

/// Ends of the coarse edge that a flip brings back.
std::array<Index, 2> flippedBack(const Side& s, Pattern flip)
{
	if (flip == Pattern::TwoFlipAtFrom)
		return {s.from, s.inner[1]};
	return {s.to, s.inner[0]};
}

} // namespace

bool CoarsenState::reserve(Index child, const Side& s, int sideIndex, Pattern flip)
{
	Pattern& held = flip_[child][std::size_t(sideIndex)];
	if (held == flip)
		return true;
	const auto edge = flippedBack(s, flip);
	// A neighbour that is a child and flips with us already may hold the edge: then it is shared.
	const Index neighbour = s.inner[flip == Pattern::TwoFlipAtFrom ? 0 : 1];
	bool shared           = false;
	if (isChild(neighbour)) {
		Side other[2];
		const int n = sides(neighbour, other);
		for (int i = 0; i < n; ++i) {
			const Pattern p = flip_[neighbour][std::size_t(i)];
			if (p == Pattern::Invalid)
				continue;
			const auto theirs = flippedBack(other[i], p);
			shared            = shared || (theirs[0] == edge[0] && theirs[1] == edge[1]) ||
			         (theirs[0] == edge[1] && theirs[1] == edge[0]);
		}
	}
	if (!shared && (edgeInFine(edge[0], edge[1]) || edgeInCoarse(edge[0], edge[1])))
		return false;
	if (held != Pattern::Invalid)
		release(child, s, sideIndex);
	undo_.push_back({sideIndex ? Undo::FlipOfSide1 : Undo::FlipOfSide0, held, child, kNone});
	held = flip;
	addEdge(edge[0], edge[1]);
	return true;
}

void CoarsenState::release(Index child, const Side& s, int sideIndex)
{
	Pattern& held   = flip_[child][std::size_t(sideIndex)];
	const auto edge = flippedBack(s, held);
	undo_.push_back({sideIndex ? Undo::FlipOfSide1 : Undo::FlipOfSide0, held, child, kNone});
	held = Pattern::Invalid;
	removeEdge(edge[0], edge[1]);
}

bool CoarsenState::settle(Index child)
{
	Side side[2];
	const int n = sides(child, side);
	for (int i = 0; i < n; ++i)
		if (!settleSide(child, side[i], i))
			return false;
	return n > 0;
}

// ---- transactions -----------------------------------------------------------------------------

bool CoarsenState::propose(const ChildOf& p, Star& s)
{
	if (isChild(p.child) || isParent(p.child) || isChild(p.parentA) || isChild(p.parentB))
		return false;
	s = star(p.child);
	Side side[2];
	const int n = sides(s, p.parentA, p.parentB, side);
	if (n == 0 || edgeInFine(p.parentA, p.parentB) || edgeInCoarse(p.parentA, p.parentB))
		return false;
	parents_[p.child] = {p.parentA, p.parentB, kNone};
	++childCount_[p.parentA];
	++childCount_[p.parentB];
	for (int i = 0; i < s.size; ++i)
		if (s.ring[i] != p.parentA && s.ring[i] != p.parentB)
			--coarseValence_[s.ring[i]];
	undo_.push_back({Undo::Child, Pattern::Invalid, p.child, kNone});
	addEdge(p.parentA, p.parentB);
	// The edge replaces those to the child: the valences of its ends stay.
	--coarseValence_[p.parentA];
	--coarseValence_[p.parentB];
	return true;
}

bool CoarsenState::add(const ChildOf* proposals, int count)
{
	undo_.clear();
	Star stars[2];
	bool fresh[2] = {false, false};
	bool good     = true;
	assert(count <= 2);
	for (int i = 0; i < count && good; ++i) {
		const ChildOf& p = proposals[i];
		if (isChild(p.child)) {
			good = hasParents(p.child, p.parentA, p.parentB);
			continue;
		}
		fresh[i] = propose(p, stars[i]);
		good     = fresh[i];
	}
	for (int i = 0; i < count && good; ++i) {
		if (!fresh[i])
			continue;
		good = settle(proposals[i].child);
		for (int k = 0; k < stars[i].size && good; ++k) {
			const Index v = stars[i].ring[k];
			if (isCentre(v))
				good = false;
			else if (isChild(v))
				good = settle(v);
		}
	}
	if (!good)
		rollBack();
	return good;
}

void CoarsenState::rollBack()
{
	for (; !undo_.empty(); undo_.pop_back()) {
		const Undo& u = undo_.back();
		switch (u.kind) {
		case Undo::EdgeAdded:
			eraseEdge(u.a, u.b);
			break;
		case Undo::EdgeRemoved:
			insertEdge(u.a, u.b);
			break;
		case Undo::FlipOfSide0:
			flip_[u.a][0] = u.oldFlip;
			break;
		case Undo::FlipOfSide1:
			flip_[u.a][1] = u.oldFlip;
			break;
		case Undo::Child: {
			auto& p      = parents_[u.a];
			const Star s = star(u.a);
			for (int i = 0; i < s.size; ++i)
				++coarseValence_[s.ring[i]];
			--childCount_[p[0]];
			--childCount_[p[1]];
			p = {kNone, kNone, kNone};
			break;
		}
		}
	}
}

bool CoarsenState::addCentre(Index v)
{
	if (valence_[v] != 3 || isChild(v) || isParent(v))
		return false;
	const Star s = star(v);
	if (s.boundary || isChild(s.ring[0]) || isChild(s.ring[1]) || isChild(s.ring[2]))
		return false;
	// What is left must not be two faces back to back.
	Index behind[3];
	for (int i = 0; i < 3; ++i)
		behind[i] = across(s.corner[i]);
	if (behind[0] == s.ring[2] && behind[0] != kNone)
		return false;
	if (behind[0] == behind[1] && behind[1] == behind[2] && behind[0] != kNone &&
	    isChild(behind[0]))
		return false;
	parents_[v] = {s.ring[0], s.ring[1], s.ring[2]};
	for (const Index p : parents_[v]) {
		++childCount_[p];
		--coarseValence_[p];
	}
	return true;
}

// ---- edges of M^{j-1} that M^j does not have ----------------------------------------------------

bool CoarsenState::edgeInFine(Index a, Index b) const
{
	if (valence_[a] > valence_[b])
		std::swap(a, b);
	const Index begin = first_[a];
	Index c           = begin;
	do {
		if (fine_.vertex[nextCorner(c)] == b || fine_.vertex[prevCorner(c)] == b)
			return true;
		c = fine_.swingLeft(c);
	} while (c != kNone && c != begin);
	return false;
}

namespace {

/// Edges are listed at their end with the smaller fan, so that lists stay short next to hubs.
void orderEnds(const std::vector<Index>& valence, Index& a, Index& b)
{
	if (valence[a] > valence[b] || (valence[a] == valence[b] && a > b))
		std::swap(a, b);
}

} // namespace

bool CoarsenState::edgeInCoarse(Index a, Index b) const
{
	orderEnds(valence_, a, b);
	for (Index e = edgeHead_[a]; e != kNone; e = edges_[e].next)
		if (edges_[e].to == b)
			return true;
	return false;
}

void CoarsenState::insertEdge(Index a, Index b)
{
	++coarseValence_[a];
	++coarseValence_[b];
	orderEnds(valence_, a, b);
	for (Index e = edgeHead_[a]; e != kNone; e = edges_[e].next)
		if (edges_[e].to == b) {
			++edges_[e].uses;
			--coarseValence_[a]; // shared: one edge, counted once
			--coarseValence_[b];
			return;
		}
	Index e = freeEdge_;
	if (e == kNone) {
		e = Index(edges_.size());
		edges_.emplace_back();
	}
	else
		freeEdge_ = edges_[e].next;
	edges_[e]    = {b, edgeHead_[a], 1};
	edgeHead_[a] = e;
}

void CoarsenState::eraseEdge(Index a, Index b)
{
	orderEnds(valence_, a, b);
	for (Index* e = &edgeHead_[a]; *e != kNone; e = &edges_[*e].next)
		if (edges_[*e].to == b) {
			const Index gone = *e;
			if (--edges_[gone].uses > 0)
				return;
			*e                = edges_[gone].next;
			edges_[gone].next = freeEdge_;
			freeEdge_         = gone;
			--coarseValence_[a];
			--coarseValence_[b];
			return;
		}
	assert(false);
}

void CoarsenState::addEdge(Index a, Index b)
{
	insertEdge(a, b);
	undo_.push_back({Undo::EdgeAdded, Pattern::Invalid, a, b});
}

void CoarsenState::removeEdge(Index a, Index b)
{
	eraseEdge(a, b);
	undo_.push_back({Undo::EdgeRemoved, Pattern::Invalid, a, b});
}

} // namespace wavemesh
