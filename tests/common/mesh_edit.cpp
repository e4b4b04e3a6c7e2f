// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_edit.h"

#include <algorithm>
#include <utility>

namespace wavemesh::test {

MeshEdit::MeshEdit(MeshData mesh) : mesh_(std::move(mesh))
{
	twin_.assign(mesh_.triangles.size() * 3, kNone);
	out_.assign(mesh_.positions.size(), kNone);
	struct Edge
	{
		std::uint64_t key;
		std::uint32_t h;
	};
	std::vector<Edge> edges;
	edges.reserve(twin_.size());
	for (std::uint32_t h = 0; h < halfEdges(); ++h) {
		const std::uint64_t a = from(h), b = to(h);
		edges.push_back({std::min(a, b) << 32 | std::max(a, b), h});
		out_[a] = h;
	}
	std::sort(edges.begin(), edges.end(), [](const Edge& x, const Edge& y) {
		return x.key != y.key ? x.key < y.key : x.h < y.h;
	});
	for (std::size_t i = 1; i < edges.size(); ++i)
		if (edges[i].key == edges[i - 1].key)
			link(edges[i].h, edges[i - 1].h);
}

void MeshEdit::link(std::uint32_t h, std::uint32_t g)
{
	if (h != kNone)
		twin_[h] = g;
	if (g != kNone)
		twin_[g] = h;
}

void MeshEdit::setFace(std::uint32_t f, std::uint32_t a, std::uint32_t b, std::uint32_t c)
{
	mesh_.triangles[f] = {a, b, c};
	out_[a]            = 3 * f;
	out_[b]            = 3 * f + 1;
	out_[c]            = 3 * f + 2;
}

std::vector<std::uint32_t> MeshEdit::ring(std::uint32_t v) const
{
	std::vector<std::uint32_t> ring;
	const std::uint32_t start = out_[v];
	if (start == kNone)
		return ring;
	// Turn one way until round; where a boundary stops that, turn the other way from the start.
	std::uint32_t h = start;
	do {
		ring.push_back(to(h));
		const std::uint32_t in = prevOf(h);
		if (twin_[in] == kNone) {
			ring.push_back(from(in));
			for (h = twin_[start]; h != kNone; h = twin_[nextOf(h)])
				ring.push_back(to(nextOf(h)));
			return ring;
		}
		h = twin_[in];
	} while (h != start);
	return ring;
}

bool MeshEdit::joined(std::uint32_t a, std::uint32_t b) const
{
	const auto r = ring(a);
	return std::find(r.begin(), r.end(), b) != r.end();
}

bool MeshEdit::onBoundary(std::uint32_t v) const
{
	std::uint32_t h = out_[v];
	do {
		h = twin_[prevOf(h)];
		if (h == kNone)
			return true;
	} while (h != out_[v]);
	return false;
}

bool MeshEdit::flip(std::uint32_t h)
{
	if (removed(h / 3) || twin_[h] == kNone)
		return false;
	//        c                c
	//      / f \            / | \        .
	//     a --> b    ->    a  |  b
	//      \ g /            \ | /
	//        d                d
	const std::uint32_t g = twin_[h];
	const std::uint32_t a = from(h), b = to(h), c = from(prevOf(h)), d = from(prevOf(g));
	if (c == d || joined(c, d))
		return false;
	const std::uint32_t bc = twin_[nextOf(h)], ca = twin_[prevOf(h)];
	const std::uint32_t ad = twin_[nextOf(g)], db = twin_[prevOf(g)];
	const std::uint32_t f = h / 3, e = g / 3;
	setFace(f, a, d, c);
	setFace(e, d, b, c);
	link(3 * f, ad);
	link(3 * f + 2, ca);
	link(3 * e, db);
	link(3 * e + 1, bc);
	link(3 * f + 1, 3 * e + 2);
	return true;
}

std::uint32_t MeshEdit::insert(std::uint32_t f, const std::array<double, 3>& position)
{
	const auto [a, b, c]   = mesh_.triangles[f];
	const auto v           = static_cast<std::uint32_t>(mesh_.positions.size());
	const auto f1          = static_cast<std::uint32_t>(mesh_.triangles.size());
	const auto f2          = f1 + 1;
	const std::uint32_t bc = twin_[3 * f + 1], ca = twin_[3 * f + 2];
	mesh_.positions.push_back(position);
	mesh_.triangles.resize(f1 + 2);
	twin_.resize(twin_.size() + 6, kNone);
	out_.push_back(kNone);
	setFace(f, a, b, v);
	setFace(f1, b, c, v);
	setFace(f2, c, a, v);
	twin_[3 * f1] = twin_[3 * f2] = kNone;
	link(3 * f1, bc);
	link(3 * f2, ca);
	link(3 * f + 1, 3 * f1 + 2);
	link(3 * f1 + 1, 3 * f2 + 2);
	link(3 * f2 + 1, 3 * f + 2);
	return v;
}

bool MeshEdit::collapse(std::uint32_t h)
{
	if (removed(h / 3) || twin_[h] == kNone)
		return false;
	const std::uint32_t g = twin_[h];
	const std::uint32_t a = from(h), b = to(h), c = from(prevOf(h)), d = from(prevOf(g));
	for (std::uint32_t v : {a, b, c, d})
		if (onBoundary(v))
			return false;
	const auto ra = ring(a), rb = ring(b);
	std::uint32_t shared = 0;
	for (std::uint32_t v : ra)
		shared += std::find(rb.begin(), rb.end(), v) != rb.end();
	// Only c and d may be joined to both ends, and a closed surface needs four vertices.
	if (shared != 2 || ra.size() + rb.size() < 8 || ring(c).size() < 4 || ring(d).size() < 4)
		return false;
	std::vector<std::uint32_t> corners;
	std::uint32_t k = g;
	do { // half-edges that leave b
		corners.push_back(k);
		k = twin_[prevOf(k)];
	} while (k != g);
	for (std::uint32_t corner : corners)
		mesh_.triangles[corner / 3][corner % 3] = a;
	const std::uint32_t bc = twin_[nextOf(h)], ca = twin_[prevOf(h)];
	const std::uint32_t ad = twin_[nextOf(g)], db = twin_[prevOf(g)];
	link(bc, ca);
	link(ad, db);
	for (std::uint32_t f : {h / 3, g / 3})
		mesh_.triangles[f] = {kNone, kNone, kNone};
	out_[a] = ca;
	out_[b] = kNone;
	out_[c] = bc;
	out_[d] = ad;
	return true;
}

namespace {

/// Is d inside the circle through a, b, c (counter-clockwise), in the x-y plane?
bool insideCircle(
    const std::array<double, 3>& a,
    const std::array<double, 3>& b,
    const std::array<double, 3>& c,
    const std::array<double, 3>& d)
{
	const double ax = a[0] - d[0], ay = a[1] - d[1];
	const double bx = b[0] - d[0], by = b[1] - d[1];
	const double cx = c[0] - d[0], cy = c[1] - d[1];
	const double a2 = ax * ax + ay * ay, b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
	const double det =
	    a2 * (bx * cy - by * cx) - b2 * (ax * cy - ay * cx) + c2 * (ax * by - ay * bx);
	return det > 1e-12; // a margin, so that four points on a circle do not flip for ever
}

} // namespace

void MeshEdit::makeDelaunay()
{
	std::vector<std::uint32_t> todo;
	for (std::uint32_t h = halfEdges(); h-- > 0;)
		todo.push_back(h);
	const auto& p = mesh_.positions;
	while (!todo.empty()) {
		const std::uint32_t h = todo.back();
		todo.pop_back();
		const std::uint32_t g = twin_[h];
		if (g == kNone)
			continue;
		const std::uint32_t c = from(prevOf(h)), d = from(prevOf(g));
		if (!insideCircle(p[from(h)], p[to(h)], p[c], p[d]) || !flip(h))
			continue;
		const std::uint32_t f = h / 3, e = g / 3;
		for (std::uint32_t side : {3 * f, 3 * f + 2, 3 * e, 3 * e + 1})
			todo.push_back(side);
	}
}

MeshData MeshEdit::result() const
{
	MeshData out;
	std::vector<std::uint32_t> row(mesh_.positions.size(), kNone);
	for (std::size_t v = 0; v < row.size(); ++v) {
		if (out_[v] == kNone)
			continue;
		row[v] = static_cast<std::uint32_t>(out.positions.size());
		out.positions.push_back(mesh_.positions[v]);
	}
	for (const auto& t : mesh_.triangles)
		if (t[0] != kNone)
			out.triangles.push_back({row[t[0]], row[t[1]], row[t[2]]});
	return out;
}

MeshData flipRandomEdges(const MeshData& mesh, std::uint32_t count, Rng& rng)
{
	MeshEdit edit(mesh);
	for (std::uint32_t i = 0; i < count; ++i)
		edit.flip(rng.below(edit.halfEdges()));
	return edit.result();
}

MeshData collapseRandomEdges(const MeshData& mesh, std::uint32_t count, Rng& rng)
{
	MeshEdit edit(mesh);
	for (std::uint32_t i = 0; i < count; ++i)
		edit.collapse(rng.below(edit.halfEdges()));
	return edit.result();
}

} // namespace wavemesh::test
