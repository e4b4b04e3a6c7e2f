// SPDX-License-Identifier: GPL-3.0-or-later
// The CAD part: an L-shaped plate with rounded corners, a filleted upper rim, round holes with a
// chamfer, a slot and a hexagon. Flat faces are triangulated from their contours alone, so that
// many triangles are long, as CAD systems export them.
#include "mesh_edit.h"
#include "shapes.h"
#include "shaping.h"

#include <algorithm>
#include <cmath>

namespace wavemesh::samples {

namespace {

using Flat    = std::array<double, 2>;
using Contour = std::vector<Flat>; ///< counter-clockwise
using Ring    = std::vector<std::uint32_t>;

constexpr double kTau = 6.283185307179586;

void addArc(Contour& c, Flat middle, double radius, double from, double to, int segments)
{
	for (int i = 0; i <= segments; ++i) {
		const double a = from + (to - from) * i / segments;
		c.push_back({middle[0] + radius * std::cos(a), middle[1] + radius * std::sin(a)});
	}
}

Contour circle(Flat middle, double radius, int segments, double first = 0)
{
	Contour c;
	for (int i = 0; i < segments; ++i) {
		const double a = first + kTau * i / segments;
		c.push_back({middle[0] + radius * std::cos(a), middle[1] + radius * std::sin(a)});
	}
	return c;
}

Contour slot(Flat a, Flat b, double radius, int segments)
{
	Contour c;
	addArc(c, b, radius, -kTau / 4, kTau / 4, segments);
	addArc(c, a, radius, kTau / 4, 3 * kTau / 4, segments);
	return c;
}

Contour outline()
{
	constexpr int n = 20;
	Contour c;
	addArc(c, {0.6, 0.6}, 0.6, kTau / 2, 3 * kTau / 4, n);
	addArc(c, {7.2, 0.8}, 0.8, -kTau / 4, 0, n);
	addArc(c, {7.6, 2.2}, 0.4, 0, kTau / 4, n);
	// The inner corner of the L turns the other way.
	Contour inner;
	addArc(inner, {3.8, 3.8}, 1.2, kTau / 2, 3 * kTau / 4, 2 * n);
	c.insert(c.end(), inner.rbegin(), inner.rend());
	addArc(c, {1.8, 5.2}, 0.8, 0, kTau / 4, n);
	addArc(c, {0.5, 5.5}, 0.5, kTau / 4, kTau / 2, n);
	return c;
}

/// Every point moved to the left of the way, `by`.
Contour inset(const Contour& c, double by)
{
	Contour out;
	for (std::size_t i = 0; i < c.size(); ++i) {
		const Flat& a  = c[(i + c.size() - 1) % c.size()];
		const Flat& b  = c[(i + 1) % c.size()];
		const double x = b[0] - a[0], y = b[1] - a[1], l = std::sqrt(x * x + y * y);
		out.push_back({c[i][0] - by * y / l, c[i][1] + by * x / l});
	}
	return out;
}

Ring addRing(MeshData& m, const Contour& c, double z)
{
	Ring ring;
	for (const Flat& p : c) {
		ring.push_back(static_cast<std::uint32_t>(m.positions.size()));
		m.positions.push_back({p[0], p[1], z});
	}
	return ring;
}

/// Wall from `lower` up to `upper`, seen from the right of the way.
void addWall(MeshData& m, const Ring& lower, const Ring& upper, bool inside)
{
	for (std::size_t i = 0; i < lower.size(); ++i) {
		const std::size_t j   = (i + 1) % lower.size();
		const std::uint32_t a = lower[i], b = lower[j], c = upper[j], d = upper[i];
		if (inside) {
			m.triangles.push_back({b, a, d});
			m.triangles.push_back({b, d, c});
		}
		else {
			m.triangles.push_back({a, b, c});
			m.triangles.push_back({a, c, d});
		}
	}
}

double area2(const Point& a, const Point& b, const Point& c)
{
	return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Joins the holes to the outer ring by bridges, the one that reaches farthest right first.
Ring bridged(const std::vector<Point>& p, Ring ring, std::vector<Ring> holes)
{
	auto rightmost = [&](auto& r) {
		return std::max_element(
		    r.begin(), r.end(), [&](auto a, auto b) { return p[a][0] < p[b][0]; });
	};
	std::sort(holes.begin(), holes.end(), [&](const Ring& a, const Ring& b) {
		return p[*rightmost(a)][0] > p[*rightmost(b)][0];
	});
	for (Ring& hole : holes) {
		std::rotate(hole.begin(), rightmost(hole), hole.end());
		std::reverse(hole.begin() + 1, hole.end()); // clockwise
		const Point& h = p[hole[0]];
		// The nearest ring vertex that sees h.
		std::size_t best    = ring.size();
		double bestDistance = 1e300;
		for (std::size_t i = 0; i < ring.size(); ++i) {
			const Point& q = p[ring[i]];
			const double d = (q[0] - h[0]) * (q[0] - h[0]) + (q[1] - h[1]) * (q[1] - h[1]);
			if (q[0] <= h[0] || d >= bestDistance)
				continue;
			bool seen = true;
			for (std::size_t k = 0; k < ring.size() && seen; ++k) {
				const Point &a = p[ring[k]], &b = p[ring[(k + 1) % ring.size()]];
				seen =
				    !(area2(h, q, a) * area2(h, q, b) < 0 && area2(a, b, h) * area2(a, b, q) < 0);
			}
			// Of the two copies of a bridge's end, the one whose corner opens towards h.
			const Point &before = p[ring[(i + ring.size() - 1) % ring.size()]],
			            &after  = p[ring[(i + 1) % ring.size()]];
			const bool convex   = area2(before, q, after) > 0;
			const bool left = area2(before, q, h) > 0, right = area2(q, after, h) > 0;
			seen = seen && (convex ? left && right : left || right);
			if (seen) {
				best         = i;
				bestDistance = d;
			}
		}
		const auto at = ring.begin() + static_cast<std::ptrdiff_t>(best);
		Ring detour(hole.begin(), hole.end());
		detour.push_back(hole[0]);
		detour.push_back(*at);
		ring.insert(at + 1, detour.begin(), detour.end());
	}
	return ring;
}

/// Triangles of a flat region, by cutting ears; the largest smallest angle first would be nicer,
/// but flips come afterwards.
void addFlatFace(MeshData& m, const Ring& outer, const std::vector<Ring>& holes, bool up)
{
	const auto& p = m.positions;
	Ring ring     = bridged(p, outer, holes);
	while (ring.size() >= 3) {
		bool cut = false;
		for (std::size_t i = 0; i < ring.size() && !cut; ++i) {
			const std::uint32_t a = ring[(i + ring.size() - 1) % ring.size()], b = ring[i];
			const std::uint32_t c = ring[(i + 1) % ring.size()];
			if (a == c || (ring.size() > 3 && area2(p[a], p[b], p[c]) <= 1e-12))
				continue;
			const bool isEar = std::none_of(ring.begin(), ring.end(), [&](std::uint32_t v) {
				return v != a && v != b && v != c && area2(p[a], p[b], p[v]) >= 0 &&
				       area2(p[b], p[c], p[v]) >= 0 && area2(p[c], p[a], p[v]) >= 0;
			});
			if (!isEar)
				continue;
			m.triangles.push_back(
			    up ? std::array<std::uint32_t, 3> {a, b, c}
			       : std::array<std::uint32_t, 3> {a, c, b});
			ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
			cut = true;
		}
		if (!cut || ring.size() == 2)
			break;
	}
}

} // namespace

MeshData makeBracket()
{
	constexpr double kThickness = 1, kFillet = 0.18, kChamfer = 0.08;
	constexpr int kFilletRings = 6;
	MeshData m;
	const Contour outer              = outline();
	const std::vector<Contour> holes = {
	    circle({1, 1}, 0.45, 64),
	    circle({3.2, 1.2}, 0.7, 96, 0.02),
	    circle({5, 0.9}, 0.3, 48),
	    circle({5, 2}, 0.3, 48, 0.05),
	    circle({1.2, 4.9}, 0.5, 72),
	    circle({6.9, 0.8}, 0.25, 6),
	    slot({1, 2.6}, {1.9, 2.6}, 0.25, 24),
	    circle({6.6, 1.8}, 0.35, 56, 0.03)};

	Ring bottom = addRing(m, outer, 0), ring = bottom;
	std::vector<Ring> bottomHoles, topHoles;
	for (int i = 0; i <= kFilletRings; ++i) {
		const double a  = kTau / 4 * i / kFilletRings;
		const Ring next = addRing(
		    m, inset(outer, kFillet * (1 - std::cos(a))),
		    kThickness - kFillet + kFillet * std::sin(a));
		addWall(m, ring, next, false);
		ring = next;
	}
	for (const Contour& hole : holes) {
		const Ring low  = addRing(m, hole, 0);
		const Ring high = addRing(m, hole, kThickness - kChamfer);
		const Ring top  = addRing(m, inset(hole, -kChamfer), kThickness);
		addWall(m, low, high, true);
		addWall(m, high, top, true);
		bottomHoles.push_back(low);
		topHoles.push_back(top);
	}
	addFlatFace(m, bottom, bottomHoles, false);
	addFlatFace(m, ring, topHoles, true);
	return snapped(withBetterAngles(snapped(m), 20));
}

} // namespace wavemesh::samples
