// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Rows of whole numbers, each next to rows that are known, by the mixed distributions of several
/// predictors (entropy/mixed_value.h).
#pragma once

#include "attributes/channel.h"
#include "entropy/mixed_value.h"

#include <memory>

namespace wavemesh {

/// Known rows near the one to be coded; nullptr: there is none. If there is no `a` there is no
/// other; `left` and `right` lie across the edge from `a` to `b`.
struct NearRows
{
	const double *a = nullptr, *b = nullptr, *left = nullptr, *right = nullptr;
};

class LatticeSyntax
{
public:
	explicit LatticeSyntax(const std::vector<Column>& columns) : columns_(columns) {}

	/// @param row  as many numbers as there are columns
	template <class Coder>
	void code(Coder& coder, double* row, const NearRows& near)
	{
		if (models_.empty()) { // megabytes, if there are many columns
			models_.resize(columns_.size());
			value_ = std::make_unique<MixedValue>(6144);
		}
		std::int64_t off = 0; // of the column before, 1/16
		for (std::size_t k = 0; k < columns_.size() && !coder.exhausted(); ++k) {
			if (columns_[k].bits == 0) {
				row[k] = 0;
				continue;
			}
			View view    = look(k, near, off);
			const auto x = codeNumber(coder, static_cast<std::int64_t>(row[k]), k, view);
			if (coder.exhausted())
				break;
			row[k] = double(x);
			off    = 16 * x - view.centre[kMean];
			learn(k, 16 * x, view);
		}
	}

private:
	enum Predictor {
		kMean,      ///< of a and b
		kSmooth,    ///< drawn to the sides
		kFirst,     ///< a
		kSecond,    ///< b
		kLikeLast,  ///< off the mean as the last row was
		kLikeOther, ///< off the mean as the column before is
		kRepeat,    ///< the last row's
		kSharp,     ///< away from the sides
		kPredictors
	};
	static_assert(kPredictors == MixedValue::kSomeOpinions);

	struct ColumnModels
	{
		std::array<std::array<ResidualShape, 3>, kPredictors> shape; ///< by class of scale
		std::array<std::int32_t, kPredictors> ratio {};     ///< log2 of error to spread, 1/128
		std::array<std::int32_t, kPredictors> lastError {}; ///< log2, 1/8
		std::int64_t last = 0, lastOff = 0;                 ///< 1/16
	};
	struct View
	{
		std::array<std::int64_t, kPredictors> centre; ///< 1/16
		std::array<int, kPredictors> scale;
		std::size_t best = 0; ///< predictor
		int spread       = 0; ///< of what is near: log2 in eighths
		MixContext context;
	};
	/// Counts of values are not used.
	struct NoCounts
	{
		std::uint32_t below(std::uint32_t) const { return 0; }
	};

	static std::uint64_t magnitude(std::int64_t x)
	{
		return static_cast<std::uint64_t>(x < 0 ? -x : x);
	}
	static int logOf(std::int64_t x) { return std::min(log2Eighths(magnitude(x) + 8), 255); }

	View look(std::size_t k, const NearRows& near, std::int64_t off) const
	{
		const ColumnModels& m = models_[k];
		const auto at = [k](const double* row) { return static_cast<std::int64_t>(row[k]); };
		const std::int64_t half = std::int64_t(1) << (columns_[k].bits - 1);
		const std::int64_t a = near.a ? at(near.a) : half, b = near.b ? at(near.b) : a;
		const std::int64_t mean = 8 * (a + b);
		// What the sides differ from the middle, if they are known.
		std::int64_t bend = 0, across = 0;
		if (near.left && near.right) {
			bend   = 2 * (at(near.left) + at(near.right) - a - b);
			across = at(near.left) - at(near.right);
		}
		View v;
		v.centre[kMean]      = mean;
		v.centre[kSmooth]    = mean + bend;
		v.centre[kFirst]     = 16 * a;
		v.centre[kSecond]    = 16 * b;
		v.centre[kLikeLast]  = mean + m.lastOff;
		v.centre[kLikeOther] = mean + (k > 0 ? off : m.lastOff / 2);
		v.centre[kRepeat]    = m.last;
		v.centre[kSharp]     = mean - bend;
		v.spread             = logOf(std::int64_t(8 * (magnitude(a - b) + magnitude(across))) + 8);
		for (std::size_t i = 0; i < kPredictors; ++i) {
			const int expected = std::max(0, v.spread + m.ratio[i] / 16);
			v.scale[i]         = std::min((3 * expected + m.lastError[i]) / 8, kScaleClasses - 1);
			if (m.ratio[i] < m.ratio[v.best])
				v.best = i;
		}
		const int seen = k > 0 ? logOf(off) : m.lastError[kMean];
		v.context.a =
		    4 * std::min<std::size_t>(k, 2) + std::size_t(std::clamp((seen - 24) / 16, 0, 3));
		v.context.b = (near.b ? 1u : 0u) + (near.left ? 2u : 0u) + (near.right ? 2u : 0u) +
		              (a == b ? 5u : 0u);
		v.context.c = std::size_t(std::min(v.scale[kMean] / 6, 11));
		return v;
	}

	template <class Coder>
	std::int64_t codeNumber(Coder& coder, std::int64_t x, std::size_t k, const View& view)
	{
		for (std::size_t i = 0; i < kPredictors; ++i)
			value_->setOpinion(
			    i, view.centre[i], view.scale[i],
			    models_[k].shape[i][std::size_t(std::min(view.scale[i] / 16, 2))]);
		const std::int64_t end = std::int64_t(1) << columns_[k].bits;
		const std::int64_t guide =
		    std::clamp<std::int64_t>((view.centre[view.best] + 8) >> 4, 0, end - 1);
		const int spread = std::max(0, (view.scale[view.best] - 20) / 4);
		return value_->codeAround<MixedValue::kSomeOpinions>(
		    coder, x, 0, end, guide, spread, view.context, static_cast<const NoCounts*>(nullptr));
	}

	void learn(std::size_t k, std::int64_t x, const View& view)
	{
		ColumnModels& m = models_[k];
		for (std::size_t i = 0; i < kPredictors; ++i) {
			const int error = logOf(x - view.centre[i]);
			m.ratio[i] += ((error - view.spread) * 16 - m.ratio[i]) / 32;
			m.lastError[i] = error;
		}
		m.lastOff = x - view.centre[kMean];
		m.last    = x;
	}

	const std::vector<Column>& columns_;
	std::unique_ptr<MixedValue> value_;
	std::vector<ColumnModels> models_;
};

} // namespace wavemesh
