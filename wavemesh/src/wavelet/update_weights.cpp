// SPDX-License-Identifier: GPL-3.0-or-later
#include "wavelet/lifting.h"

namespace wavemesh {
namespace {

constexpr Index kMaxValence       = 256; ///< a child next to a larger hub does not update
constexpr std::size_t kMaxSupport = 48;  ///< vertices of H, the nearest first
constexpr int kSweeps             = 16;  ///< of Gauss-Seidel

struct Entry
{
	Index vertex;
	std::int64_t value;
};

class Solver
{
public:
	Solver(const CornerTable& parent, const Refinement& r) :
	        parent_(parent), r_(r), first_(firstCorners(parent)), valence_(valences(parent)),
	        weight_(parent.faceCount()), local_(parent.vertexCount, kNone),
	        dense_(parent.vertexCount, 0)
	{
		for (Index f = 0; f < parent.faceCount(); ++f)
			weight_[f] = r.faceCode[f] == kFaceCentre ? 3 : 1 + faceShape(r.childOnEdge, f).splits;
	}

	/// Appends the weights of the child on the edge that corner c faces.
	void solve(Index c, int disc, UpdateWeights& out)
	{
		gatherSupport(c, disc);
		if (!support_.empty()) {
			gatherProducts(c);
			relax();
			for (std::size_t i = 0; i < support_.size(); ++i) {
				out.vertex.push_back(support_[i]);
				out.alpha.push_back(static_cast<std::int32_t>(alpha_[i] >> 1));
			}
		}
		for (const Index v : support_)
			local_[v] = kNone;
	}

private:
	template <class Visit>
	void forRing(Index v, const Visit& visit) const
	{
		const Index begin = first_[v];
		Index c           = begin;
		do {
			visit(c, false);
			const Index left = parent_.swingLeft(c);
			if (left == kNone)
				visit(c, true);
			c = left;
		} while (c != kNone && c != begin);
	}

	/// H: the parents, then ring by ring their neighbours; empty next to a hub.
	void gatherSupport(Index c, int disc)
	{
		support_.clear();
		include(parent_.vertex[nextCorner(c)]);
		include(parent_.vertex[prevCorner(c)]);
		bool hub          = tooLarge(support_[0]) || tooLarge(support_[1]);
		std::size_t begin = 0;
		for (int k = 0; k < disc && !hub; ++k) {
			const std::size_t end = support_.size();
			for (; begin < end && !hub; ++begin)
				forRing(support_[begin], [&](Index at, bool last) {
					const Index v = parent_.vertex[last ? prevCorner(at) : nextCorner(at)];
					hub           = hub || tooLarge(v);
					include(v);
				});
		}
		if (hub) {
			for (const Index v : support_)
				local_[v] = kNone;
			support_.clear();
		}
	}
	bool tooLarge(Index v) const { return valence_[v] > kMaxValence; }
	void include(Index v)
	{
		if (local_[v] != kNone || support_.size() == kMaxSupport)
			return;
		local_[v] = static_cast<Index>(support_.size());
		support_.push_back(v);
	}

	/// Row v of 24 I (I as in the header): neighbours and v itself.
	void gatherRow(Index v, std::vector<Entry>& row) const
	{
		row.clear();
		std::int64_t diagonal = 0;
		forRing(v, [&](Index c, bool last) {
			if (last) { // the far edge of a boundary fan
				row.push_back({parent_.vertex[prevCorner(c)], weight_[c / 3]});
				return;
			}
			const Index right = parent_.opposite[prevCorner(c)];
			row.push_back(
			    {parent_.vertex[nextCorner(c)],
			     std::int64_t(weight_[c / 3]) + (right == kNone ? 0 : weight_[right / 3])});
			diagonal += 2 * weight_[c / 3];
		});
		row.push_back({v, diagonal});
	}

	/// 48 b: the child's fine hat against the hats of its parents and of the far vertices.
	void gatherTargets(Index c, std::vector<Entry>& targets) const
	{
		targets.clear();
		const Index a = parent_.vertex[nextCorner(c)], b = parent_.vertex[prevCorner(c)];
		std::int64_t sumA = 0, sumB = 0;
		const Index d = parent_.opposite[c];
		for (const Index side : {c, d}) {
			if (side == kNone)
				continue;
			const bool turned = side == d;
			const Products p  = productsOfSide(side);
			sumA += turned ? p.prev : p.next;
			sumB += turned ? p.next : p.prev;
			targets.push_back({parent_.vertex[side], p.apex});
		}
		targets.push_back({a, sumA});
		targets.push_back({b, sumB});
	}

	/// Inner products, times 48 over the area of a descendant (1/2), on one face.
	struct Products
	{
		std::int64_t next, prev, apex;
	};
	Products productsOfSide(Index c) const
	{
		const Index face      = c / 3;
		const FaceShape shape = faceShape(r_.childOnEdge, face);
		if (shape.splits == 1)
			return {6, 6, 4};
		if (shape.splits == 3)
			return {10, 10, 4};
		// 1:3. The corner face lies at the vertex both split edges share; the diagonal starts at
		// this child or at the other one.
		const bool diagonal1    = r_.faceCode[face] == kFaceDiagonal1;
		const bool cornerAtPrev = prevCorner(c) == shape.corner; // shared vertex is prev of c
		const bool mine         = cornerAtPrev ? diagonal1 : !diagonal1;
		const Products atNext   = mine ? Products {10, 8, 6} : Products {8, 6, 2};
		return cornerAtPrev ? Products {atNext.prev, atNext.next, atNext.apex} : atNext;
	}

	/// Normal equations: (I^2)[H,H] and (I b)[H].
	void gatherProducts(Index c)
	{
		const std::size_t n = support_.size();
		rows_.resize(std::max(rows_.size(), n));
		gatherTargets(c, targets_);
		normal_.assign(n * n, 0);
		right_.assign(n, 0);
		alpha_.assign(n, 0);
		for (std::size_t i = 0; i < n; ++i)
			gatherRow(support_[i], rows_[i]);
		for (std::size_t i = 0; i < n; ++i) {
			for (const Entry& e : rows_[i])
				dense_[e.vertex] += e.value;
			for (std::size_t j = 0; j <= i; ++j) {
				std::int64_t sum = 0;
				for (const Entry& e : rows_[j])
					sum += e.value * dense_[e.vertex];
				normal_[i * n + j] = normal_[j * n + i] = sum;
			}
			for (const Entry& e : targets_)
				right_[i] += e.value * dense_[e.vertex];
			for (const Entry& e : rows_[i])
				dense_[e.vertex] = 0;
		}
	}

	/// Gauss-Seidel in 1/131072: half of that is the scale of b.
	void relax()
	{
		const std::size_t n = support_.size();
		for (int sweep = 0; sweep < kSweeps; ++sweep)
			for (std::size_t i = 0; i < n; ++i) {
				std::int64_t rest = right_[i] << 16;
				for (std::size_t j = 0; j < n; ++j)
					if (j != i)
						rest -= normal_[i * n + j] * alpha_[j];
				alpha_[i] = rest / normal_[i * n + i];
			}
	}

	const CornerTable& parent_;
	const Refinement& r_;
	std::vector<Index> first_, valence_;
	std::vector<std::int32_t> weight_; ///< #faces: number of descendants
	std::vector<Index> local_;         ///< #V: place in support_, kNone elsewhere
	std::vector<std::int64_t> dense_;  ///< #V: scratch, zero between uses

	std::vector<Index> support_;
	std::vector<std::vector<Entry>> rows_;
	std::vector<Entry> targets_;
	std::vector<std::int64_t> normal_, right_, alpha_;
};

} // namespace

UpdateWeights updateWeights(
    const CornerTable& parent, const Refinement& refinement, const Parents& parents, int disc)
{
	UpdateWeights out;
	if (disc < 0)
		return out;
	Solver solver(parent, refinement);
	out.begin.reserve(parents.size() + 1);
	forEachSplitEdge(parent, refinement.childOnEdge, [&](Index c, Index) {
		out.begin.push_back(static_cast<Index>(out.vertex.size()));
		solver.solve(c, disc, out);
	});
	// Centres update nothing.
	out.begin.resize(parents.size() + 1, static_cast<Index>(out.vertex.size()));
	return out;
}

} // namespace wavemesh
