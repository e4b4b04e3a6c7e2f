// SPDX-License-Identifier: GPL-3.0-or-later
#include "multires/coarsen.h"

#include "multires/coarsen_state.h"
#include "multires/removal_error.h"
#include "multires/seams.h"
#include "multires/sharpness.h"

#include <algorithm>

namespace wavemesh {
namespace {

/// Grows regions of merged faces over the mesh. Sides of new children are served first, in the
/// order of their birth, 4:1 merges before all others; then faces next to what is merged already;
/// then the next seed. Each vertex, side and face is looked at a bounded number of times.
class Search
{
public:
	Search(
	    const CornerTable& fine,
	    const std::vector<LatticePoint>& positions,
	    const GeometricalCriterion& criterion,
	    const std::vector<std::uint8_t>& kept,
	    const ErrorCriterion& errorCriterion,
	    const Seams* seams) :
	        fine_(fine),
	        state_(fine), sharpness_(fine, positions, criterion),
	        error_(state_, positions, errorCriterion), seams_(seams), faceSeen_(fine.faceCount(), 0)
	{
		for (Index v = 0; v < kept.size(); ++v)
			if (kept[v])
				state_.keep(v);
	}

	void run()
	{
		for (const SeedKind kind : {kFewNeighbours, kManyNeighbours, kRegular})
			for (Index v = 0; v < fine_.vertexCount; ++v)
				if (seedKind(v) == kind && !state_.isChild(v))
					seed(v);
		for (Index v = 0; v < fine_.vertexCount; ++v)
			addAlone(v);
	}

	const CoarsenState& state() const { return state_; }

private:
	/// Extraordinary vertices fix the parity of a subdivision, hubs too.
	enum SeedKind { kFewNeighbours, kManyNeighbours, kRegular };
	SeedKind seedKind(Index v) const
	{
		const int valence = state_.valence(v);
		return valence < 6 ? kFewNeighbours : valence > 6 ? kManyNeighbours : kRegular;
	}

	struct Task
	{
		Index child;
		int side;
	};

	/// Do the criteria but that of the error let the vertex go?
	bool allows(const ChildOf& p) const
	{
		return (seams_ == nullptr || seams_->allows(p)) && sharpness_.allows(p);
	}

	/// Two vertices at once complete a 4:1 merge.
	bool add(const ChildOf* proposals, int count)
	{
		for (int i = 0; i < count; ++i)
			if (const ChildOf& p = proposals[i];
			    !state_.isChild(p.child) &&
			    !(state_.isOpen(p) && allows(p) && error_.allows(p, count == 2)))
				return false;
		return addAllowed(proposals, count);
	}

	bool addAllowed(const ChildOf* proposals, int count)
	{
		bool fresh[2] = {false, false};
		for (int i = 0; i < count; ++i)
			fresh[i] = !state_.isChild(proposals[i].child);
		if (!state_.add(proposals, count))
			return false;
		for (int i = 0; i < count; ++i)
			if (fresh[i]) {
				fresh_.push_back({proposals[i].child, 0});
				fresh_.push_back({proposals[i].child, 1});
			}
		return true;
	}

	bool addIf(const ChildOf& p) { return p.parentB != kNone && add(&p, 1); }

	/// Lets the edges around `v` end in children straight behind them, then grows from there.
	void seed(Index v)
	{
		const Index begin = state_.star(v).corner[0]; // a hub's ring is not kept
		Index c           = begin;
		do {
			addOpposite(fine_.vertex[nextCorner(c)], v);
			c = fine_.swingLeft(c);
		} while (c != kNone && c != begin);
		grow();
	}

	/// Makes `child`, of valence 6, the middle between `parent` and the vertex straight behind.
	void addOpposite(Index child, Index parent)
	{
		if (state_.isChild(child) || state_.isParent(child) || state_.isChild(parent))
			return;
		const Star& s = state_.star(child);
		if (s.size != 6 || s.boundary)
			return;
		const int at = s.find(parent);
		const ChildOf p {child, parent, s.ring[(at + 3) % 6]};
		add(&p, 1);
	}

	void grow()
	{
		for (;;) {
			if (nextFresh_ < fresh_.size()) {
				const Task t = fresh_[nextFresh_++];
				if (!mergeFour(t.child, t.side))
					sides_.push_back(t);
			}
			else if (nextSide_ < sides_.size()) {
				const Task t = sides_[nextSide_++];
				growSide(t.child, t.side);
			}
			else if (nextFace_ < faces_.size())
				growFace(faces_[nextFace_++]);
			else
				break;
		}
		fresh_.clear();
		sides_.clear();
		faces_.clear();
		nextFresh_ = nextSide_ = nextFace_ = 0;
	}

	/// 4:1 on one side of a child, if the state allows it.
	bool mergeFour(Index child, int sideIndex)
	{
		if (sideIndex >= CoarsenState::sideCount(state_.star(child)))
			return true;
		const Side s     = state_.side(child, sideIndex);
		const Index apex = s.count == 2 ? state_.across(s.corner[1]) : kNone;
		if (apex == kNone)
			return false;
		const ChildOf four[2] = {{s.inner[0], s.from, apex}, {s.inner[1], apex, s.to}};
		if (!add(four, 2))
			return false;
		seeAround(s);
		return true;
	}

	/// Best pattern that the state still allows on one side of a child.
	void growSide(Index child, int sideIndex)
	{
		const Side s = state_.side(child, sideIndex);
		if (s.count == 2) {
			if (mergeFour(child, sideIndex))
				return;
			const ChildOf from {s.inner[0], s.from, s.inner[1]}, to {s.inner[1], s.to, s.inner[0]};
			const bool fromFirst =
			    state_.coarseValence(s.inner[0]) <= state_.coarseValence(s.inner[1]);
			if (!state_.isChild(s.inner[0]) && !state_.isChild(s.inner[1]))
				(void)(add(fromFirst ? &from : &to, 1) || add(fromFirst ? &to : &from, 1));
		}
		else if (!state_.isChild(s.inner[0])) {
			const Index n = s.inner[0];
			const ChildOf from {n, s.from, state_.across(s.corner[1])};
			const ChildOf to {n, s.to, state_.across(s.corner[0])};
			const bool toFirst = to.parentB != kNone && staysAnyway(to.parentB) &&
			                     !(from.parentB != kNone && staysAnyway(from.parentB));
			if (!addIf(toFirst ? to : from))
				addIf(toFirst ? from : to);
		}
		seeAround(s);
	}

	/// The faces of a side are settled: what lies behind them comes next.
	void seeAround(const Side& s)
	{
		for (int i = 0; i <= s.count; ++i) {
			const Index face = s.corner[i] / 3;
			faceSeen_[face]  = 1;
			for (Index c = 3 * face; c < 3 * face + 3; ++c)
				see(fine_.opposite[c]);
		}
	}

	void see(Index corner)
	{
		if (corner != kNone && !faceSeen_[corner / 3]) {
			faceSeen_[corner / 3] = 1;
			faces_.push_back(corner);
		}
	}

	/// A face behind what is merged; `corner` faces it. The vertex there may start something new.
	void growFace(Index corner)
	{
		if (addBest(fine_.vertex[corner]))
			return;
		see(fine_.opposite[nextCorner(corner)]);
		see(fine_.opposite[prevCorner(corner)]);
	}

	/// A vertex that will not become a child whatever happens: it costs nothing more as a parent.
	bool staysAnyway(Index v) const
	{
		return state_.isParent(v) || state_.valence(v) > Star::kMax || state_.valence(v) < 4;
	}

	/// How welcome a side is: the vertex opposite loses an edge if one lies between; with two,
	/// those that cannot become children themselves end in a flip.
	int sideScore(const Side& side) const
	{
		if (side.count == 1)
			return 2 * (state_.coarseValence(side.inner[0]) - 6);
		int score = 0;
		for (const Index v : side.inner)
			if (!state_.isChild(v) && staysAnyway(v))
				score -= 5;
		return score;
	}

	/// Makes v a child of the pair of neighbours that leaves the smallest error, the best valences
	/// and the fewest flips and parents.
	bool addBest(Index v)
	{
		if (state_.isChild(v) || state_.isParent(v))
			return false;
		const Star& s = state_.star(v);
		if (s.size > Star::kMax)
			return false;
		struct Option
		{
			double score;
			Index a, b;
		} options[5];
		int count = 0;
		for (int i = 0; i < s.size; ++i)
			for (int k = i + 2; k < s.size; ++k) {
				if (!CoarsenState::fits(s, i, k) || state_.isChild(s.ring[i]) ||
				    state_.isChild(s.ring[k]))
					continue;
				const double error = error_.relative({v, s.ring[i], s.ring[k]});
				if (error > 1)
					continue;
				int score = (staysAnyway(s.ring[i]) ? 8 : 0) + (staysAnyway(s.ring[k]) ? 8 : 0);
				for (int m = 0; m < CoarsenState::sideCount(s); ++m)
					score += sideScore(CoarsenState::side(s, i, k, m));
				// At the limit an error weighs as much as bad valences do.
				const double total = score - 20 * error;
				// The best first, and of equals the one found first.
				int at = count++;
				for (; at > 0 && options[at - 1].score < total; --at)
					options[at] = options[at - 1];
				options[at] = {total, s.ring[i], s.ring[k]};
			}
		for (int i = 0; i < count; ++i) {
			const ChildOf p {v, options[i].a, options[i].b};
			if (allows(p) && addAllowed(&p, 1))
				return true;
		}
		return false;
	}

	/// Last resort for what no region reached: any removal that is still possible.
	void addAlone(Index v)
	{
		if (addBest(v))
			grow();
		else if (
		    (!sharpness_.active() || !sharpness_.isSharp(v)) && state_.valence(v) == 3 &&
		    error_.allowsCentre(v) && (seams_ == nullptr || seams_->allowsCentre(v)))
			state_.addCentre(v);
	}

	const CornerTable& fine_;
	CoarsenState state_;
	Sharpness sharpness_;
	RemovalError error_;
	const Seams* seams_;
	std::vector<std::uint8_t> faceSeen_;
	std::vector<Task> fresh_, sides_;
	std::vector<Index> faces_; ///< corners
	std::size_t nextFresh_ = 0, nextSide_ = 0, nextFace_ = 0;
};

/// Writes down the coarse mesh that a state describes.
class Emission
{
public:
	explicit Emission(const CoarsenState& state) :
	        state_(state), fine_(state.fine()), cornerOf_(fine_.cornerCount(), kNone)
	{
	}

	Coarsening run()
	{
		emitPlain();
		for (Index v = 0; v < fine_.vertexCount; ++v) {
			if (state_.isCentre(v))
				emitCentre(v);
			else if (state_.isChild(v))
				emitChild(v);
		}
		out_.coarse.opposite.resize(key_.size());
		for (Index c = 0; c < key_.size(); ++c) {
			const Index across      = fine_.opposite[key_[c]];
			out_.coarse.opposite[c] = across == kNone ? kNone : cornerOf_[across];
		}
		renumber();
		if (!out_.centre.empty())
			out_.centre.resize(out_.faceCode.size(), kNone);
		return std::move(out_);
	}

private:
	/// One corner of a coarse face: its vertex, and of the edge it faces the child and a fine
	/// corner that faces (a half of) that edge from inside the face.
	struct Corner
	{
		Index vertex, child, key;
	};

	void face(const Corner& a, const Corner& b, const Corner& c, FaceCode code)
	{
		for (const Corner* corner : {&a, &b, &c}) {
			cornerOf_[corner->key] = Index(key_.size());
			key_.push_back(corner->key);
			out_.coarse.vertex.push_back(corner->vertex);
			out_.childOnEdge.push_back(corner->child);
		}
		out_.faceCode.push_back(code);
	}

	void emitPlain()
	{
		for (Index c = 0; c < fine_.cornerCount(); c += 3) {
			const Index* v = &fine_.vertex[c];
			if (!state_.isChild(v[0]) && !state_.isChild(v[1]) && !state_.isChild(v[2]))
				face({v[0], kNone, c}, {v[1], kNone, c + 1}, {v[2], kNone, c + 2}, kFaceNone);
		}
	}

	void emitCentre(Index v)
	{
		const Star& s = state_.star(v);
		out_.centre.resize(out_.faceCode.size(), kNone);
		out_.centre.push_back(v);
		face(
		    {s.ring[0], kNone, s.corner[1]}, {s.ring[1], kNone, s.corner[2]},
		    {s.ring[2], kNone, s.corner[0]}, kFaceCentre);
	}

	void emitChild(Index m)
	{
		for (int i = 0; i < CoarsenState::sideCount(state_.star(m)); ++i) {
			const Side side = state_.side(m, i);
			emitSide(m, side, state_.pattern(m, side, i));
		}
	}

	/// The edge of child m is keyed by its half towards the first parent.
	Index keyOfMiddle(Index m, const Side& s) const
	{
		return state_.parents(m)[0] == s.from ? prevCorner(s.corner[0])
		                                      : nextCorner(s.corner[s.count]);
	}
	bool firstParentIs(Index child, Index v) const { return state_.parents(child)[0] == v; }

	void emitSide(Index m, const Side& s, Pattern pattern)
	{
		const Index* c     = s.corner;
		const Index middle = keyOfMiddle(m, s);
		switch (pattern) {
		case Pattern::Two:
			face({s.to, kNone, c[0]}, {s.from, kNone, c[1]}, {s.inner[0], m, middle}, kFaceNone);
			break;
		case Pattern::TwoFlipAtFrom:
			face(
			    {s.to, kNone, prevCorner(c[1])}, {s.from, kNone, c[2]}, {s.inner[1], m, middle},
			    kFaceFlip1);
			if (!state_.isChild(s.inner[0]))
				face(
				    {s.from, kNone, c[1]}, {s.inner[0], kNone, nextCorner(c[0])},
				    {s.inner[1], kNone, c[0]}, kFaceNone);
			break;
		case Pattern::TwoFlipAtTo:
			face(
			    {s.to, kNone, c[0]}, {s.from, kNone, prevCorner(c[2])}, {s.inner[0], m, middle},
			    kFaceFlip2);
			if (!state_.isChild(s.inner[1]))
				face(
				    {s.inner[0], kNone, c[2]}, {s.inner[1], kNone, nextCorner(c[1])},
				    {s.to, kNone, c[1]}, kFaceNone);
			break;
		case Pattern::ThreeFrom:
			face(
			    {s.to, s.inner[0], firstParentIs(s.inner[0], s.from) ? c[0] : c[1]},
			    {s.from, kNone, c[2]}, {s.inner[1], m, middle}, kFaceDiagonal1);
			break;
		case Pattern::ThreeTo:
			face(
			    {s.to, kNone, c[0]},
			    {s.from, s.inner[1], firstParentIs(s.inner[1], s.to) ? c[2] : c[1]},
			    {s.inner[0], m, middle}, kFaceNone);
			break;
		case Pattern::Four: {
			if (m > s.inner[0] || m > s.inner[1])
				break; // written from the child with the lowest number
			const Index apex = fine_.opposite[c[1]];
			face(
			    {s.to, s.inner[0], firstParentIs(s.inner[0], s.from) ? c[0] : nextCorner(apex)},
			    {s.from, s.inner[1], firstParentIs(s.inner[1], s.to) ? c[2] : prevCorner(apex)},
			    {fine_.vertex[apex], m, middle}, kFaceNone);
			break;
		}
		case Pattern::ThreeBehindFrom:
		case Pattern::ThreeBehindTo: // written from the child that the diagonal ends in
		case Pattern::Invalid:
			break;
		}
	}

	void renumber()
	{
		std::vector<Index> coarseOf(fine_.vertexCount, kNone);
		for (Index v = 0; v < fine_.vertexCount; ++v)
			if (!state_.isChild(v)) {
				coarseOf[v] = Index(out_.fineVertex.size());
				out_.fineVertex.push_back(v);
			}
		for (Index& v : out_.coarse.vertex)
			v = coarseOf[v];
		out_.coarse.vertexCount = Index(out_.fineVertex.size());
	}

	const CoarsenState& state_;
	const CornerTable& fine_;
	std::vector<Index> cornerOf_; ///< #fine corners: coarse corner keyed by it
	std::vector<Index> key_;      ///< #coarse corners
	Coarsening out_;
};

} // namespace

Coarsening coarsen(
    const CornerTable& fine,
    const std::vector<LatticePoint>& positions,
    const GeometricalCriterion& criterion,
    const std::vector<std::uint8_t>& kept,
    const ErrorCriterion& errorCriterion,
    const Seams* seams)
{
	Search search(fine, positions, criterion, kept, errorCriterion, seams);
	search.run();
	return Emission(search.state()).run();
}

} // namespace wavemesh
