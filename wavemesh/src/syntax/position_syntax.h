// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Positions in the compact mode, written and read by the same template: the cells of new vertices
/// after a split, and further bits of all vertices. Vertex by vertex along a walk over the surface,
/// coordinate by coordinate, by the mixed distributions of many predictors (docs/algorithm.md).
///
/// Lengths are in sixteenths of a cell of the precision being coded.
#pragma once

#include "predict/expected_errors.h"
#include "predict/offset_prediction.h"

#include <wavemesh/codec.h>

namespace wavemesh {

template <class Coder, PredictorSet kSet>
class PositionSyntax
{
	static constexpr bool kRepeating = kSet == PredictorSet::Repeats;
	static constexpr std::size_t kAsked =
	    kSet == PredictorSet::Few ? kFewPredictors : std::size_t(kPredictors);
	static constexpr std::size_t kErrorsUsed = errorOf(kAsked, 0);

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
	        all_(models), vertexCount_(table.vertexCount), fullBits_(fullBits), glue_(glue),
	        around_(table, glue, models.records)
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
		births_ = true;
		begin(all_.births, shift, 0, cells);
		if (firstCounted_)
			for (Index v = 0; v < parent.vertexCount; ++v)
				count(cells[v]);
		Index whole                   = 0;
		const std::vector<Index> walk = around_.beginChildren(parent, refinement, parents, cells);
		for (std::size_t i = 0; i < walk.size() && goesOn(i, walk.size()); ++i) {
			const Index v = walk[i];
			if (!coder_.exhausted())
				codeVertex(v);
			if (!coder_.exhausted())
				++whole;
			else
				cells[v] = middle(cells, parents[v - parent.vertexCount]);
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
		births_ = false;
		truth_  = &truth;
		begin(all_.bits, shift, bits, cells);
		std::vector<Index> codedFirst(glue_.first.size(), kNone); // by the group's first vertex
		Index whole                   = 0;
		const std::vector<Index> walk = around_.beginBits(cells, bits);
		for (std::size_t i = 0; i < walk.size() && goesOn(i, walk.size()); ++i) {
			const Index v    = walk[i];
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
	void begin(PositionModels& models, int shift, int bits, std::vector<LatticePoint>& cells)
	{
		m_     = &models;
		bits_  = bits;
		shift_ = shift;
		cells_ = &cells;
		all_.records.resize(vertexCount_);
		firstCounted_ =
		    kRepeating && shift == 0 && fullBits_ <= CompactModels::kCountedBits && !all_.counts[0];
		if (firstCounted_)
			for (auto& counts : all_.counts)
				counts.emplace(std::size_t(1) << fullBits_);
	}
	bool goesOn(std::size_t coded, std::size_t all) const
	{
		constexpr std::size_t kBetween = 1024;
		return coded % kBetween != 0 || !progress_ || progress_(double(coded) / double(all));
	}
	/// At full precision.
	void count(const LatticePoint& cell)
	{
		for (std::size_t k = 0; k < 3; ++k)
			if (all_.counts[k])
				all_.counts[k]->add(static_cast<std::uint32_t>(cell[k]));
	}

	void codeVertex(Index v)
	{
		around_.reach(v);
		VertexView view;
		around_.look(v, view);
		predictOffset(*m_, view);
		expectErrors<kErrorsUsed>(*m_, around_, all_.records, view);
		const LatticePoint cell = codeCoordinates(v, view);
		if (!coder_.exhausted())
			remember(v, view, cell);
	}

	/// Copies of a vertex are at the same place: nothing to code.
	void copyVertex(Index from, Index to)
	{
		place(to, (*cells_)[from]);
		all_.records[to] = all_.records[from];
	}
	void place(Index v, const LatticePoint& cell)
	{
		(*cells_)[v] = cell;
		around_.place(v, {16 * cell[0], 16 * cell[1], 16 * cell[2]});
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
	    VertexView& view,
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
		view.predicted[which][axis]  = view.offset[axis] + view.unscaled(shift);
		const int deviation          = view.along + ((logAfter - state.logBefore) >> 1);
		view.scale[3 * which + axis] = std::clamp(deviation >> 1, 0, kScaleClasses - 1);
		state.before                 = after;
		state.logBefore              = logAfter;
	}

	/// To the middle of a cell, in 1/16, from the lattice's origin.
	static std::int64_t rounded(const VertexView& view, std::size_t axis, std::int64_t offset)
	{
		return (view.origin[axis] + offset + 8) & ~std::int64_t(15);
	}

	LatticePoint codeCoordinates(Index v, VertexView& view)
	{
		MixedValue& value = m_->value;
		LatticePoint cell {0, 0, 0};
		OnSurface narrow(view.across - view.along - 14), wide(view.across - view.along);
		std::int64_t squares = 0, product = 0;         // of the normal, and with the errors, scaled
		std::array<std::int64_t, kPredictors> miss {}; // of each predictor, in the axes before
		for (std::size_t axis = 0; axis < 3; ++axis) {
			squares += (std::int64_t(view.normal[axis]) * view.normal[axis]) >> 14;
			predictOnSurface(view, kSurfaceNarrow, axis, narrow, squares, product);
			predictOnSurface(view, kSurface, axis, wide, squares, product);
			for (std::size_t i = 0; i < kAsked; ++i) {
				const int scale         = view.scale[3 * i + axis];
				const std::size_t large = scale < 16 ? 0 : scale < 32 ? 1 : 2;
				value.setOpinion(
				    i, view.origin[axis] + view.predicted[i][axis], scale, m_->shapes[i][large]);
			}
			std::size_t best = kSmooth;
			for (std::size_t i = kSmooth + 1; i < kAsked; ++i)
				if (miss[i] < miss[best])
					best = i;
			const auto a           = static_cast<std::int64_t>(axis);
			const std::size_t sure = axis == 0              ? 0
			                         : miss[best] <= 8 * a  ? 1
			                         : miss[best] <= 24 * a ? 2
			                                                : 3;
			if (kRepeating && shift_ == 0)
				setRepeats(view, axis, cell, best, sure);

			MixContext context;
			const std::int64_t n = std::abs(view.normal[axis]);
			context.a            = kRepeating && bits_ != 1
			                           ? contextOfRepeats(view)
			                           : static_cast<std::size_t>(
                                  std::clamp((view.scale[3 * kSurface + axis] - 12) / 4, 0, 7));
			context.b =
			    axis * 4 + (axis == 0 ? std::min<std::size_t>(view.parallelograms, 3) : sure);
			context.c  = axis * 4 + (view.hasNoNormal() ? 0 : n < 4915 ? 1 : n < 13107 ? 2 : 3);
			cell[axis] = kRepeating && shift_ == 0
			                 ? codeCoordinate<MixedValue::kMaxOpinions>(v, view, axis, context)
			                 : codeCoordinate<kAsked>(v, view, axis, context);
			if (coder_.exhausted())
				return cell;
			const std::int64_t offset = 16 * std::int64_t(cell[axis]) - view.origin[axis];
			product += (view.normal[axis] * view.scaled(offset - view.offset[axis])) >> 14;
			for (std::size_t i = kSmooth; i < kAsked; ++i)
				miss[i] += static_cast<std::int64_t>(magnitude(offset - view.predicted[i][axis]));
		}
		return cell;
	}

	/// How many of the known neighbours were right with one of the predictors.
	static std::size_t contextOfRepeats(const VertexView& view)
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
	    const VertexView& view,
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
			if (!around_.known(u))
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
	codeCoordinate(Index v, const VertexView& view, std::size_t axis, const MixContext& context)
	{
		const ValueCounts* counts =
		    kRepeating && shift_ == 0 && all_.counts[axis] ? &*all_.counts[axis] : nullptr;
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

	void remember(Index v, const VertexView& view, const LatticePoint& cell)
	{
		VertexRecord& record = all_.records[v];
		Vector offset;
		for (std::size_t k = 0; k < 3; ++k) {
			offset[k]        = 16 * std::int64_t(cell[k]) - view.origin[k];
			record.offset[k] = static_cast<std::int32_t>(offset[k] - view.middle[k]);
		}
		for (std::size_t i = kSmooth; i < kAsked; ++i)
			for (std::size_t k = 0; k < 3; ++k)
				record.error[errorOf(i, k)] = logError(offset[k] - view.predicted[i][k]);
		if (kRepeating)
			record.repeated = wasRight(view, offset);
		surfaceErrors(view, offset, record);
		learnRatios<kErrorsUsed>(*m_, view, record);
		learnOffset(*m_, view, offset);

		place(v, cell);
		if (kRepeating && shift_ == 0)
			count(cell);
	}

	static bool wasRight(const VertexView& view, const Vector& offset)
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

	Coder& coder_;
	CompactModels& all_;
	const Index vertexCount_;
	const int fullBits_;
	const Glue& glue_;
	Neighbourhood around_;
	Progress progress_;

	bool births_                            = false;
	bool firstCounted_                      = false; ///< coordinates are counted from now on
	PositionModels* m_                      = nullptr;
	int shift_                              = 0;
	int bits_                               = 0;
	std::vector<LatticePoint>* cells_       = nullptr;
	const std::vector<LatticePoint>* truth_ = nullptr;
};

/// Calls `code` with the syntax for a set of predictors, made from `arguments`.
template <class Coder, class Code, class... Arguments>
auto withPositionSyntax(PredictorSet set, const Code& code, Arguments&&... arguments)
{
	switch (set) {
	case PredictorSet::Few:
		return code(PositionSyntax<Coder, PredictorSet::Few>(arguments...));
	case PredictorSet::All:
		return code(PositionSyntax<Coder, PredictorSet::All>(arguments...));
	case PredictorSet::Repeats:
		break;
	}
	return code(PositionSyntax<Coder, PredictorSet::Repeats>(arguments...));
}

} // namespace wavemesh
