// SPDX-License-Identifier: GPL-3.0-or-later
#include "multires/coarsen_state.h"

#include <algorithm>
#include <cassert>

namespace wavemesh {

CoarsenState::CoarsenState(const CornerTable& fine) :
        fine_(fine), vertex_(fine.vertexCount), stars_(fine.vertexCount)
{
	const std::vector<Index> first = firstCorners(fine);
	for (Index v = 0; v < fine.vertexCount; ++v) {
		stars_[v]                = starAt(fine, first[v]);
		vertex_[v].coarseValence = stars_[v].size;
	}
}

// ---- stars and sides --------------------------------------------------------------------------

Star starAt(const CornerTable& table, Index corner)
{
	Star s;
	s.boundary     = table.opposite[prevCorner(corner)] == kNone;
	const auto add = [&s](Index neighbour, Index inFace) {
		if (s.size < Star::kMax) {
			s.ring[s.size]   = neighbour;
			s.corner[s.size] = inFace;
		}
		++s.size;
	};
	Index last = corner, c = corner;
	do {
		add(table.vertex[nextCorner(c)], c);
		last = c;
		c    = table.swingLeft(c);
	} while (c != kNone && c != corner);
	if (c == kNone)
		add(table.vertex[prevCorner(last)], kNone);
	return s;
}

Side CoarsenState::sideAt(const Star& star, int from, int count)
{
	const auto wrapped = [&](int i) { return i < star.size ? i : i - star.size; };
	Side s;
	s.count     = count;
	s.from      = star.ring[from];
	s.corner[0] = star.corner[from];
	int at      = wrapped(from + 1);
	s.inner[0]  = star.ring[at];
	s.corner[1] = star.corner[at];
	at          = wrapped(at + 1);
	if (count == 2) {
		s.inner[1]  = star.ring[at];
		s.corner[2] = star.corner[at];
		at          = wrapped(at + 1);
	}
	s.to = star.ring[at];
	return s;
}

bool CoarsenState::fits(const Star& star, int a, int b)
{
	if (star.boundary)
		return (star.size == 3 || star.size == 4) && std::min(a, b) == 0 &&
		       std::max(a, b) == star.size - 1;
	const int left = star.between(a, b), right = star.size - 2 - left;
	return left >= 1 && left <= 2 && right >= 1 && right <= 2;
}

Side CoarsenState::side(const Star& star, int a, int b, int sideIndex)
{
	if (star.boundary)
		return sideAt(star, 0, star.size - 2);
	return sideIndex == 0 ? sideAt(star, a, star.between(a, b))
	                      : sideAt(star, b, star.between(b, a));
}

Side CoarsenState::sideWith(Index child, Index neighbour, int& sideIndex) const
{
	const Star& star = stars_[child];
	const int a = vertex_[child].place[0], b = vertex_[child].place[1];
	const int at    = star.find(neighbour);
	const bool left = star.boundary || (a < b ? a < at && at < b : a < at || at < b);
	sideIndex       = left ? 0 : 1;
	return side(star, a, b, sideIndex);
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
	if (isCentre(neighbour))
		return false;
	int index       = 0;
	const Side side = sideWith(neighbour, child, index);
	return side.count == 2 && !isChild(side.inner[side.inner[0] == child ? 1 : 0]);
}

Pattern CoarsenState::pattern(Index child, const Side& side, int sideIndex) const
{
	const Pattern p = patternWithoutFlip(side);
	return p != Pattern::Invalid ? p : vertex_[child].flip[std::size_t(sideIndex)];
}

/// Makes sure the side has a pattern, reserving or releasing the edge of a flip.
bool CoarsenState::settleSide(Index child, const Side& s, int sideIndex)
{
	const Pattern held = vertex_[child].flip[std::size_t(sideIndex)];
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
	const int atFrom     = coarseValence(s.from) + coarseValence(s.inner[1]);
	const int atTo       = coarseValence(s.to) + coarseValence(s.inner[0]);
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
	Pattern& held = vertex_[child].flip[std::size_t(sideIndex)];
	if (held == flip)
		return true;
	const auto edge = flippedBack(s, flip);
	// A neighbour that is a child and flips with us already may hold the edge: then it is shared.
	const Index neighbour = s.inner[flip == Pattern::TwoFlipAtFrom ? 0 : 1];
	bool shared           = false;
	if (isChild(neighbour)) {
		for (int i = 0; i < sideCount(stars_[neighbour]); ++i) {
			const Pattern p = vertex_[neighbour].flip[std::size_t(i)];
			if (p == Pattern::Invalid)
				continue;
			const auto theirs = flippedBack(side(neighbour, i), p);
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
	Pattern& held   = vertex_[child].flip[std::size_t(sideIndex)];
	const auto edge = flippedBack(s, held);
	undo_.push_back({sideIndex ? Undo::FlipOfSide1 : Undo::FlipOfSide0, held, child, kNone});
	held = Pattern::Invalid;
	removeEdge(edge[0], edge[1]);
}

bool CoarsenState::settle(Index child)
{
	for (int i = 0; i < sideCount(stars_[child]); ++i)
		if (!settleSide(child, side(child, i), i))
			return false;
	return true;
}

/// Settles a child after a neighbour became one too: its other side sees no change.
bool CoarsenState::settleSideWith(Index child, Index neighbour)
{
	int sideIndex   = 0;
	const Side side = sideWith(child, neighbour, sideIndex);
	return settleSide(child, side, sideIndex);
}

// ---- transactions -----------------------------------------------------------------------------

bool CoarsenState::propose(const ChildOf& p)
{
	if (!isOpen(p))
		return false;
	const Star& s = stars_[p.child];
	const int a = s.find(p.parentA), b = s.find(p.parentB);
	if (a < 0 || b < 0 || a == b || !fits(s, a, b) || edgeInFine(p.parentA, p.parentB) ||
	    edgeInCoarse(p.parentA, p.parentB))
		return false;
	Vertex& child = vertex_[p.child];
	child.parents = {p.parentA, p.parentB, kNone};
	child.place   = {std::uint8_t(a), std::uint8_t(b)};
	++vertex_[p.parentA].childCount;
	++vertex_[p.parentB].childCount;
	// The new edge replaces those to the child: the valences of its ends stay.
	for (int i = 0; i < s.size; ++i)
		--vertex_[s.ring[i]].coarseValence;
	undo_.push_back({Undo::Child, Pattern::Invalid, p.child, kNone});
	addEdge(p.parentA, p.parentB);
	return true;
}

bool CoarsenState::add(const ChildOf* proposals, int count)
{
	undo_.clear();
	bool fresh[2] = {false, false};
	bool good     = true;
	assert(count <= 2);
	for (int i = 0; i < count && good; ++i) {
		const ChildOf& p = proposals[i];
		if (isChild(p.child)) {
			good = hasParents(p.child, p.parentA, p.parentB);
			continue;
		}
		fresh[i] = propose(p);
		good     = fresh[i];
	}
	for (int i = 0; i < count && good; ++i) {
		if (!fresh[i])
			continue;
		const Index child = proposals[i].child;
		const Index other = proposals[count - 1 - i].child;
		good              = settle(child);
		const Star& s     = stars_[child];
		for (int k = 0; k < s.size && good; ++k) {
			const Index v = s.ring[k];
			if (!isChild(v))
				continue;
			good = v == other ? settle(v) : !isCentre(v) && settleSideWith(v, child);
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
			vertex_[u.a].flip[0] = u.oldFlip;
			break;
		case Undo::FlipOfSide1:
			vertex_[u.a].flip[1] = u.oldFlip;
			break;
		case Undo::Child: {
			auto& p       = vertex_[u.a].parents;
			const Star& s = stars_[u.a];
			for (int i = 0; i < s.size; ++i)
				++vertex_[s.ring[i]].coarseValence;
			--vertex_[p[0]].childCount;
			--vertex_[p[1]].childCount;
			p = {kNone, kNone, kNone};
			break;
		}
		}
	}
}

bool CoarsenState::addCentre(Index v)
{
	if (valence(v) != 3 || isChild(v) || isParent(v))
		return false;
	const Star& s = stars_[v];
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
	vertex_[v].parents = {s.ring[0], s.ring[1], s.ring[2]};
	for (const Index p : vertex_[v].parents) {
		++vertex_[p].childCount;
		--vertex_[p].coarseValence;
	}
	return true;
}

// ---- edges of M^{j-1} that M^j does not have ----------------------------------------------------

bool CoarsenState::edgeInFine(Index a, Index b) const
{
	if (valence(a) > valence(b))
		std::swap(a, b);
	const Star& s = stars_[a];
	if (s.size <= Star::kMax)
		return s.find(b) >= 0;
	const Index begin = s.corner[0];
	Index c           = begin;
	do {
		if (fine_.vertex[nextCorner(c)] == b || fine_.vertex[prevCorner(c)] == b)
			return true;
		c = fine_.swingLeft(c);
	} while (c != kNone && c != begin);
	return false;
}

/// Edges are listed at their end with the smaller fan, so that lists stay short next to hubs.
void CoarsenState::orderEnds(Index& a, Index& b) const
{
	const int atA = valence(a), atB = valence(b);
	if (atA > atB || (atA == atB && a > b))
		std::swap(a, b);
}

bool CoarsenState::edgeInCoarse(Index a, Index b) const
{
	orderEnds(a, b);
	for (Index e = vertex_[a].edges; e != kNone; e = edges_[e].next)
		if (edges_[e].to == b)
			return true;
	return false;
}

void CoarsenState::insertEdge(Index a, Index b)
{
	++vertex_[a].coarseValence;
	++vertex_[b].coarseValence;
	orderEnds(a, b);
	for (Index e = vertex_[a].edges; e != kNone; e = edges_[e].next)
		if (edges_[e].to == b) {
			++edges_[e].uses;
			--vertex_[a].coarseValence; // shared: one edge, counted once
			--vertex_[b].coarseValence;
			return;
		}
	Index e = freeEdge_;
	if (e == kNone) {
		e = Index(edges_.size());
		edges_.emplace_back();
	}
	else
		freeEdge_ = edges_[e].next;
	edges_[e]        = {b, vertex_[a].edges, 1};
	vertex_[a].edges = e;
}

void CoarsenState::eraseEdge(Index a, Index b)
{
	orderEnds(a, b);
	for (Index* e = &vertex_[a].edges; *e != kNone; e = &edges_[*e].next)
		if (edges_[*e].to == b) {
			const Index gone = *e;
			if (--edges_[gone].uses > 0)
				return;
			*e                = edges_[gone].next;
			edges_[gone].next = freeEdge_;
			freeEdge_         = gone;
			--vertex_[a].coarseValence;
			--vertex_[b].coarseValence;
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
