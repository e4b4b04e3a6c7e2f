// SPDX-License-Identifier: GPL-3.0-or-later
// The vertices and corners of both meshes are parted into cells of those that look alike, at first
// by labels. A cell that was parted parts those around it, and so on (Hopcroft's way: only the
// smaller parts have to be looked at again). Both meshes part alike, or are different. Where a cell
// still has several vertices, one of a is laid on one of b, and that parts on. What is joined only
// through vertices that are alone in their cells is matched part by part, so that a wrong choice
// takes back no more than its own part.
#include "any_isomorphism.h"

#include <algorithm>
#include <numeric>

namespace wavemesh::tool {
namespace {

using Index    = std::uint32_t;
using Triangle = std::array<Index, 3>;

/// One of the meshes. Its nodes: vertices, and behind them the corners, three a face.
struct Side
{
	const LabelledMesh& mesh;
	Index vertices;
	std::vector<Index> order;       ///< #nodes, cell by cell
	std::vector<Index> place, cell; ///< of nodes: in `order`; where their cell begins there
	std::vector<Index> firstCorner, corners; ///< corners by vertices
	std::vector<Index> key, touched;         ///< of nodes, how the cell being looked at sees them

	explicit Side(const LabelledMesh& m) : mesh(m), vertices(Index(m.labels.size()))
	{
		const std::size_t nodes = m.labels.size() + 3 * m.triangles.size();
		order.resize(nodes);
		std::iota(order.begin(), order.end(), Index(0));
		place.resize(nodes);
		cell.resize(nodes);
		key.resize(nodes, 0);
		firstCorner.resize(m.labels.size() + 1, 0);
		for (const Triangle& t : m.triangles)
			for (const Index v : t)
				++firstCorner[v + 1];
		std::partial_sum(firstCorner.begin(), firstCorner.end(), firstCorner.begin());
		corners.resize(3 * m.triangles.size());
		std::vector<Index> at(firstCorner.begin(), firstCorner.end() - 1);
		for (Index c = 0; c < corners.size(); ++c)
			corners[at[m.triangles[c / 3][c % 3]]++] = vertices + c;
	}

	Index vertexOf(Index corner) const
	{
		const Index c = corner - vertices;
		return mesh.triangles[c / 3][c % 3];
	}
	/// Another corner of the face, by 1 or 2.
	Index turned(Index corner, Index by) const
	{
		const Index c = corner - vertices;
		return vertices + c - c % 3 + (c + by) % 3;
	}

	void touch(Index node, Index how)
	{
		if (key[node] == 0)
			touched.push_back(node);
		key[node] += how;
	}
	/// Leaves in `touched`, cell by cell and key by key, what lies at the nodes of a cell.
	void lookAround(Index begin, Index end)
	{
		for (Index i = begin; i < end; ++i) {
			const Index node = order[i];
			if (node < vertices)
				for (Index k = firstCorner[node]; k < firstCorner[node + 1]; ++k)
					touch(corners[k], 1);
			else {
				touch(vertexOf(node), 1);
				touch(turned(node, 1), 1);
				touch(turned(node, 2), 2);
			}
		}
		std::sort(touched.begin(), touched.end(), [&](Index x, Index y) {
			return cell[x] != cell[y] ? cell[x] < cell[y] : key[x] < key[y];
		});
	}
	void forget()
	{
		for (const Index node : touched)
			key[node] = 0;
		touched.clear();
	}

	void put(Index node, Index to)
	{
		const Index other = order[to];
		std::swap(order[place[node]], order[to]);
		place[other] = place[node];
		place[node]  = to;
	}
	void setCell(Index begin, Index end)
	{
		for (Index i = begin; i < end; ++i)
			cell[order[i]] = begin;
	}
};

class Partition
{
public:
	Partition(const LabelledMesh& a, const LabelledMesh& b) :
	        a_(a), b_(b), end_(a_.order.size()), waits_(a_.order.size(), false),
	        seen_(a.labels.size(), 0)
	{
	}

	std::uint64_t steps() const { return steps_; }

	/// False if not as many vertices have each label.
	bool partByLabels()
	{
		const auto sort = [](Side& s) {
			std::sort(s.order.begin(), s.order.begin() + s.vertices, [&](Index x, Index y) {
				return s.mesh.labels[x] < s.mesh.labels[y];
			});
		};
		sort(a_);
		sort(b_);
		const auto label = [](const Side& s, Index i) { return s.mesh.labels[s.order[i]]; };
		for (Index i = 0; i < a_.vertices; ++i)
			if (label(a_, i) != label(b_, i))
				return false;
		cut(0, a_.vertices, [&](Index i) { return label(a_, i) != label(a_, i - 1); });
		return true;
	}

	/// Corners by the cells of the vertices, from their own on, and then all until nothing parts
	/// any more. False if the meshes part in different ways.
	bool partByFaces()
	{
		const auto around = [](const Side& s, Index c) {
			const auto cell = [&](Index corner) { return s.cell[s.vertexOf(corner)]; };
			return Triangle {cell(c), cell(s.turned(c, 1)), cell(s.turned(c, 2))};
		};
		const auto sort = [&](Side& s) {
			std::sort(s.order.begin() + s.vertices, s.order.end(), [&](Index x, Index y) {
				return around(s, x) < around(s, y);
			});
		};
		sort(a_);
		sort(b_);
		const auto nodes = Index(a_.order.size());
		for (Index i = a_.vertices; i < nodes; ++i)
			if (around(a_, a_.order[i]) != around(b_, b_.order[i]))
				return false;
		cut(a_.vertices, nodes,
		    [&](Index i) { return around(a_, a_.order[i]) != around(a_, a_.order[i - 1]); });
		for (Index i = a_.vertices; i < nodes; i = end_[i])
			wait(i);
		return spread();
	}

	/// Lays every vertex of a on one of b; false if there is no way.
	bool matchAll()
	{
		for (Index v = 0; v < a_.vertices; ++v)
			if (!isAlone(v) && !matchPartOf(v))
				return false;
		return true;
	}

	/// Of the vertices of a, in b. @pre matchAll()
	std::vector<Index> map() const
	{
		std::vector<Index> to(a_.vertices);
		for (Index v = 0; v < a_.vertices; ++v)
			to[v] = b_.order[a_.place[v]];
		return to;
	}

private:
	/// Ends and cells of what lies in order[begin..end).
	template <class IsNew>
	void cut(Index begin, Index end, IsNew isNew)
	{
		for (Index i = begin, first = begin; i < end; ++i)
			if (i + 1 == end || isNew(i + 1)) {
				end_[first] = i + 1;
				for (Side* s : {&a_, &b_}) {
					s->setCell(first, i + 1);
					for (Index k = first; k <= i; ++k)
						s->place[s->order[k]] = k;
				}
				first = i + 1;
			}
	}

	bool isAlone(Index v) const { return end_[a_.cell[v]] == a_.cell[v] + 1; }

	void wait(Index cell)
	{
		if (!waits_[cell])
			waiting_.push_back(cell);
		waits_[cell] = true;
	}

	/// Cells part those around them until no more wait. False, and none waits, if the meshes part
	/// in different ways.
	bool spread()
	{
		bool alike = true;
		while (!waiting_.empty()) {
			const Index cell = waiting_.back();
			waiting_.pop_back();
			waits_[cell] = false;
			if (!alike)
				continue;
			a_.lookAround(cell, end_[cell]);
			b_.lookAround(cell, end_[cell]);
			steps_ += a_.touched.size() + b_.touched.size() + end_[cell] - cell;
			alike = touchedAlike();
			if (alike)
				partTouched();
			a_.forget();
			b_.forget();
		}
		return alike;
	}

	bool touchedAlike() const
	{
		return std::equal(
		    a_.touched.begin(), a_.touched.end(), b_.touched.begin(), b_.touched.end(),
		    [&](Index x, Index y) { return a_.cell[x] == b_.cell[y] && a_.key[x] == b_.key[y]; });
	}

	void partTouched()
	{
		const auto& t = a_.touched;
		for (std::size_t i = 0, j = 0; i < t.size(); i = j) {
			while (j < t.size() && a_.cell[t[j]] == a_.cell[t[i]])
				++j;
			const Index cell = a_.cell[t[i]], all = end_[cell] - cell;
			if (j - i < all || a_.key[t[i]] != a_.key[t[j - 1]])
				partCell(cell, i, j);
		}
	}

	/// The touched [i, j) are of this cell: they go to its end, and their keys part them.
	void partCell(Index cell, std::size_t i, std::size_t j)
	{
		const Index end           = end_[cell];
		const auto from           = Index(end - (j - i));
		std::vector<Index> begins = {cell};
		for (std::size_t k = i; k < j; ++k) {
			const auto to = Index(from + (k - i));
			if (to != cell && (k == i || a_.key[a_.touched[k]] != a_.key[a_.touched[k - 1]]))
				begins.push_back(to);
			a_.put(a_.touched[k], to);
			b_.put(b_.touched[k], to);
		}
		begins.push_back(end);
		std::size_t largest = 0;
		for (std::size_t k = begins.size() - 1; k-- > 0;) { // taken back in the other order
			end_[begins[k]] = begins[k + 1];
			if (k > 0)
				begin(begins[k]);
			if (begins[k + 1] - begins[k] > begins[largest + 1] - begins[largest])
				largest = k;
		}
		for (std::size_t k = 0; k + 1 < begins.size(); ++k)
			if (k != largest || waits_[cell])
				wait(begins[k]);
	}

	/// A cell that is new, up to its end.
	void begin(Index cell)
	{
		a_.setCell(cell, end_[cell]);
		b_.setCell(cell, end_[cell]);
		begun_.push_back(cell);
	}
	/// Takes back all but the first so many cells that were begun.
	void undo(std::size_t begun)
	{
		for (; begun_.size() > begun; begun_.pop_back()) {
			const Index cell = begun_.back(), end = end_[cell];
			const Index before = a_.cell[a_.order[cell - 1]];
			steps_ += end - cell;
			for (Index i = cell; i < end; ++i)
				a_.cell[a_.order[i]] = b_.cell[b_.order[i]] = before;
			end_[before] = end;
		}
	}

	/// Lays v, in a cell with others, on w.
	bool lay(Index v, Index w)
	{
		const Index cell = a_.cell[v], last = end_[cell] - 1;
		a_.put(v, last);
		b_.put(w, last);
		end_[cell] = last;
		end_[last] = last + 1;
		begin(last);
		wait(last);
		return spread();
	}

	/// The vertices that faces join to v, not through those that are alone.
	std::vector<Index> partOf(Index v)
	{
		std::vector<Index> part = {v};
		seen_[v]                = ++search_;
		for (std::size_t i = 0; i < part.size(); ++i)
			for (Index k = a_.firstCorner[part[i]]; k < a_.firstCorner[part[i] + 1]; ++k)
				for (const Index by : {1u, 2u}) {
					const Index u = a_.vertexOf(a_.turned(a_.corners[k], by));
					++steps_;
					if (seen_[u] == search_ || isAlone(u))
						continue;
					seen_[u] = search_;
					part.push_back(u);
				}
		return part;
	}

	/// False, and nothing done, if the part of v is nowhere in b.
	bool matchPartOf(Index root)
	{
		const std::vector<Index> part = partOf(root);
		const auto others             = [&](Index v) { return end_[a_.cell[v]] - a_.cell[v]; };
		const Index v                 = *std::min_element(
		                    part.begin(), part.end(), [&](Index x, Index y) { return others(x) < others(y); });
		const std::size_t begun = begun_.size();
		const auto fits         = [&](Index w) {
            if (lay(v, w) && std::all_of(part.begin(), part.end(), [&](Index u) {
                    return isAlone(u) || matchPartOf(u);
                }))
                return true;
            undo(begun);
            return false;
		};
		// Nearly always the first one will do.
		const Index first = b_.order[end_[a_.cell[v]] - 1];
		if (fits(first))
			return true;
		const std::vector<Index> candidates(
		    b_.order.begin() + a_.cell[v], b_.order.begin() + end_[a_.cell[v]]);
		return std::any_of(
		    candidates.begin(), candidates.end(), [&](Index w) { return w != first && fits(w); });
	}

	Side a_, b_;
	std::vector<Index> end_;  ///< of cells, by where they begin: the same in both meshes
	std::vector<bool> waits_; ///< of cells
	std::vector<Index> waiting_, begun_;
	std::vector<Index> seen_; ///< of vertices of a: the last search that came by
	Index search_        = 0;
	std::uint64_t steps_ = 0;
};

/// Faces in b's numbering, turned so that the lowest vertex comes first, in order.
std::vector<Triangle> canonical(std::vector<Triangle> triangles, const std::vector<Index>& to)
{
	for (Triangle& t : triangles) {
		for (Index& v : t)
			v = to[v];
		Triangle best = t;
		for (int turn = 0; turn < 2; ++turn) {
			std::rotate(t.begin(), t.begin() + 1, t.end());
			best = std::min(best, t);
		}
		t = best;
	}
	std::sort(triangles.begin(), triangles.end());
	return triangles;
}

} // namespace

std::string whatDiffersInAnyMesh(const LabelledMesh& a, const LabelledMesh& b, std::uint64_t* steps)
{
	if (a.labels.size() != b.labels.size())
		return "the numbers of vertices differ";
	if (a.triangles.size() != b.triangles.size())
		return "the numbers of faces differ";
	Partition both(a, b);
	if (!both.partByLabels())
		return "the vertices have other positions";
	const bool found = both.partByFaces() && both.matchAll();
	if (steps)
		*steps = both.steps();
	if (!found)
		return "the faces connect other vertices";
	std::vector<Index> same(b.labels.size());
	std::iota(same.begin(), same.end(), Index(0));
	return canonical(a.triangles, both.map()) == canonical(b.triangles, same)
	           ? std::string()
	           : "the faces connect other vertices";
}

} // namespace wavemesh::tool
