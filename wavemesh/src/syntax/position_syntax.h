// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Positions in the compact mode, written and read by the same template: the cells of new vertices
/// after a split, and further bits of all vertices. Vertex by vertex along a walk over the surface,
/// coordinate by coordinate, by the mixed distributions of many predictors (docs/algorithm.md).
///
/// Lengths are in sixteenths of a cell of the precision being coded. "Known" vertices are those
/// whose cell has that precision already.
#pragma once

#include "mesh/glue.h"
#include "multires/refinement.h"
#include "multires/vertex_walk.h"
#include "predict/position_models.h"
#include "predict/surface.h"
#include "wavelet/lifting.h"

#include <wavemesh/codec.h>

namespace wavemesh {

template <class Coder>
class PositionSyntax
{
public:
	/// @param table      connectivity of the level that is being coded
	/// @param fullBits   bits per coordinate of the finest level
	/// @param glue       of the base mesh
	PositionSyntax(
	    Coder& coder,
	    CompactModels& models,
	    const CornerTable& table,
	    int fullBits,
	    const Glue& glue) :
	        coder_(coder),
	        all_(models), table_(table), fullBits_(fullBits), glue_(glue),
	        first_(firstCorners(table)), rank_(table.vertexCount)
	{
	}

	/// Has `progress` called now and then with the part of a level's vertices that are coded. If it
	/// returns false, coding stops there, and what was coded is of no use.
	void watch(const Progress& progress) { progress_ = progress; }

	/// Codes the cells of the vertices that a split added.
	///
	/// @param parent      the level before
	/// @param refinement  from `parent` to the table given
	/// @param shift       a cell is 2^shift lattice units wide
	/// @param cells       [in,out] #V by 3; the first #parent rows are known. Writing: all are
	/// @return how many new vertices are whole; the others got the middle of their parents
	Index codeChildren(
	    const CornerTable& parent,
	    const Refinement& refinement,
	    const Parents& parents,
	    int shift,
	    std::vector<LatticePoint>& cells)
	{
		births_  = true;
		parent_  = &parent;
		parents_ = &parents;
		begin(all_.births, shift, 0, cells);
		edgeCorner_.assign(parents.size(), kNone);
		for (Index c = 0; c < parent.cornerCount(); ++c) {
			const Index d = parent.opposite[c];
			if (refinement.childOnEdge[c] != kNone && (d == kNone || c < d))
				edgeCorner_[refinement.childOnEdge[c] - parent.vertexCount] = c;
		}
		likely_ =
		    likelyPositions(parent, {cells.begin(), cells.begin() + parent.vertexCount}, 0, glue_);
		normals_    = vertexNormals(parent, likely_);
		laplacians_ = laplacians(parent, likely_);
		likely_.resize(table_.vertexCount);
		firstNew_ = parent.vertexCount;

		const std::vector<Index> walk = vertexWalk(table_);
		Index next                    = firstNew_;
		for (const Index v : walk)
			rank_[v] = v < firstNew_ ? v : next++;
		Index whole = 0;
		for (const Index v : walk) {
			if (v < firstNew_)
				continue;
			if (!goesOn(rank_[v] - firstNew_, parents.size()))
				break;
			if (!coder_.exhausted()) {
				now_ = rank_[v];
				codeVertex(v);
			}
			if (!coder_.exhausted())
				++whole;
			else
				cells[v] = middle(cells, parents[v - firstNew_]);
		}
		return whole;
	}

	/// Codes `bits` more bits of every coordinate of every vertex.
	///
	/// @param shift  a cell is 2^shift lattice units wide afterwards
	/// @param cells  [in,out] #V by 3, on return of the finer precision
	/// @param truth  writing: #V by 3, the finer cells; reading: not used
	/// @return how many vertices are whole; the others got the middle of their cell
	Index codeBits(
	    int shift,
	    int bits,
	    std::vector<LatticePoint>& cells,
	    const std::vector<LatticePoint>& truth)
	{
		births_   = false;
		truth_    = &truth;
		firstNew_ = 0;
		likely_   = likelyPositions(table_, cells, bits, glue_);
		begin(all_.bits, shift, bits, cells);
		normals_    = vertexNormals(table_, likely_);
		laplacians_ = laplacians(table_, likely_);

		const std::vector<Index> walk = vertexWalk(table_);
		for (Index i = 0; i < walk.size(); ++i)
			rank_[walk[i]] = i;
		std::vector<Index> codedFirst(glue_.first.size(), kNone); // by the group's first vertex
		Index whole = 0;
		for (const Index v : walk) {
			now_ = rank_[v];
			if (!goesOn(now_, walk.size()))
				break;
			const bool glued = glue_.isShared(v);
			if (glued && codedFirst[glue_.first[v]] != kNone) {
				copyVertex(codedFirst[glue_.first[v]], v);
				++whole;
				continue;
			}
			if (!coder_.exhausted())
				codeVertex(v);
			if (coder_.exhausted()) {
				for (std::size_t k = 0; k < 3; ++k)
					cells[v][k] = cells[v][k] * (1 << bits) + ((1 << bits) >> 1);
				continue;
			}
			++whole;
			if (glued)
				codedFirst[glue_.first[v]] = v;
		}
		return whole;
	}

private:
	/// A vertex looks at so many neighbours at most.
	static constexpr std::size_t kMostNeighbours = 24;
	/// No prediction is further away than so many lengths.
	static constexpr std::int64_t kFurthest = 30;

	/// What the vertex being coded sees. Vectors are from origin.
	struct View
	{
		std::size_t size = 0; ///< neighbours
		std::array<Index, kMostNeighbours + 1> ring;
		std::array<Index, kMostNeighbours + 1>
		    corner; ///< at the vertex, in the face (ring[i], ring[i+1]); kNone: none

		Vector origin; ///< middle of the parents, or likely position
		std::int64_t length;
		int lengthBits;
		std::size_t parallelograms = 0; ///< known
		Index firstParent = kNone, firstKnown = kNone, lastKnown = kNone;
		std::size_t known = 0, repeated = 0; ///< neighbours
		UnitVector normal;

		std::array<Vector, kPredictors> predicted;
		Vector middle; ///< zero, or of the ring
		Vector offset; ///< by least squares, its height too
		std::array<LeastSquares<kOffsetFeatures>::Features, 3> features;
		LeastSquares<kOffsetFeatures + 2>::Features heightFeatures;
		Vector plainOffset;  ///< normalised, without the height
		std::int32_t height; ///< normalised
		std::size_t leastSquaresClass;

		std::array<int, kAxisErrors> scale; ///< by 3 * predictor + axis
		int across, along;                  ///< expected errors, log2 in eighths
	};

	void begin(PositionModels& models, int shift, int bits, std::vector<LatticePoint>& cells)
	{
		m_     = &models;
		bits_  = bits;
		shift_ = shift;
		cells_ = &cells;
		all_.records.resize(table_.vertexCount);
		if (shift == 0 && fullBits_ <= CompactModels::kCountedBits && !all_.counts[0]) {
			for (std::size_t k = 0; k < 3; ++k) {
				all_.counts[k].emplace(std::size_t(1) << fullBits_);
				for (Index v = 0; births_ && v < parent_->vertexCount; ++v)
					all_.counts[k]->add(static_cast<std::uint32_t>(cells[v][k]));
			}
		}
	}

	bool known(Index v) const { return rank_[v] < now_; }

	bool goesOn(std::size_t coded, std::size_t all) const
	{
		constexpr std::size_t kBetween = 4096;
		return coded % kBetween != 0 || !progress_ || progress_(double(coded) / double(all));
	}
	Vector at(Index v) const { return {likely_[v][0], likely_[v][1], likely_[v][2]}; }
	Vector fromOrigin(const View& view, Index v) const { return at(v) - view.origin; }

	/// 65536 / n for numbers of neighbours.
	struct Inverses
	{
		std::array<std::int32_t, kMostNeighbours + 2> of;
		constexpr Inverses() : of()
		{
			for (std::size_t n = 1; n < of.size(); ++n)
				of[n] = static_cast<std::int32_t>(65536 / n);
		}
	};
	static constexpr Inverses kInverses {};

	/// x / n, rounded; 0 for n = 0. |x| < 2^40
	static Vector mean(const Vector& sum, std::size_t n)
	{
		Vector out {0, 0, 0};
		if (n == 0)
			return out;
		for (std::size_t k = 0; k < 3; ++k)
			out[k] = (sum[k] * kInverses.of[n] + 32768) >> 16;
		return out;
	}
	static std::uint64_t magnitude(std::int64_t x)
	{
		return static_cast<std::uint64_t>(x < 0 ? -x : x);
	}
	static std::int64_t oneNorm(const Vector& a)
	{
		return static_cast<std::int64_t>(magnitude(a[0]) + magnitude(a[1]) + magnitude(a[2]));
	}

	/// To lengths in 1/4096 or so: the length around has 12 binary digits.
	static std::int64_t scaled(const View& view, std::int64_t x)
	{
		return view.lengthBits <= 12 ? x * (1 << (12 - view.lengthBits))
		                             : x >> (view.lengthBits - 12);
	}
	static std::int64_t unscaled(const View& view, std::int64_t x)
	{
		return view.lengthBits <= 12 ? x >> (12 - view.lengthBits)
		                             : x * (std::int64_t(1) << (view.lengthBits - 12));
	}
	static std::int32_t feature(const View& view, std::int64_t x)
	{
		constexpr std::int64_t kLargest = LeastSquares<kOffsetFeatures>::kLargest;
		return static_cast<std::int32_t>(std::clamp(scaled(view, x), -kLargest, kLargest));
	}

	void codeVertex(Index v)
	{
		View view;
		look(v, view);
		const LatticePoint cell = codeCoordinates(v, view);
		if (coder_.exhausted())
			return;
		remember(v, view, cell);
	}

	/// Copies of a vertex are at the same place: nothing to code.
	void copyVertex(Index from, Index to)
	{
		(*cells_)[to]    = (*cells_)[from];
		likely_[to]      = likely_[from];
		all_.records[to] = all_.records[from];
	}

	// ---- what the vertex sees -----------------------------------------------------------------

	void findRing(Index v, View& view) const
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

	void look(Index v, View& view) const
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

		Vector ring {0, 0, 0}, knownRing = ring, bent = ring, all = ring, knownAll = ring,
		                       first = ring, similar = ring;
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
					const VertexRecord& record = all_.records[u];
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
		predictByLeastSquares(view, features, parents);
		expectErrors(view);
	}

	void addParallelogram(
	    Index v,
	    View& view,
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

	Vector middleOfParents(const std::array<Index, 3>& parents) const
	{
		Vector sum = at(parents[0]) + at(parents[1]);
		if (parents[2] == kNone)
			return {sum[0] / 2, sum[1] / 2, sum[2] / 2};
		sum += at(parents[2]);
		return {sum[0] / 3, sum[1] / 3, sum[2] / 3};
	}

	/// The edge of a child in the parent level: the vertices across, those beyond, how it bends.
	void lookAtParents(
	    Index v,
	    View& view,
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
	Vector beyond(Index c) const
	{
		const Index o = parent_->opposite[c];
		if (o != kNone)
			return at(parent_->vertex[o]);
		return at(parent_->vertex[nextCorner(c)]) + at(parent_->vertex[prevCorner(c)]) -
		       at(parent_->vertex[c]);
	}

	void predictByLeastSquares(
	    View& view,
	    const std::array<Vector, kOffsetFeatures>& features,
	    const std::array<Index, 3>* parents) const
	{
		const UnitVector& n = view.normal;
		for (std::size_t i = 0; i < kOffsetFeatures; ++i)
			for (std::size_t k = 0; k < 3; ++k)
				view.features[k][i] = feature(view, features[i][k]);
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
		mean               = weight ? feature(view, height * 16384 / weight) : 0;
		view.heightFeatures[kOffsetFeatures + 1] =
		    nearWeight ? feature(view, nearHeight * 16384 / nearWeight) : mean;

		constexpr std::int32_t kMost = static_cast<std::int32_t>(kFurthest) * 4096;
		Vector& plain                = view.plainOffset;
		for (std::size_t k = 0; k < 3; ++k)
			plain[k] = std::clamp(
			    m_->offset[view.leastSquaresClass].predict(view.features[k]), -kMost, kMost);
		view.height = std::clamp(
		    m_->height[view.leastSquaresClass].predict(view.heightFeatures), -kMost, kMost);
		const std::int64_t lift = view.height - along(plain, n);
		for (std::size_t k = 0; k < 3; ++k)
			view.offset[k] = unscaled(view, plain[k] + ((lift * n[k]) >> 14));
	}

	/// Expected errors: mean of the logarithms around, and of what is usual for this length.
	void expectErrors(View& view) const
	{
		std::array<std::uint16_t, kErrors> around {}; // 24 neighbours at most: below 2^13
		std::size_t count = 1;
		for (std::size_t j = 0; j < view.size; ++j) {
			const Index u = view.ring[j];
			if (u >= firstNew_ && known(u)) {
				addErrors(all_.records[u], around);
				++count;
			}
		}
		const std::int32_t length  = log2Eighths(static_cast<std::uint64_t>(view.length));
		const std::int32_t inverse = kInverses.of[count] / 4;
		std::array<std::int32_t, kErrors> mean; // times 2^16
		for (std::size_t i = 0; i < kErrors; ++i)
			mean[i] = 4 * (std::max(0, length + m_->ratio[i] / 16) + around[i]) * inverse;
		for (std::size_t i = 0; i < kAxisErrors; ++i)
			view.scale[i] = std::min(mean[i] >> 17, kScaleClasses - 1);
		view.across = mean[kErrorAcross] >> 16;
		view.along  = mean[kErrorAlong] >> 16;
		if (view.normal == UnitVector {0, 0, 0})
			view.across = view.along;
	}

	/// A function, so that the loop is no inner one, which compilers unroll and not vectorise.
	static void addErrors(const VertexRecord& record, std::array<std::uint16_t, kErrors>& sums)
	{
		for (std::size_t i = 0; i < kErrors; ++i)
			sums[i] = static_cast<std::uint16_t>(sums[i] + record.error[i]);
	}

	// ---- coordinates --------------------------------------------------------------------------

	/// One coordinate given those before it, for an error that is normally distributed with one
	/// deviation across the surface and another along it.
	struct OnSurface
	{
		std::int64_t g;             ///< excess of the variance across the surface, 1/4096
		std::int64_t before = 4096; ///< what is left of the variance by the axes before, 1/4096
		int logBefore       = 96;   ///< log2 in eighths

		/// @param ratio  log2 of the deviations, across / along, in eighths
		explicit OnSurface(int ratio) : g(exp2Eighths(std::clamp(2 * ratio, -80, 48)) - 4096) {}
	};

	/// Mean and deviation of the next coordinate.
	/// @param squares  of the normal's coordinates, up to this axis
	/// @param product  of the normal with the errors in the axes before
	void predictOnSurface(
	    View& view,
	    Predictor which,
	    std::size_t axis,
	    OnSurface& state,
	    std::int64_t squares,
	    std::int64_t product) const
	{
		const std::int64_t after = std::max<std::int64_t>(4096 + ((state.g * squares) >> 14), 4);
		const int logAfter       = log2Eighths(static_cast<std::uint64_t>(after));
		const std::int64_t most  = kFurthest * 4096;
		std::int64_t shift       = 0;
		if (product != 0)
			shift = std::clamp(
			    ((state.g * view.normal[axis]) >> 14) * product / state.before, -most, most);
		view.predicted[which][axis]  = view.offset[axis] + unscaled(view, shift);
		const int deviation          = view.along + ((logAfter - state.logBefore) >> 1);
		view.scale[3 * which + axis] = std::clamp(deviation >> 1, 0, kScaleClasses - 1);
		state.before                 = after;
		state.logBefore              = logAfter;
	}

	/// To the middle of a cell, in 1/16, from the lattice's origin.
	static std::int64_t rounded(const View& view, std::size_t axis, std::int64_t offset)
	{
		return (view.origin[axis] + offset + 8) & ~std::int64_t(15);
	}

	LatticePoint codeCoordinates(Index v, View& view)
	{
		MixedValue& value = m_->value;
		LatticePoint cell {0, 0, 0};
		OnSurface narrow(view.across - view.along - 14), wide(view.across - view.along);
		std::int64_t squares = 0, product = 0; // of the normal, and with the errors, scaled
		std::array<std::int64_t, kSurfaceNarrow> miss {}; // of each predictor, in the axes before
		for (std::size_t axis = 0; axis < 3; ++axis) {
			squares += (std::int64_t(view.normal[axis]) * view.normal[axis]) >> 14;
			predictOnSurface(view, kSurfaceNarrow, axis, narrow, squares, product);
			predictOnSurface(view, kSurface, axis, wide, squares, product);
			for (std::size_t i = 0; i < kPredictors; ++i) {
				const int scale         = view.scale[3 * i + axis];
				const std::size_t large = scale < 16 ? 0 : scale < 32 ? 1 : 2;
				value.setOpinion(
				    i, view.origin[axis] + view.predicted[i][axis], scale, m_->shapes[i][large]);
			}
			std::size_t best = 0;
			for (std::size_t i = 1; i < miss.size(); ++i)
				if (miss[i] < miss[best])
					best = i;
			const auto a           = static_cast<std::int64_t>(axis);
			const std::size_t sure = axis == 0              ? 0
			                         : miss[best] <= 8 * a  ? 1
			                         : miss[best] <= 24 * a ? 2
			                                                : 3;
			if (shift_ == 0)
				setRepeats(view, axis, cell, best, sure);

			MixContext context;
			const std::int64_t n = std::abs(view.normal[axis]);
			context.a            = contextOfRepeats(view);
			if (bits_ == 1)
				context.a = static_cast<std::size_t>(
				    std::clamp((view.scale[3 * kSurface + axis] - 12) / 4, 0, 7));
			context.b =
			    axis * 4 + (axis == 0 ? std::min<std::size_t>(view.parallelograms, 3) : sure);
			context.c  = axis * 4 + (view.normal == UnitVector {0, 0, 0} ? 0
			                         : n < 4915                          ? 1
			                         : n < 13107                         ? 2
			                                                             : 3);
			cell[axis] = shift_ == 0
			                 ? codeCoordinate<MixedValue::kMaxOpinions>(v, view, axis, context)
			                 : codeCoordinate<MixedValue::kFewOpinions>(v, view, axis, context);
			if (coder_.exhausted())
				return cell;
			const std::int64_t offset = 16 * std::int64_t(cell[axis]) - view.origin[axis];
			product += (view.normal[axis] * scaled(view, offset - view.offset[axis])) >> 14;
			for (std::size_t i = 0; i < miss.size(); ++i)
				miss[i] += static_cast<std::int64_t>(magnitude(offset - view.predicted[i][axis]));
		}
		return cell;
	}

	/// How many of the known neighbours were right with one of the predictors.
	static std::size_t contextOfRepeats(const View& view)
	{
		if (view.known == 0)
			return 0;
		if (view.repeated == 0)
			return 1;
		if (view.repeated == view.known)
			return 4;
		return 2 * view.repeated < view.known ? 2 : 3;
	}

	void setRepeats(
	    const View& view,
	    std::size_t axis,
	    const LatticePoint& cell,
	    std::size_t best,
	    std::size_t sure)
	{
		// The known neighbour that agrees best so far.
		Index match        = kNone;
		std::int64_t least = 0;
		for (std::size_t j = 0; j < view.size; ++j) {
			const Index u = view.ring[j];
			if (!known(u))
				continue;
			std::int64_t difference = 0;
			for (std::size_t k = 0; k < axis; ++k)
				difference += std::abs(std::int64_t((*cells_)[u][k]) - cell[k]);
			if (match == kNone || difference < least) {
				match = u;
				least = difference;
			}
		}
		const auto cellOf = [&](Index u) {
			return u == kNone ? rounded(view, axis, 0) : 16 * std::int64_t((*cells_)[u][axis]);
		};
		const Index first                   = births_ ? view.firstParent : view.firstKnown;
		const auto& p                       = view.predicted;
		const std::int64_t centre[kRepeats] = {
		    rounded(view, axis, view.middle[axis]),
		    rounded(view, axis, p[kParallelograms][axis]),
		    rounded(view, axis, p[kParallelogram][axis]),
		    cellOf(match),
		    cellOf(view.lastKnown),
		    rounded(view, axis, p[best][axis]),
		    cellOf(first)};
		const std::size_t matched           = axis == 0 || match == kNone ? 0
		                                      : least == 0                ? 1
		                                      : least <= 2                ? 2
		                                                                  : 3;
		const std::size_t context[kRepeats] = {
		    0,
		    std::min<std::size_t>(view.parallelograms, 3),
		    view.parallelograms > 0 ? 1u : 0u,
		    matched,
		    view.lastKnown == kNone ? 0u : 1u,
		    sure,
		    0};
		for (std::size_t i = 0; i < kRepeats; ++i)
			m_->value.setOpinion(kPredictors + i, centre[i], 8, m_->repeats[i][axis][context[i]]);
	}

	template <std::size_t Opinions>
	std::int32_t
	codeCoordinate(Index v, const View& view, std::size_t axis, const MixContext& context)
	{
		const ValueCounts* counts =
		    shift_ == 0 && all_.counts[axis] ? &*all_.counts[axis] : nullptr;
		std::int32_t wanted = 0;
		if constexpr (!Coder::kReading)
			wanted = births_ ? (*cells_)[v][axis] : (*truth_)[v][axis];
		if (births_) {
			const std::int64_t end   = std::int64_t(1) << (fullBits_ - shift_);
			const std::int64_t guide = std::clamp<std::int64_t>(
			    (view.origin[axis] + view.offset[axis] + 8) >> 4, 0, end - 1);
			const int spread = std::max(0, (view.scale[3 * kSurface + axis] - 20) / 4);
			return static_cast<std::int32_t>(m_->value.template codeAround<Opinions>(
			    coder_, wanted, 0, end, guide, spread, context, counts));
		}
		return static_cast<std::int32_t>(m_->value.template codeWithin<Opinions>(
		    coder_, wanted, std::int64_t((*cells_)[v][axis]) * (1 << bits_), bits_, context,
		    counts));
	}

	// ---- learning -----------------------------------------------------------------------------

	static std::uint8_t logError(std::int64_t e)
	{
		const std::uint64_t x = std::min<std::uint64_t>(magnitude(e) + 8, 0xffffffff);
		return static_cast<std::uint8_t>(log2OfWord(static_cast<std::uint32_t>(x)) >> 9);
	}

	void remember(Index v, const View& view, const LatticePoint& cell)
	{
		VertexRecord& record = all_.records[v];
		Vector offset;
		for (std::size_t k = 0; k < 3; ++k) {
			offset[k]        = 16 * std::int64_t(cell[k]) - view.origin[k];
			record.offset[k] = static_cast<std::int32_t>(offset[k] - view.middle[k]);
		}
		for (std::size_t i = 0; i < kPredictors; ++i)
			for (std::size_t k = 0; k < 3; ++k)
				record.error[3 * i + k] = logError(offset[k] - view.predicted[i][k]);
		record.repeated = wasRight(view, offset);
		surfaceErrors(view, offset, record);
		learnRatios(view, record);
		learnLeastSquares(view, offset);

		(*cells_)[v] = cell;
		for (std::size_t k = 0; k < 3; ++k) {
			likely_[v][k] = 16 * cell[k];
			if (shift_ == 0 && all_.counts[k])
				all_.counts[k]->add(static_cast<std::uint32_t>(cell[k]));
		}
	}

	static bool wasRight(const View& view, const Vector& offset)
	{
		const Vector* const candidates[] = {
		    &view.middle, &view.predicted[kParallelograms], &view.predicted[kRing],
		    &view.predicted[kParallelogram]};
		for (const Vector* p : candidates) {
			const Vector d = offset - *p;
			if (std::max({magnitude(d[0]), magnitude(d[1]), magnitude(d[2])}) <= 8)
				return true;
		}
		return false;
	}

	static void surfaceErrors(const View& view, const Vector& offset, VertexRecord& record)
	{
		const Vector e            = offset - view.offset;
		const std::int64_t height = along(e, view.normal);
		std::uint64_t squares     = 0;
		for (const std::int64_t x : e)
			squares += magnitude(x) * magnitude(x);
		const std::uint64_t across = magnitude(height) * magnitude(height);
		const std::uint64_t along2 = squares > across ? (squares - across) / 2 : 0;
		record.error[kErrorAcross] = logError(height);
		record.error[kErrorAlong] =
		    static_cast<std::uint8_t>(std::min(log2Eighths(along2 + 64) / 2, 255));
	}

	/// Of the surface only where there is one.
	void learnRatios(const View& view, const VertexRecord& record)
	{
		const std::int32_t length = log2Eighths(static_cast<std::uint64_t>(view.length));
		const std::size_t count   = view.normal == UnitVector {0, 0, 0} ? kAxisErrors : kErrors;
		for (std::size_t i = 0; i < count; ++i)
			m_->ratio[i] += ((record.error[i] - length) * 16 - m_->ratio[i]) / 32;
	}

	/// Observations count less the worse they were predicted, and none more than its rounding
	/// allows.
	static std::int32_t importance(const View& view, std::int64_t error)
	{
		const auto e = static_cast<std::int32_t>(std::min<std::uint64_t>(magnitude(error), 4096));
		const std::int32_t rounding = 22369621 >> std::min(2 * view.lengthBits, 31);
		return (1 << 20) / (1024 + (e * e >> 4) + rounding) + 1;
	}

	void learnLeastSquares(const View& view, const Vector& offset)
	{
		auto& plain  = m_->offset[view.leastSquaresClass];
		auto& height = m_->height[view.leastSquaresClass];
		std::array<std::int32_t, 3> target, importances;
		for (std::size_t k = 0; k < 3; ++k) {
			target[k]      = feature(view, offset[k]);
			importances[k] = importance(view, target[k] - view.plainOffset[k]);
		}
		plain.observe(view.features, target, importances);
		plain.endOfVertex();
		if (view.normal == UnitVector {0, 0, 0})
			return;
		const auto up = static_cast<std::int32_t>(std::clamp<std::int64_t>(
		    along({target[0], target[1], target[2]}, view.normal), -8192, 8192));
		height.template observe<1>(
		    {view.heightFeatures}, {up}, {importance(view, up - view.height)});
		height.endOfVertex();
	}

	Coder& coder_;
	CompactModels& all_;
	const CornerTable& table_;
	const int fullBits_;
	const Glue& glue_;
	Progress progress_;
	std::vector<Index> first_;
	std::vector<Index> rank_; ///< #V: place in the order of coding
	Index now_ = 0;           ///< rank of the vertex being coded

	bool births_                      = false;
	PositionModels* m_                = nullptr;
	int shift_                        = 0;
	int bits_                         = 0;
	Index firstNew_                   = 0;
	std::vector<LatticePoint>* cells_ = nullptr;
	std::vector<LatticePoint> likely_; ///< #V: 16 times the cell, or where in its cell it may be
	std::vector<LatticePoint> laplacians_;
	std::vector<UnitVector> normals_;

	const CornerTable* parent_              = nullptr;
	const Parents* parents_                 = nullptr;
	const std::vector<LatticePoint>* truth_ = nullptr;
	std::vector<Index> edgeCorner_; ///< #children: corner of the parent level facing the edge
};

} // namespace wavemesh
