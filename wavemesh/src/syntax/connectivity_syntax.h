// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// D1, D2 and D3 of one split (paper sec. IV), written and read by the same template. Contexts are
/// what both sides know: the parent level, whole, and the decisions already made.
#pragma once

#include "mesh/integer_math.h"
#include "multires/refine.h"
#include "syntax/connectivity_models.h"
#include "syntax/valence_forecast.h"

#include <optional>

namespace wavemesh {

/// Codes the refinement of one parent level.
///
/// Writing: `refinement` is whole and canonical. Reading: it is filled; new vertices are numbered
/// edge by edge in the order of the corners, then face by face.
template <class Coder>
class ConnectivitySyntax
{
public:
	ConnectivitySyntax(
	    Coder& coder,
	    ConnectivityModels& models,
	    const CornerTable& parent,
	    const std::vector<LatticePoint>& positions) :
	        coder_(coder),
	        models_(models), parent_(parent), positions_(positions), valence_(valences(parent)),
	        length_(parent.cornerCount()), known_(parent.cornerCount(), kUnknown),
	        splitsAt_(parent.vertexCount, 0), wholesAt_(parent.vertexCount, 0)
	{
		for (Index f = 0; f < parent.cornerCount(); f += 3)
			for (Index k = 0; k < 3; ++k) {
				const Index d = parent.opposite[f + k];
				length_[f + k] =
				    d < f + k
				        ? length_[d]
				        : std::uint8_t(lengthOf(
				              parent.vertex[f + (k + 1) % 3], parent.vertex[f + (k + 2) % 3]));
			}
		if (models.contexts == Contexts::Rich)
			lengths_.emplace(parent, length_, valence_, models.splitLengths);
	}

	void code(Refinement& r)
	{
		if constexpr (Coder::kReading) {
			r                = {};
			r.parentVertices = r.childVertices = parent_.vertexCount;
			r.childOnEdge.assign(parent_.cornerCount(), kNone);
			r.faceCode.assign(parent_.faceCount(), kFaceNone);
		}
		codeSplits(r);
		codeFaces(r);
	}

private:
	enum Known : std::uint8_t { kUnknown, kWhole, kSplit };

	Index next(Index c) const { return parent_.vertex[nextCorner(c)]; }
	Index prev(Index c) const { return parent_.vertex[prevCorner(c)]; }
	const LatticePoint& at(Index v) const { return positions_[v]; }
	int lengthOf(Index a, Index b) const { return log2Quarters(squaredDistance(at(a), at(b))); }

	static int clampTo(int x, int low, int high) { return std::clamp(x, low, high) - low; }
	int valenceClass(Index v) const
	{
		const Index valence = valence_[v];
		return valence < 8 ? static_cast<int>(std::max(valence, Index {3}) - 3) : 5;
	}
	/// Class of a difference of log2Quarters() of squared lengths, 0..kLengths-1.
	static int ratioClass(int quarters) { return clampTo(quarters >> 1, -5, 6); }

	/// What is known of the other two edges of corner c's face: 0..5, 6 without a face.
	int faceState(Index c) const
	{
		if (c == kNone)
			return 6;
		constexpr std::uint8_t kStates[3][3] = {{0, 1, 3}, {1, 2, 4}, {3, 4, 5}};
		return kStates[known_[nextCorner(c)]][known_[prevCorner(c)]];
	}

	void codeSplits(Refinement& r)
	{
		for (Index c = 0; c < parent_.cornerCount(); ++c) {
			const Index d = parent_.opposite[c];
			if (d != kNone && d < c)
				continue;
			const bool split = codeSplit(c, d, r.childOnEdge[c] != kNone);
			if (coder_.exhausted())
				return;
			if constexpr (Coder::kReading)
				if (split) {
					r.childOnEdge[c] = r.childVertices++;
					if (d != kNone)
						r.childOnEdge[d] = r.childOnEdge[c];
				}
		}
	}

	/// What both sets of contexts know of an edge, the same from either side.
	struct Edge
	{
		Index corner;
		int states; ///< of the two faces, 0..48
		int left, right;
		int ratio; ///< length against the edges around
		std::size_t byFaces, byValences, byEnds;
	};

	Edge describe(Index c, Index d) const
	{
		const Index a = next(c), b = prev(c);
		int left = faceState(c), right = faceState(d);
		// Mean of the edges around, in quarters of an octave of squared length.
		int around      = length_[nextCorner(c)] + length_[prevCorner(c)];
		around          = d == kNone ? around / 2
		                             : (around + length_[nextCorner(d)] + length_[prevCorner(d)]) / 4;
		const int ratio = ratioClass(length_[c] - around);

		int va = valenceClass(a), vb = valenceClass(b), vl = valenceClass(parent_.vertex[c]);
		int vo = d == kNone ? 0 : valenceClass(parent_.vertex[d]);
		if (left > right)
			std::swap(left, right);
		if (va > vb)
			std::swap(va, vb);
		if (vl > vo)
			std::swap(vl, vo);
		int ea = endState(a), eb = endState(b);
		if (ea > eb)
			std::swap(ea, eb);
		const int states = left * 7 + right;
		return {
		    c,
		    states,
		    left,
		    right,
		    ratio,
		    index((states * 5 + std::min(vl, 4)) * 5 + std::min(vo, 4)),
		    index(((va * 6 + vb) * 6 + vl) * 6 + vo),
		    index((ea * 16 + eb) * 3 + (left >= 3) + (right >= 3))};
	}

	bool codeSplit(Index c, Index d, bool split)
	{
		const Edge edge = describe(c, d);
		split           = lengths_ ? codeRich(edge, split) : codeFast(edge, d, split);
		known_[c]       = split ? kSplit : kWhole;
		if (d != kNone)
			known_[d] = known_[c];
		for (const Index v : {next(c), prev(c)}) {
			std::uint8_t& count = split ? splitsAt_[v] : wholesAt_[v];
			if (count < 3)
				++count;
		}
		return split;
	}

	bool codeFast(const Edge& e, Index d, bool split)
	{
		// How far the far vertices are apart, against the edge: high for narrow pairs of faces.
		const int across      = d == kNone ? 0
		                                   : ratioClass(
		                                         lengthOf(parent_.vertex[e.corner], parent_.vertex[d]) -
		                                         length_[e.corner] - 4);
		ConnectivityModels& m = models_;
		return m.splitMixer.code(
		    coder_,
		    {&m.splitByFaces[e.byFaces], &m.splitByLength[index(e.ratio * 49 + e.states)],
		     &m.splitByValences[e.byValences], &m.splitByEnds[e.byEnds],
		     &m.splitByShape[index(
		         (e.ratio * 12 + across) * 9 + (e.left / 2 % 3) * 3 + e.right / 2 % 3)]},
		    e.states, split, 255);
	}

	bool codeRich(const Edge& e, bool split)
	{
		const SplitContexts::Classes l = lengths_->classesOf(e.corner, known_);
		ConnectivityModels& m          = models_;
		split                          = m.splitPairMixer.code(
		                             coder_,
		                             {&m.splitByFaces[e.byFaces], &m.splitByValences[e.byValences], &m.splitByEnds[e.byEnds],
		                              &m.splitByGlobal[index(l.global * 49 + e.states)],
		                              &m.splitByLocal[index(l.local * 49 + e.states)],
		                              &m.splitByBoth[index(l.global * SplitContexts::kLocal + l.local)],
		                              &m.splitByExcess[index(l.excess * 12 + e.ratio)],
		                              &m.splitByOuter[index(l.outer * SplitContexts::kExcess + l.excess)]},
		                             e.states, split, 180);
		lengths_->learn(e.corner, split);
		return split;
	}

	int endState(Index v) const { return splitsAt_[v] * 4 + wholesAt_[v]; }

	void codeFaces(Refinement& r)
	{
		r.hasCentres = codeBit(coder_, models_.hasCentres, r.hasCentres);
		std::vector<std::uint8_t> flipped(parent_.faceCount(), 0);
		if (models_.contexts == Contexts::Rich)
			forecast_.emplace(parent_, valence_, r);
		for (Index f = 0; f < parent_.faceCount() && !coder_.exhausted(); ++f) {
			const FaceShape shape = faceShape(r.childOnEdge, f);
			FaceCode& code        = r.faceCode[f];
			if (shape.splits == 2)
				codeDiagonal(shape.corner, code);
			else if (shape.splits == 1)
				codeFlip(r, shape.corner, flipped, code);
		}
		if (!r.hasCentres)
			return;
		for (Index f = 0; f < parent_.faceCount() && !coder_.exhausted(); ++f)
			if (faceShape(r.childOnEdge, f).splits == 0 && !flipped[f]) {
				const bool centre = codeBit(coder_, models_.centre, r.faceCode[f] == kFaceCentre);
				if constexpr (Coder::kReading)
					if (centre) {
						r.faceCode[f] = kFaceCentre;
						++r.childVertices;
					}
			}
	}

	/// D2. Corner 0 faces the edge that is not split; diagonal from the middle of 0-1 to 2, or from
	/// the middle of 0-2 to 1.
	void codeDiagonal(Index corner, FaceCode& code)
	{
		const Index v0 = parent_.vertex[corner], v1 = next(corner), v2 = prev(corner);
		const int d2 = log2Quarters(distanceToMiddle(v2, v0, v1));
		const int d1 = log2Quarters(distanceToMiddle(v1, v0, v2));
		const int c1 = valenceClass(v1), c2 = valenceClass(v2);
		const int difference =
		    clampTo(static_cast<int>(valence_[v1]) - static_cast<int>(valence_[v2]), -2, 2);
		const bool one = models_.diagonalMixer.code(
		    coder_,
		    {&models_.diagonalByValences[index((difference * 5 + std::min((c1 + c2) / 2, 4)) * 3)],
		     &models_.diagonalByLength[index(ratioClass(d2 - d1))]},
		    0, code == kFaceDiagonal1, 255);
		code = one ? kFaceDiagonal1 : kFaceNone;
		if (forecast_)
			forecast_->diagonal(corner, one);
	}
	/// Four times the squared distance from v to the middle of a and b.
	std::uint64_t distanceToMiddle(Index v, Index a, Index b) const
	{
		LatticePoint twice, sum;
		for (std::size_t k = 0; k < 3; ++k) {
			twice[k] = wrappingAdd(at(v)[k], at(v)[k]);
			sum[k]   = wrappingAdd(at(a)[k], at(b)[k]);
		}
		return squaredDistance(twice, sum);
	}

	/// D3: is an edge flipped, and which. Faces that take part in a flip already say nothing.
	void
	codeFlip(const Refinement& r, Index corner, std::vector<std::uint8_t>& flipped, FaceCode& code)
	{
		const Index c1 = nextCorner(corner), c2 = prevCorner(corner);
		const bool can1 = canFlip(parent_, r, flipped, c1), can2 = canFlip(parent_, r, flipped, c2);
		if (!can1 && !can2)
			return;
		const int gain1 = can1 ? flipGain(corner, c1) : 0;
		const int gain2 = can2 ? flipGain(corner, c2) : 0;
		const int high = std::max(gain1, gain2), low = std::min(gain1, gain2);
		const std::size_t byLength     = index(high * 12 + low);
		const std::size_t byNeighbours = index(
		    (partner(r, c1, can1) * 3 + partner(r, c2, can2)) * 5 +
		    std::min(valenceClass(parent_.vertex[corner]), 4));
		ConnectivityModels& m = models_;
		bool flip             = code != kFaceNone;
		if (forecast_) {
			const int gain = std::max(
			    can1 ? flipGainClass(corner, c1) : 0, can2 ? flipGainClass(corner, c2) : 0);
			const int child = clampTo(forecast_->of(r.childOnEdge[corner]), 8, 15);
			const int apex  = clampTo(forecast_->of(parent_.vertex[corner]), 8, 20);
			flip            = m.richFlipMixer.code(
			               coder_,
			               {&m.flipByLength[byLength], &m.flipByNeighbours[byNeighbours],
			                &m.flipByValences[index(child * 13 + apex)],
			                &m.flipByGain[index(high * ConnectivityModels::kFlipGains + gain)]},
			               0, flip, 255);
		}
		else
			flip = m.flipMixer.code(
			    coder_, {&m.flipByLength[byLength], &m.flipByNeighbours[byNeighbours]}, 0, flip,
			    255);
		if (!flip)
			return;
		bool second = !can1;
		if (can1 && can2)
			second = codeBit(
			    coder_, models_.flipSide[index(ratioClass(gain2 - gain1) * 3)], code == kFaceFlip2);
		code                                = second ? kFaceFlip2 : kFaceFlip1;
		const Index edge                    = second ? c2 : c1;
		flipped[edge / 3]                   = 1;
		flipped[parent_.opposite[edge] / 3] = 1;
		if (forecast_)
			forecast_->flip(corner, edge);
	}
	int flipGainClass(Index corner, Index edge) const
	{
		return 1 + clampTo(forecast_->flipGain(corner, edge) >> 1, -4, 7);
	}
	int partner(const Refinement& r, Index edge, bool can) const
	{
		return can ? 1 + faceShape(r.childOnEdge, parent_.opposite[edge] / 3).splits : 0;
	}
	/// How much shorter the flipped edge is: class of the ratio of the edge to what replaces it,
	/// taken to the far vertex behind (the place of a child there is not known yet).
	int flipGain(Index corner, Index edge) const
	{
		const Index across = parent_.opposite[edge];
		const int own      = length_[edge] + 8; // four times the square, below too
		return ratioClass(
		    own -
		    log2Quarters(distanceToMiddle(parent_.vertex[across], next(corner), prev(corner))));
	}

	static std::size_t index(int i) { return static_cast<std::size_t>(i); }

	Coder& coder_;
	ConnectivityModels& models_;
	const CornerTable& parent_;
	const std::vector<LatticePoint>& positions_;
	std::vector<Index> valence_;
	std::vector<std::uint8_t> length_;              ///< #corners: lengthOf() the edge it faces
	std::vector<Known> known_;                      ///< #corners
	std::vector<std::uint8_t> splitsAt_, wholesAt_; ///< #V: known edges, at most 3

	// Rich contexts only.
	std::optional<SplitContexts> lengths_;
	std::optional<ValenceForecast> forecast_;
};

} // namespace wavemesh
