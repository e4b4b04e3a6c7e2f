// SPDX-License-Identifier: GPL-3.0-or-later
#include "closest_point.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wavemesh::metrics {

namespace {

constexpr std::uint32_t kLeafFaces = 4;

Vec3 minus(const Vec3& a, const Vec3& b)
{
	return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double dot(const Vec3& a, const Vec3& b)
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double toSegment(const Vec3& p, const Vec3& a, const Vec3& b)
{
	const Vec3 ab = minus(b, a), ap = minus(p, a);
	const double length = dot(ab, ab);
	const double t      = length > 0 ? std::clamp(dot(ap, ab) / length, 0.0, 1.0) : 0;
	const Vec3 d        = {ap[0] - t * ab[0], ap[1] - t * ab[1], ap[2] - t * ab[2]};
	return dot(d, d);
}

double toBox(const Vec3& p, const Vec3& low, const Vec3& high)
{
	double sum = 0;
	for (std::size_t k = 0; k < 3; ++k) {
		const double d = std::max({low[k] - p[k], p[k] - high[k], 0.0});
		sum += d * d;
	}
	return sum;
}

} // namespace

double squaredDistance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c)
{
	// Inside the prism over the triangle the plane is nearest, elsewhere an edge.
	const Vec3 ab = minus(b, a), ac = minus(c, a), ap = minus(p, a);
	const Vec3 n = {
	    ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2],
	    ab[0] * ac[1] - ab[1] * ac[0]};
	const double area = dot(n, n);
	if (area > 0) {
		auto side = [&](const Vec3& from, const Vec3& along) {
			const Vec3 q = minus(p, from);
			return n[0] * (along[1] * q[2] - along[2] * q[1]) +
			       n[1] * (along[2] * q[0] - along[0] * q[2]) +
			       n[2] * (along[0] * q[1] - along[1] * q[0]);
		};
		if (side(a, ab) >= 0 && side(b, minus(c, b)) >= 0 && side(c, minus(a, c)) >= 0) {
			const double h = dot(ap, n);
			return h * h / area;
		}
	}
	return std::min({toSegment(p, a, b), toSegment(p, b, c), toSegment(p, c, a)});
}

ClosestPoint::ClosestPoint(const MeshData& mesh) : mesh_(mesh), faces_(mesh.triangles.size())
{
	std::iota(faces_.begin(), faces_.end(), 0u);
	std::vector<Vec3> middles;
	middles.reserve(faces_.size());
	for (const auto& t : mesh.triangles) {
		Vec3 m {};
		for (std::uint32_t v : t)
			for (std::size_t k = 0; k < 3; ++k)
				m[k] += mesh.positions[v][k];
		middles.push_back(m);
	}
	Node root;
	root.count = static_cast<std::uint32_t>(faces_.size());
	nodes_.push_back(root);
	for (std::uint32_t i = 0; i < nodes_.size(); ++i) // grows
		split(i, middles);
}

void ClosestPoint::bound(Node& node) const
{
	node.low  = {1e300, 1e300, 1e300};
	node.high = {-1e300, -1e300, -1e300};
	for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
		for (std::uint32_t v : mesh_.triangles[faces_[i]])
			for (std::size_t k = 0; k < 3; ++k) {
				node.low[k]  = std::min(node.low[k], mesh_.positions[v][k]);
				node.high[k] = std::max(node.high[k], mesh_.positions[v][k]);
			}
}

void ClosestPoint::split(std::uint32_t index, std::vector<Vec3>& middles)
{
	bound(nodes_[index]);
	const Node node = nodes_[index];
	if (node.count <= kLeafFaces)
		return;
	std::size_t axis = 0;
	for (std::size_t k = 1; k < 3; ++k)
		if (node.high[k] - node.low[k] > node.high[axis] - node.low[axis])
			axis = k;
	const auto begin = faces_.begin() + node.first;
	const auto half  = node.count / 2;
	std::nth_element(begin, begin + half, begin + node.count, [&](auto a, auto b) {
		return middles[a][axis] != middles[b][axis] ? middles[a][axis] < middles[b][axis] : a < b;
	});
	Node left, right;
	left.first          = node.first;
	left.count          = half;
	right.first         = node.first + half;
	right.count         = node.count - half;
	nodes_[index].first = static_cast<std::uint32_t>(nodes_.size());
	nodes_[index].count = 0;
	nodes_.push_back(left);
	nodes_.push_back(right);
}

double ClosestPoint::toFace(const Vec3& p, std::uint32_t f) const
{
	const auto& t = mesh_.triangles[f];
	return squaredDistance(p, mesh_.positions[t[0]], mesh_.positions[t[1]], mesh_.positions[t[2]]);
}

double ClosestPoint::distance(const Vec3& p) const
{
	struct Open
	{
		std::uint32_t node;
		double distance;
	};
	Open stack[64]; // halving leaves a depth of at most 32, with one sibling waiting at each
	int n       = 0;
	double best = toFace(p, last_);
	stack[n++]  = {0, 0};
	while (n > 0) {
		const Open open = stack[--n];
		if (open.distance >= best)
			continue;
		const Node& node = nodes_[open.node];
		for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
			if (const double d = toFace(p, faces_[i]); d < best) {
				best  = d;
				last_ = faces_[i];
			}
		if (node.count > 0)
			continue;
		const Node &left = nodes_[node.first], &right = nodes_[node.first + 1];
		Open near {node.first, toBox(p, left.low, left.high)};
		Open far {node.first + 1, toBox(p, right.low, right.high)};
		if (far.distance < near.distance)
			std::swap(near, far);
		stack[n++] = far;
		stack[n++] = near;
	}
	return std::sqrt(best);
}

} // namespace wavemesh::metrics
