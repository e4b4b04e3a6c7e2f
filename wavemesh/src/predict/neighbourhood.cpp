// SPDX-License-Identifier: GPL-3.0-or-later
#include "predict/neighbourhood.h"

#include "multires/vertex_walk.h"

namespace wavemesh {
namespace {

/// x / n, rounded; 0 for n = 0. |x| < 2^40
Vector mean(const Vector& sum, std::size_t n)
{
	Vector out {0, 0, 0};
	if (n == 0)
		return out;
	for (std::size_t k = 0; k < 3; ++k)
		out[k] = (sum[k] * kInverses.of[n] + 32768) >> 16;
	return out;
}

} // namespace

Neighbourhood::Neighbourhood(
    const CornerTable& table, const Glue& glue, const std::vector<VertexRecord>& records) :
        table_(table),
        glue_(glue), records_(records), first_(firstCorners(table)), rank_(table.vertexCount)
{
}

std::vector<Index> Neighbourhood::beginChildren(
    const CornerTable& parent,
    const Refinement& refinement,
    const Parents& parents,
    const std::vector<LatticePoint>& cells)
{
	births_   = true;
	parent_   = &parent;
	parents_  = &parents;
	firstNew_ = parent.vertexCount;
	edgeCorner_.assign(parents.size(), kNone);
	forEachSplitEdge(parent, refinement.childOnEdge, [this](Index c, Index child) {
		edgeCorner_[child - firstNew_] = c;
	});
	likely_     = likelyPositions(parent, {cells.begin(), cells.begin() + firstNew_}, 0, glue_);
	normals_    = vertexNormals(parent, likely_);
	laplacians_ = laplacians(parent, likely_);
	likely_.resize(table_.vertexCount);

	std::vector<Index> walk;
	for (const Index v : vertexWalk(table_)) {
		if (v < firstNew_) {
			rank_[v] = v;
			continue;
		}
		rank_[v] = firstNew_ + Index(walk.size());
		walk.push_back(v);
	}
	return walk;
}

std::vector<Index> Neighbourhood::beginBits(const std::vector<LatticePoint>& cells, int bits)
{
	births_     = false;
	firstNew_   = 0;
	likely_     = likelyPositions(table_, cells, bits, glue_);
	normals_    = vertexNormals(table_, likely_);
	laplacians_ = laplacians(table_, likely_);

	std::vector<Index> walk = vertexWalk(table_);
	for (Index i = 0; i < walk.size(); ++i)
		rank_[walk[i]] = i;
	return walk;
}

void Neighbourhood::findRing(Index v, VertexView& view) const
{
	const Index begin = first_[v];
	Index c           = begin;
	do {
		view.ring[view.size]     = table_.vertex[nextCorner(c)];
		view.corner[view.size++] = c;
		const Index left         = table_.swingLeft(c);
		if (left == kNone) {
			view.ring[view.size]     = table_.vertex[prevCorner(c)];
			view.corner[view.size++] = kNone;
		}
		c = left;
	} while (c != kNone && c != begin && view.size < kMostNeighbours);
}

void Neighbourhood::look(Index v, VertexView& view) const
{
	findRing(v, view);
	const std::array<Index, 3>* parents = nullptr;
	if (births_) {
		parents          = &(*parents_)[v - firstNew_];
		view.firstParent = (*parents)[0];
		view.origin      = middleOfParents(*parents);
		view.length      = oneNorm(at((*parents)[0]) - at((*parents)[1])) + 16;
	}
	else
		view.origin = at(v);

	Vector ring {0, 0, 0}, knownRing = ring, bent = ring, all = ring, knownAll = ring, first = ring,
	                       similar = ring;
	std::size_t ringCount = 0, bentCount = 0, allCount = 0, similarCount = 0;
	std::int64_t length = 0;
	for (std::size_t i = 0; i < view.size; ++i) {
		const Index u      = view.ring[i];
		const bool isKnown = known(u);
		if (isKnown || !births_) {
			const Vector p = fromOrigin(view, u);
			ring += p;
			++ringCount;
			if (!births_) {
				length += oneNorm(p);
				bent += p - Vector {laplacians_[u][0], laplacians_[u][1], laplacians_[u][2]};
				++bentCount;
			}
			if (isKnown) {
				const VertexRecord& record = records_[u];
				knownRing += p;
				++view.known;
				view.repeated += record.repeated;
				if (view.firstKnown == kNone)
					view.firstKnown = u;
				if (!births_ || (u != (*parents)[0] && u != (*parents)[1]))
					view.lastKnown = u;
				if (u >= firstNew_) {
					similar += Vector {record.offset[0], record.offset[1], record.offset[2]};
					++similarCount;
				}
			}
		}
		addParallelogram(v, view, i, all, allCount, knownAll, first);
	}
	if (!births_)
		view.length = length / static_cast<std::int64_t>(view.size) + 16;
	view.lengthBits = bitLength(static_cast<std::uint64_t>(view.length));

	ring      = mean(ring, ringCount);
	knownRing = mean(knownRing, view.known);
	bent      = mean(bent, bentCount);
	all       = mean(all, allCount);
	knownAll  = mean(knownAll, view.parallelograms);
	similar   = mean(similar, similarCount);

	std::array<Vector, kOffsetFeatures> features;
	auto& p = view.predicted;
	if (births_) {
		Vector far {0, 0, 0}, wings = far, bend = far;
		lookAtParents(v, view, *parents, far, wings, bend);
		Vector butterfly;
		for (std::size_t k = 0; k < 3; ++k)
			butterfly[k] = (far[k] - wings[k]) >> 2;
		features           = {knownRing, knownAll, first, similar, bend, far, wings};
		view.middle        = {0, 0, 0};
		p[kSmooth]         = butterfly;
		p[kParallelograms] = view.parallelograms ? knownAll : butterfly;
		p[kRing]           = knownRing;
		for (std::size_t k = 0; k < 3; ++k)
			p[kBetween][k] = knownAll[k] >> 1;
		p[kSimilar]       = similarCount ? similar : butterfly;
		p[kParallelogram] = view.parallelograms ? first : butterfly;
		view.leastSquaresClass =
		    (*parents)[2] != kNone ? 0 : std::min<std::size_t>(view.parallelograms, 3);
	}
	else {
		const Vector own {laplacians_[v][0], laplacians_[v][1], laplacians_[v][2]};
		if (!view.parallelograms)
			knownAll = first = all;
		features           = {ring, all, bent, knownAll, similar, first, own - ring};
		view.middle        = ring;
		view.normal        = normals_[v];
		p[kSmooth]         = all;
		p[kParallelograms] = knownAll;
		p[kRing]           = view.known ? knownRing : ring;
		for (std::size_t k = 0; k < 3; ++k)
			p[kBetween][k] = (4 * ring[k] - all[k]) / 3;
		p[kSimilar]            = bent;
		p[kParallelogram]      = first;
		view.leastSquaresClass = std::min<std::size_t>(view.parallelograms, 3);
	}
	describe(view, features, parents);
}

void Neighbourhood::addParallelogram(
    Index v,
    VertexView& view,
    std::size_t i,
    Vector& all,
    std::size_t& allCount,
    Vector& knownAll,
    Vector& first) const
{
	const Index c = view.corner[i];
	const Index o = c == kNone ? kNone : table_.opposite[c];
	if (o == kNone)
		return;
	const Index a = table_.vertex[nextCorner(c)], b = table_.vertex[prevCorner(c)];
	const Index behind = table_.vertex[o];
	if (behind == v)
		return;
	const bool isKnown = known(a) && known(b) && known(behind);
	if (!isKnown && births_)
		return;
	const Vector p = at(a) + at(b) - at(behind) - view.origin;
	all += p;
	++allCount;
	if (isKnown) {
		if (view.parallelograms++ == 0)
			first = p;
		knownAll += p;
	}
}

Vector Neighbourhood::middleOfParents(const std::array<Index, 3>& parents) const
{
	Vector sum = at(parents[0]) + at(parents[1]);
	if (parents[2] == kNone)
		return {sum[0] / 2, sum[1] / 2, sum[2] / 2};
	sum += at(parents[2]);
	return {sum[0] / 3, sum[1] / 3, sum[2] / 3};
}

/// The edge of a child in the parent level: the vertices across, those beyond, how it bends.
void Neighbourhood::lookAtParents(
    Index v,
    VertexView& view,
    const std::array<Index, 3>& parents,
    Vector& far,
    Vector& wings,
    Vector& bend) const
{
	const Vector a = at(parents[0]), b = at(parents[1]);
	for (std::size_t k = 0; k < 3; ++k)
		bend[k] = (std::int64_t(laplacians_[parents[0]][k]) + laplacians_[parents[1]][k]) >> 1;
	const Index c = edgeCorner_[v - firstNew_];
	view.normal   = {0, 0, 0};
	if (c == kNone)
		return;
	const Index d  = parent_->opposite[c];
	const Vector l = at(parent_->vertex[c]);
	Vector normal  = clampedCross(b - a, l - a);
	if (d != kNone) {
		const Vector o = at(parent_->vertex[d]);
		normal += clampedCross(o - a, b - a);
		Vector sum {0, 0, 0};
		for (const Index edge : {nextCorner(c), prevCorner(c), nextCorner(d), prevCorner(d)})
			sum += beyond(edge);
		for (std::size_t k = 0; k < 3; ++k) {
			far[k]   = ((l[k] + o[k]) >> 1) - view.origin[k];
			wings[k] = (sum[k] >> 2) - view.origin[k];
		}
	}
	view.normal = normalised(normal);
}

/// The vertex across the edge that the corner faces, or where a parallelogram has it.
Vector Neighbourhood::beyond(Index c) const
{
	const Index o = parent_->opposite[c];
	if (o != kNone)
		return at(parent_->vertex[o]);
	return at(parent_->vertex[nextCorner(c)]) + at(parent_->vertex[prevCorner(c)]) -
	       at(parent_->vertex[c]);
}

void Neighbourhood::describe(
    VertexView& view,
    const std::array<Vector, kOffsetFeatures>& features,
    const std::array<Index, 3>* parents) const
{
	const UnitVector& n = view.normal;
	for (std::size_t i = 0; i < kOffsetFeatures; ++i)
		for (std::size_t k = 0; k < 3; ++k)
			view.features[k][i] = view.feature(features[i][k]);
	for (std::size_t i = 0; i < kOffsetFeatures; ++i)
		view.heightFeatures[i] = static_cast<std::int32_t>(
		    along({view.features[0][i], view.features[1][i], view.features[2][i]}, n));

	// Where the tangent planes of the neighbours pass, above the origin along the normal.
	std::int64_t height = 0, weight = 0, nearHeight = 0, nearWeight = 0;
	for (std::size_t i = 0; i < view.size; ++i) {
		const Index u = view.ring[i];
		if (births_ && u >= firstNew_)
			continue;
		const UnitVector& m  = normals_[u];
		const std::int64_t w = along({m[0], m[1], m[2]}, n);
		if (w < 4915)
			continue;
		const std::int64_t h = along(fromOrigin(view, u), m);
		height += h;
		weight += w;
		if (births_ ? u == (*parents)[0] || u == (*parents)[1] : known(u)) {
			nearHeight += h;
			nearWeight += w;
		}
	}
	std::int32_t& mean = view.heightFeatures[kOffsetFeatures];
	mean               = weight ? view.feature(height * 16384 / weight) : 0;
	view.heightFeatures[kOffsetFeatures + 1] =
	    nearWeight ? view.feature(nearHeight * 16384 / nearWeight) : mean;
}

} // namespace wavemesh
