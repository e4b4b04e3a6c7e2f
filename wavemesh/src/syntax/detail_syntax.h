// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The details (wavelet coefficients) of one split, written and read by the same template. A detail
/// is coded coordinate by coordinate: is it zero, its sign, its length in bits, its leading bits.
/// Each decision mixes models that know the length of the edge, the details nearby, and where a
/// smooth surface would put the vertex.
#pragma once

#include "entropy/models.h"
#include "mesh/integer_math.h"
#include "multires/refinement.h"

#include <memory>
#include <vector>

namespace wavemesh {

/// Rows of models, each made when it is first asked for: most contexts never occur in a small file.
class ModelRows
{
public:
	ModelRows(int rows, int width) : rows_(std::size_t(rows)), width_(std::size_t(width)) {}

	AdaptiveBit* row(int i)
	{
		std::unique_ptr<AdaptiveBit[]>& row = rows_[std::size_t(i)];
		if (!row)
			row = std::make_unique<AdaptiveBit[]>(width_);
		return row.get();
	}

private:
	std::vector<std::unique_ptr<AdaptiveBit[]>> rows_;
	std::size_t width_;
};

/// Learned state of the geometry; lives through all levels of a file.
class DetailModels
{
public:
	static constexpr int kInputs     = 6;
	static constexpr int kMaxLength  = 31; ///< bits of a magnitude
	static constexpr int kNodes      = 2 + 4 * (kMaxLength + 1);
	static constexpr int kLengths    = 50; ///< half octaves of edge length
	static constexpr int kMagnitudes = 34;
	static constexpr int kOffsets    = 21; ///< signed octaves of the smooth prediction

	ModelRows byAxis {3, kNodes};
	ModelRows byLength {3 * kLengths, kNodes};
	ModelRows byNeighbours {kMagnitudes * kMagnitudes, kNodes};
	ModelRows byOtherAxes {3 * kMagnitudes * (kLengths / 4 + 1), kNodes};
	ModelRows byOffset {kOffsets * (kLengths / 2), kNodes};
	ModelRows byOffsetAndNeighbours {kOffsets * kMagnitudes, kNodes};
	Mixer<kInputs> mixer {kNodes};

	/// #vertices so far: 1-norm of the detail each was born with.
	std::vector<std::uint32_t> magnitude;
};

template <class Coder>
class DetailSyntax
{
public:
	/// @param table       connectivity of the parent level
	/// @param refinement  whole
	/// @param positions   #V_{j-1} by 3: level j-1 as the decoder has it
	DetailSyntax(
	    Coder& coder,
	    DetailModels& models,
	    const CornerTable& table,
	    const Refinement& refinement,
	    const std::vector<LatticePoint>& positions) :
	        coder_(coder),
	        models_(models), table_(table), refinement_(refinement), positions_(positions)
	{
	}

	/// Codes all details, in the order of the new vertices. Reading: those that the data do not
	/// determine stay zero; returns how many are whole.
	std::size_t code(std::vector<LatticePoint>& details)
	{
		models_.magnitude.resize(refinement_.childVertices, 0);
		std::size_t child = 0;
		for (Index c = 0; c < table_.cornerCount(); ++c) {
			const Index d = table_.opposite[c];
			if (refinement_.childOnEdge[c] == kNone || (d != kNone && d < c))
				continue;
			setEdgeContext(c, d);
			if (!codeDetail(details[child]))
				return child;
			++child;
		}
		for (Index f = 0; f < table_.faceCount(); ++f)
			if (refinement_.faceCode[f] == kFaceCentre) {
				setCentreContext(3 * f);
				if (!codeDetail(details[child]))
					return child;
				++child;
			}
		return child;
	}

private:
	struct Context
	{
		Index child;
		int length;     ///< class
		int near, born; ///< classes of the details around, and of those the parents were born with
		std::array<int, 3> offset; ///< classes of the smooth prediction, less the middle
	};

	const LatticePoint& at(Index v) const { return positions_[v]; }

	void setEdgeContext(Index c, Index d)
	{
		const Index a = table_.vertex[nextCorner(c)], b = table_.vertex[prevCorner(c)];
		context_.child  = refinement_.childOnEdge[c];
		context_.length = lengthClass(squaredDistance(at(a), at(b)));
		context_.born =
		    magnitudeClass((std::uint64_t(models_.magnitude[a]) + models_.magnitude[b]) / 2);

		std::uint64_t sum = 0, count = 0;
		for (const Index side : {c, d}) {
			if (side == kNone)
				continue;
			for (const Index edge : {nextCorner(side), prevCorner(side)}) {
				const Index sibling = refinement_.childOnEdge[edge];
				if (sibling != kNone && sibling < context_.child) {
					sum += models_.magnitude[sibling];
					++count;
				}
			}
		}
		context_.near =
		    count == 0 ? 0
		               : 1 + std::min(magnitudeClass(sum / count), DetailModels::kMagnitudes - 2);

		// Butterfly rule: (a+b)/2 + (l+o)/8 - (the four vertices beyond)/16.
		std::array<std::int64_t, 3> offset {0, 0, 0};
		if (d != kNone) {
			const Index beyond[4] = {
			    across(nextCorner(c)), across(prevCorner(c)), across(nextCorner(d)),
			    across(prevCorner(d))};
			if (beyond[0] != kNone && beyond[1] != kNone && beyond[2] != kNone &&
			    beyond[3] != kNone)
				for (std::size_t k = 0; k < 3; ++k) {
					offset[k] =
					    2 * (std::int64_t(at(table_.vertex[c])[k]) + at(table_.vertex[d])[k]);
					for (const Index v : beyond)
						offset[k] -= at(v)[k];
				}
		}
		setOffset(offset);
	}

	void setCentreContext(Index c)
	{
		const Index a = table_.vertex[c], b = table_.vertex[c + 1];
		context_.child  = nextCentre();
		context_.length = lengthClass(squaredDistance(at(a), at(b)));
		context_.born   = 0;
		context_.near   = 0;
		setOffset({0, 0, 0});
	}
	/// Centres are the last vertices of the level, in the order of the faces.
	Index nextCentre()
	{
		if (centre_ == kNone) {
			centre_ = refinement_.childVertices;
			for (const FaceCode code : refinement_.faceCode)
				centre_ -= code == kFaceCentre;
		}
		return centre_++;
	}

	/// @param sixteenths  of a step
	void setOffset(const std::array<std::int64_t, 3>& sixteenths)
	{
		for (std::size_t k = 0; k < 3; ++k) {
			const std::int64_t x = sixteenths[k];
			const int size =
			    std::min(bitLength(static_cast<std::uint64_t>((x < 0 ? -x : x) >> 2)), 10);
			context_.offset[k] = 10 + (x < 0 ? -size : size);
		}
	}
	Index across(Index c) const
	{
		const Index o = table_.opposite[c];
		return o == kNone ? kNone : table_.vertex[o];
	}

	static int lengthClass(std::uint64_t squared)
	{
		return std::min(log2Quarters(squared) / 4, DetailModels::kLengths - 1);
	}
	static int magnitudeClass(std::uint64_t norm)
	{
		return std::min(log2Quarters(norm + 1) / 2, DetailModels::kMagnitudes - 1);
	}

	bool codeDetail(LatticePoint& detail)
	{
		std::uint64_t known = 0;
		LatticePoint out {};
		for (std::size_t axis = 0; axis < 3; ++axis) {
			select(static_cast<int>(axis), known);
			out[axis] = codeValue(detail[axis]);
			if (coder_.exhausted())
				return false;
			const std::int64_t x = out[axis];
			known += static_cast<std::uint64_t>(x < 0 ? -x : x);
		}
		detail = out;
		models_.magnitude[context_.child] =
		    static_cast<std::uint32_t>(std::min<std::uint64_t>(known, 0xffffffffu));
		return true;
	}

	/// Finds the rows of the models for one coordinate.
	void select(int axis, std::uint64_t known)
	{
		DetailModels& m  = models_;
		const int offset = context_.offset[std::size_t(axis)];
		const int other  = axis == 0 ? context_.near : magnitudeClass(known);
		rows_            = {
		               m.byAxis.row(axis),
		               m.byLength.row(axis * DetailModels::kLengths + context_.length),
		               m.byNeighbours.row(context_.near * DetailModels::kMagnitudes + context_.born),
		               m.byOtherAxes.row(
		                   (axis * DetailModels::kMagnitudes + other) * (DetailModels::kLengths / 4 + 1) +
		                   context_.length / 4),
		               m.byOffset.row(offset * (DetailModels::kLengths / 2) + context_.length / 2),
		               m.byOffsetAndNeighbours.row(offset * DetailModels::kMagnitudes + context_.near)};
	}

	bool codeNode(int node, bool value)
	{
		return models_.mixer.code(coder_, rows_, std::size_t(node), node, value, 255);
	}

	std::int32_t codeValue(std::int32_t value)
	{
		constexpr int kZero = 0, kSign = 1, kLength = 2,
		              kTop    = kLength + DetailModels::kMaxLength + 1;
		constexpr int kSecond = kTop + DetailModels::kMaxLength + 1;
		if (codeNode(kZero, value == 0))
			return 0;
		const bool negative = codeNode(kSign, value < 0);
		const std::uint32_t magnitude =
		    negative ? 0u - static_cast<std::uint32_t>(value) : static_cast<std::uint32_t>(value);
		const int wanted = bitLength(magnitude);
		int length       = 1;
		while (length < DetailModels::kMaxLength && codeNode(kLength + length, length < wanted))
			++length;
		std::uint32_t out = 1;
		for (int i = length - 2; i >= 0; --i) {
			const bool bit = (magnitude >> i) & 1;
			bool read;
			if (i == length - 2)
				read = codeNode(kTop + length, bit);
			else if (i == length - 3)
				read = codeNode(kSecond + 2 * length + int(out & 1), bit);
			else
				read = coder_.bit(bit, 32768);
			out = (out << 1) | std::uint32_t(read);
		}
		return static_cast<std::int32_t>(negative ? 0u - out : out);
	}

	Coder& coder_;
	DetailModels& models_;
	const CornerTable& table_;
	const Refinement& refinement_;
	const std::vector<LatticePoint>& positions_;
	Context context_ {};
	Index centre_ = kNone;
	std::array<AdaptiveBit*, DetailModels::kInputs> rows_ {};
};

} // namespace wavemesh
