// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/manifold_cut.h"

#include <algorithm>
#include <deque>

namespace wavemesh {

bool ManifoldCut::anyTurned() const
{
	return std::find(turned.begin(), turned.end(), 1) != turned.end();
}

std::vector<std::uint8_t> ManifoldCut::shared() const
{
	std::vector<std::uint8_t> out(group.size());
	for (std::size_t v = 0; v < out.size(); ++v)
		out[v] = group[v] != kNone;
	return out;
}

std::vector<Index> ManifoldCut::groupsOf(const std::vector<Index>& rows, Index count) const
{
	std::vector<Index> out(count, kNone);
	for (Index v = 0; v < count && !group.empty(); ++v)
		out[v] = group[rows[v]];
	return out;
}

namespace {

std::array<Index, 3> sorted(std::array<Index, 3> t)
{
	std::sort(t.begin(), t.end());
	return t;
}

/// Does the triangle run through its sorted vertices upwards?
bool isEven(const std::array<Index, 3>& t)
{
	return (t[0] < t[1]) + (t[1] < t[2]) + (t[2] < t[0]) == 2;
}

/// Takes out degenerate faces and copies; what is left goes to `kept` with its faces' numbers.
void takeOutFaces(const Triangles& triangles, Triangles& kept, ManifoldCut& cut)
{
	std::vector<Index> order;
	order.reserve(triangles.size());
	for (Index f = 0; f < triangles.size(); ++f) {
		const auto& t = triangles[f];
		if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
			cut.degenerate.push_back(f);
		else
			order.push_back(f);
	}
	std::sort(order.begin(), order.end(), [&](Index a, Index b) {
		const auto ta = sorted(triangles[a]), tb = sorted(triangles[b]);
		return ta != tb ? ta < tb : a < b;
	});
	std::vector<Index> firstOf(triangles.size(), kNone); // of each copy, the face that stays
	for (std::size_t i = 1; i < order.size(); ++i)
		if (sorted(triangles[order[i]]) == sorted(triangles[order[i - 1]]))
			firstOf[order[i]] =
			    firstOf[order[i - 1]] == kNone ? order[i - 1] : firstOf[order[i - 1]];
	std::sort(order.begin(), order.end());

	std::vector<Index> keptAs(triangles.size(), kNone);
	for (const Index f : order)
		if (firstOf[f] == kNone) {
			keptAs[f] = Index(kept.size());
			kept.push_back(triangles[f]);
			cut.face.push_back(f);
		}
	for (const Index f : order)
		if (firstOf[f] != kNone)
			cut.copies.push_back(
			    {f, keptAs[firstOf[f]], isEven(triangles[f]) != isEven(triangles[firstOf[f]])});
	std::stable_sort(
	    cut.copies.begin(), cut.copies.end(),
	    [](const FaceCopy& a, const FaceCopy& b) { return a.of < b.of; });
}

/// Opens the faces `kept` into a manifold: which edges stay closed, which faces are turned over,
/// which corners share a vertex.
class Opening
{
public:
	Opening(const Triangles& kept, Index vertexCount) :
	        kept_(kept), vertexCount_(vertexCount), across_(3 * kept.size(), kNone),
	        turned_(kept.size(), 0)
	{
	}

	void run()
	{
		pairEdges();
		orient();
		splitVertices();
		if (separate())
			splitVertices();
	}

	/// Writes the opened faces into `cut`; `cut.vertex` first lists the vertices of the original.
	Triangles emit(ManifoldCut& cut);

private:
	Index start(Index c) const { return kept_[c / 3][c % 3]; }
	Index end(Index c) const { return kept_[c / 3][nextCorner(c) % 3]; }

	void pairEdges();
	void pairGroup(const Index* edges, std::size_t count);
	void orient();
	void turnOver(const std::vector<Index>& component);
	void splitVertices();
	bool separate();
	bool runsOpposite(Index c, Index d) const;
	Index root(Index c);
	void unlinkFace(Index f);

	const Triangles& kept_;
	Index vertexCount_;
	std::vector<Index> across_; ///< #corners: edges go by the corner they leave (towards next)
	std::vector<std::uint8_t> turned_;
	std::vector<Index> fan_; ///< #corners: forest; corners of one tree share a vertex
};

/// Lists the edges between the same two vertices together, and pairs those that can be closed.
void Opening::pairEdges()
{
	std::vector<Index> begin(std::size_t(vertexCount_) + 1, 0);
	const Index corners = Index(across_.size());
	for (Index c = 0; c < corners; ++c)
		++begin[std::min(start(c), end(c)) + 1];
	for (Index v = 0; v < vertexCount_; ++v)
		begin[v + 1] += begin[v];
	std::vector<Index> at(begin.begin(), begin.end() - 1), edges(corners);
	for (Index c = 0; c < corners; ++c)
		edges[at[std::min(start(c), end(c))]++] = c;
	const auto farEnd = [&](Index c) { return std::max(start(c), end(c)); };
	for (Index v = 0; v < vertexCount_; ++v) {
		Index* const first = edges.data() + begin[v];
		Index* const last  = edges.data() + begin[v + 1];
		std::sort(first, last, [&](Index a, Index b) {
			return farEnd(a) != farEnd(b) ? farEnd(a) < farEnd(b) : a < b;
		});
		for (Index* i = first; i != last;) {
			Index* k = i;
			while (k != last && farEnd(*k) == farEnd(*i))
				++k;
			pairGroup(i, std::size_t(k - i));
			i = k;
		}
	}
}

/// Two faces meet in any orientation; of more, those that are oriented alike, in their order.
void Opening::pairGroup(const Index* edges, std::size_t count)
{
	const auto link = [&](Index a, Index b) {
		across_[a] = b;
		across_[b] = a;
	};
	if (count == 2)
		return link(edges[0], edges[1]);
	for (std::size_t i = 0, k = 0; i < count; ++i) {
		if (start(edges[i]) > end(edges[i]))
			continue;
		while (k < count && start(edges[k]) < end(edges[k]))
			++k;
		if (k == count)
			return;
		link(edges[i], edges[k++]);
	}
}

/// Turns faces over, the fewest of each component as far as a walk that turns late can tell, and
/// opens the edges where that does not help.
void Opening::orient()
{
	std::vector<std::uint8_t> done(kept_.size(), 0);
	std::deque<std::pair<Index, std::uint8_t>> open;
	std::vector<Index> component;
	for (Index seed = 0; seed < kept_.size(); ++seed) {
		if (done[seed])
			continue;
		component.clear();
		open.push_back({seed, std::uint8_t(0)});
		while (!open.empty()) {
			const auto [f, turned] = open.front();
			open.pop_front();
			if (done[f])
				continue;
			done[f]    = 1;
			turned_[f] = turned;
			component.push_back(f);
			for (Index c = 3 * f; c < 3 * f + 3; ++c) {
				const Index d = across_[c];
				if (d == kNone || done[d / 3])
					continue;
				// Faces that fit as they are come first.
				if (start(c) != start(d))
					open.push_front({d / 3, turned});
				else
					open.push_back({d / 3, std::uint8_t(turned ^ 1)});
			}
		}
		turnOver(component);
		for (const Index f : component)
			for (Index c = 3 * f; c < 3 * f + 3; ++c) {
				const Index d = across_[c];
				if (d != kNone && (start(c) == start(d)) != (turned_[f] != turned_[d / 3]))
					across_[c] = across_[d] = kNone;
			}
	}
}

/// The majority stays as it was.
void Opening::turnOver(const std::vector<Index>& component)
{
	std::size_t count = 0;
	for (const Index f : component)
		count += turned_[f];
	if (2 * count > component.size())
		for (const Index f : component)
			turned_[f] ^= 1;
}

Index Opening::root(Index c)
{
	while (fan_[c] != c)
		c = fan_[c] = fan_[fan_[c]];
	return c;
}

/// Corners at the two ends of a closed edge share their vertices, all others have their own.
void Opening::splitVertices()
{
	fan_.resize(across_.size());
	for (Index c = 0; c < fan_.size(); ++c)
		fan_[c] = c;
	for (Index c = 0; c < fan_.size(); ++c) {
		const Index d = across_[c];
		if (d == kNone || d < c)
			continue;
		for (const Index mine : {c, nextCorner(c)})
			for (const Index theirs : {d, nextCorner(d)})
				if (start(mine) == start(theirs)) {
					const Index a = root(mine), b = root(theirs);
					fan_[std::max(a, b)] = std::min(a, b);
				}
	}
}

void Opening::unlinkFace(Index f)
{
	for (Index c = 3 * f; c < 3 * f + 3; ++c)
		if (across_[c] != kNone) {
			across_[across_[c]] = kNone;
			across_[c]          = kNone;
		}
}

bool Opening::runsOpposite(Index c, Index d) const
{
	return (start(c) != start(d)) == (turned_[c / 3] == turned_[d / 3]);
}

/// Two pairs of faces may still lie at one edge, if their fans hang together elsewhere: of these
/// all but one pair lose their neighbours. Splitting vertices makes no new such edge.
bool Opening::separate()
{
	struct Edge
	{
		Index low, high, corner;
		bool operator<(const Edge& o) const
		{
			return low != o.low ? low < o.low : high != o.high ? high < o.high : corner < o.corner;
		}
	};
	std::vector<Edge> edges;
	edges.reserve(across_.size());
	for (Index c = 0; c < across_.size(); ++c) {
		const Index a = root(c), b = root(nextCorner(c));
		edges.push_back({std::min(a, b), std::max(a, b), c});
	}
	std::sort(edges.begin(), edges.end());
	bool changed = false;
	for (auto first = edges.begin(); first != edges.end();) {
		const auto end      = std::find_if(first, edges.end(), [&](const Edge& e) {
            return e.low != first->low || e.high != first->high;
        });
		const Index partner = across_[first->corner];
		// Two that run opposite are one edge again, opened or not.
		const bool closed = end - first == 2 && runsOpposite(first->corner, (first + 1)->corner);
		for (++first; first != end; ++first)
			if (!closed && first->corner != partner) {
				unlinkFace(first->corner / 3);
				changed = true;
			}
	}
	return changed;
}

Triangles Opening::emit(ManifoldCut& cut)
{
	std::vector<Index> firstCopy(vertexCount_, kNone); // its root
	for (Index c = 0; c < fan_.size(); ++c)
		if (firstCopy[start(c)] == kNone)
			firstCopy[start(c)] = root(c);
	std::vector<Index> numberOf(fan_.size(), kNone); // by root
	for (Index v = 0; v < vertexCount_; ++v)
		if (firstCopy[v] != kNone) {
			numberOf[firstCopy[v]] = Index(cut.vertex.size());
			cut.vertex.push_back(v);
		}
	const std::size_t originals = cut.vertex.size();
	for (Index c = 0; c < fan_.size(); ++c)
		if (root(c) == c && numberOf[c] == kNone) {
			numberOf[c] = Index(cut.vertex.size());
			cut.vertex.push_back(start(c));
		}
	if (cut.vertex.size() > originals) {
		cut.group.assign(cut.vertex.size(), kNone);
		for (std::size_t i = originals; i < cut.vertex.size(); ++i) {
			const Index v                     = cut.vertex[i];
			cut.group[i]                      = v;
			cut.group[numberOf[firstCopy[v]]] = v;
		}
	}
	Triangles out(kept_.size());
	for (Index f = 0; f < out.size(); ++f) {
		for (Index k = 0; k < 3; ++k)
			out[f][k] = numberOf[root(3 * f + k)];
		if (turned_[f])
			std::swap(out[f][1], out[f][2]);
	}
	cut.turned = std::move(turned_);
	return out;
}

/// Nothing to cut.
ManifoldCut whole(CornerTable table, std::size_t faces)
{
	ManifoldCut cut;
	cut.vertex.resize(table.vertexCount);
	cut.face.resize(faces);
	cut.turned.assign(faces, 0);
	for (Index v = 0; v < table.vertexCount; ++v)
		cut.vertex[v] = v;
	for (Index f = 0; f < faces; ++f)
		cut.face[f] = f;
	cut.table = std::move(table);
	return cut;
}

} // namespace

Result<ManifoldCut> cutToManifold(const Triangles& triangles, Index vertexCount)
{
	auto table = buildCornerTable(triangles, vertexCount);
	if (table.ok())
		return whole(std::move(*table), triangles.size());
	if (table.status().code != StatusCode::Unsupported)
		return table.status();
	for (std::size_t f = 0; f < triangles.size(); ++f)
		for (const Index v : triangles[f])
			if (v >= vertexCount)
				return Status(
				    StatusCode::InvalidArgument, "face " + std::to_string(f) +
				                                     " refers to vertex " + std::to_string(v) +
				                                     ", which does not exist");
	ManifoldCut cut;
	Triangles kept;
	takeOutFaces(triangles, kept, cut);
	Opening opening(kept, vertexCount);
	opening.run();
	const Triangles opened = opening.emit(cut);
	std::vector<std::uint8_t> used(vertexCount, 0);
	for (const Index v : cut.vertex)
		used[v] = 1;
	for (Index v = 0; v < vertexCount; ++v)
		if (!used[v])
			cut.isolated.push_back(v);
	table = buildCornerTable(opened, Index(cut.vertex.size()));
	if (!table.ok())
		return Status(StatusCode::Internal, "the mesh was not opened: " + table.status().what);
	cut.table = std::move(*table);
	return cut;
}

} // namespace wavemesh
