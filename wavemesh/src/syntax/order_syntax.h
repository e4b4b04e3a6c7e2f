// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The original's order of faces and vertices, and each face's first corner, told along the
/// original's faces: which face comes next, most likely one close to the last ones; which of its
/// corners is the first; and the numbers of the vertices that are met for the first time.
#pragma once

#include "entropy/models.h"
#include "finish/element_order.h"
#include "finish/rank_set.h"
#include "stage.h"

#include <memory>

namespace wavemesh {

template <class Coder>
class OrderSyntax
{
public:
	/// @param faces   of the restored mesh
	/// @param finest  neighbours of the first of them
	OrderSyntax(Coder& coder, const Triangles& faces, Index vertices, const CornerTable& finest) :
	        coder_(coder), faces_(faces), finest_(finest), left_(Index(faces.size()), true),
	        front_(Index(faces.size()), false), slotOf_(faces.size(), kNone),
	        numbers_(vertices, true), number_(vertices, kNone), seenAt_(faces.size(), 0),
	        models_(std::make_unique<Models>())
	{
		last_.fill(kNone);
	}

	/// Reading, leaves what is not known where the data end. What was coded is of no use if
	/// `watch` stopped. O(log n) an element.
	void code(ElementOrder& order, Watch& watch)
	{
		const Index count = Index(faces_.size());
		wanted_           = std::move(order.vertex);
		order.face.resize(count);
		order.first.resize(count);
		for (Index i = 0; i < count && !coder_.exhausted() && watch.goesOn(i, count); ++i) {
			const Index f  = codeFace(order.face[i]);
			order.face[i]  = f;
			order.first[i] = codeFirst(f, order.first[i]);
			codeNumbers(f, order.first[i]);
			emit(f, order.first[i]);
		}
		for (Index v = 0; v < number_.size() && !coder_.exhausted() && !watch.stopped(); ++v)
			if (number_[v] == kNone)
				codeNumber(v, kNone, kNone, kNone, 3);
		order.vertex = std::move(number_);
	}

private:
	static constexpr std::size_t kAges    = 12; ///< so many faces told last are looked around
	static constexpr std::size_t kNear    = 9 * kAges; ///< slots for the faces there
	static constexpr std::size_t kNumbers = 15;        ///< slots for guesses of a number
	static constexpr std::size_t kPlaces  = 8;         ///< numbers known that it may be close to
	static constexpr int kLimit           = 30;

	enum Kind : std::uint8_t { kClose, kOnFront, kAnywhere };

	struct Models
	{
		std::array<std::array<std::array<AdaptiveBit, kNear + 1>, 9>, 2> kind; // close?, front?
		std::array<std::array<AdaptiveBit, kNear + 1>, kNear> slotAfter;
		std::array<std::array<AdaptiveBit, 512>, kNear> slotAmong;
		std::array<std::array<std::array<AdaptiveBit, 10>, kNear + 1>, kNear> slotAfterTwo;
		std::array<AdaptiveUnsigned<32>, 33> rank; // by length of the front's size
		std::array<AdaptiveSigned<32>, 33> jump;   // by length of the last jump
		std::array<std::array<AdaptiveBit, 8>, 2> firstByUse;
		std::array<std::array<std::array<AdaptiveBit, 8>, kNear + 1>, 2> firstByEdge;
		std::array<std::array<std::array<std::array<AdaptiveBit, 8>, 10>, kNear + 1>, 2> firstAfter;
		std::array<std::array<AdaptiveBit, 128>, 2> firstByNumber;
		std::array<std::array<AdaptiveBit, kNumbers + 1>, kNumbers> numberAfter;
		std::array<std::array<AdaptiveBit, 16>, kNumbers> numberAt;
		std::array<std::array<std::array<AdaptiveBit, 16>, kNear + 1>, kNumbers> numberWith;
		std::array<std::array<std::array<AdaptiveBit, kNumbers + 1>, kNumbers + 1>, kNumbers>
		    numberAfterTwo;
		std::array<std::array<AdaptiveBit, kPlaces>, kPlaces> place;
		std::array<std::array<AdaptiveSigned<32>, 8>, kPlaces>
		    step; // place, length of the last step
		Mixer<3> slotMixer {int(kNear)};
		Mixer<4> numberMixer {int(kNumbers)};
		Mixer<4> firstMixer {2};
	};

	// ---- which face ----------------------------------------------------------------------------

	Index across(Index corner) const
	{
		const Index d = corner / 3 < finest_.faceCount() ? finest_.opposite[corner] : kNone;
		return d == kNone ? kNone : d / 3;
	}

	/// Fills the slots: for each of the last faces, the youngest first, the faces across their
	/// edges, from their first corner on, then the two behind each of these.
	void findNear()
	{
		near_.fill(kNone);
		among_.fill(0);
		lastFilled_ = kNear;
		++told_;
		for (std::size_t age = 0; age < kAges; ++age)
			for (Index k = 0; k < 3 && last_[age] != kNone; ++k) {
				const Index corner = 3 * last_[age] + (lastFirst_[age] + k) % 3;
				const Index next   = across(corner);
				if (next == kNone)
					continue;
				const Index back = finest_.opposite[corner];
				fill(age, k, next);
				fill(age, 3 + 2 * k, across(nextCorner(back)));
				fill(age, 4 + 2 * k, across(prevCorner(back)));
			}
	}
	void fill(std::size_t age, std::size_t slot, Index f)
	{
		if (f == kNone || !left_.has(f) || seenAt_[f] == told_)
			return;
		seenAt_[f]            = told_;
		near_[9 * age + slot] = f;
		lastFilled_ = lastFilled_ == kNear ? 9 * age + slot : std::max(lastFilled_, 9 * age + slot);
		among_[age] |= 1u << slot;
	}

	Index codeFace(Index wanted)
	{
		Models& m = *models_;
		findNear();
		const std::size_t context = std::size_t(3 * kinds_[0] + kinds_[1]);
		const std::size_t slot =
		    std::size_t(std::find(near_.begin(), near_.end(), wanted) - near_.begin());
		kinds_[1] = kinds_[0];
		if (lastFilled_ != kNear &&
		    codeBit(coder_, m.kind[0][context][lastSlots_[0]], slot < kNear, kLimit)) {
			kinds_[0] = kClose;
			return codeSlot(slot);
		}
		const bool isOnFront = !Coder::kReading && slotOf_[wanted] != kNone;
		if (front_.count() != 0 &&
		    codeBit(coder_, m.kind[1][context][lastSlots_[0]], isOnFront, kLimit)) {
			kinds_[0] = kOnFront;
			addSlot(kNear);
			return codeRank(wanted);
		}
		kinds_[0] = kAnywhere;
		addSlot(kNear);
		return codeJump(wanted);
	}

	Index codeSlot(std::size_t wanted)
	{
		Models& m          = *models_;
		std::size_t result = kNear;
		for (std::size_t slot = 0; slot < kNear; ++slot) {
			if (near_[slot] == kNone)
				continue;
			result = slot;
			if (slot == lastFilled_) // needs no telling
				break;
			if (m.slotMixer.code(
			        coder_,
			        {&m.slotAfter[slot][lastSlots_[0]],
			         &m.slotAfterTwo[slot][lastSlots_[0]][placeOf(lastSlots_[1])],
			         &m.slotAmong[slot][among_[slot / 9]]},
			        int(slot), slot == wanted, kLimit))
				break;
		}
		addSlot(result);
		return near_[result];
	}
	/// Where around its face, 9 if there is none.
	static std::size_t placeOf(std::size_t slot) { return slot < kNear ? slot % 9 : 9; }
	void addSlot(std::size_t slot) { lastSlots_ = {slot, lastSlots_[0]}; }

	/// Faces with a neighbour that was told, the youngest first.
	Index codeRank(Index wanted)
	{
		const Index count = front_.count();
		Index rank        = 0;
		if constexpr (!Coder::kReading)
			rank = count - 1 - front_.below(slotOf_[wanted]);
		rank = Index(models_->rank[std::size_t(bitLength(count))].code(coder_, rank));
		return faceAt_[front_.at(count - 1 - std::min(rank, count - 1))];
	}

	Index codeJump(Index wanted)
	{
		const std::int64_t from = last_[0] == kNone ? 0 : left_.below(last_[0]);
		std::int64_t step       = 0;
		if constexpr (!Coder::kReading)
			step = std::int64_t(left_.below(wanted)) - from;
		step      = models_->jump[std::size_t(lastJump_)].code(coder_, step);
		lastJump_ = bitLength(std::uint64_t(step < 0 ? -step : step));
		return left_.at(
		    Index(std::clamp<std::int64_t>(from + step, 0, std::int64_t(left_.count()) - 1)));
	}

	void emit(Index f, std::uint8_t first)
	{
		left_.erase(f);
		if (slotOf_[f] != kNone)
			front_.erase(slotOf_[f]);
		for (Index c = 3 * f; c < 3 * f + 3; ++c) {
			const Index next = across(c);
			if (next == kNone || !left_.has(next) || slotOf_[next] != kNone)
				continue;
			slotOf_[next] = Index(faceAt_.size());
			faceAt_.push_back(next);
			front_.insert(slotOf_[next]);
		}
		std::copy_backward(last_.begin(), last_.end() - 1, last_.end());
		std::copy_backward(lastFirst_.begin(), lastFirst_.end() - 1, lastFirst_.end());
		last_[0]      = f;
		lastFirst_[0] = first;
	}

	// ---- which corner, which numbers -----------------------------------------------------------

	std::uint8_t codeFirst(Index f, std::uint8_t wanted)
	{
		Models& m = *models_;
		// The face that led here.
		const Index led = last_[lastSlots_[0] < kNear ? lastSlots_[0] / 9 : 0];
		std::array<bool, 3> used, shared;
		std::array<std::uint64_t, 3> number;
		for (std::size_t k = 0; k < 3; ++k) {
			const Index v = faces_[f][k];
			used[k]       = number_[v] != kNone;
			number[k]     = used[k] ? number_[v] : (std::uint64_t(1) << 32);
			shared[k]     = led != kNone && hasVertex(faces_[led], v);
		}
		const auto bits = [](bool x, bool y, bool z) {
			return (x ? 1u : 0u) + (y ? 2u : 0u) + (z ? 4u : 0u);
		};
		for (std::uint8_t turn = 0; turn < 2; ++turn) {
			const std::size_t a = turn, b = (turn + 1u) % 3, c = (turn + 2u) % 3;
			const std::size_t uses   = bits(used[a], used[b], used[c]);
			const std::size_t shares = bits(shared[a], shared[b], shared[c]);
			const std::size_t order =
			    bits(number[a] < number[b], number[b] < number[c], number[c] < number[a]);
			if (m.firstMixer.code(
			        coder_,
			        {&m.firstByUse[turn][uses], &m.firstByEdge[turn][lastSlots_[0]][shares],
			         &m.firstAfter[turn][lastSlots_[0]][placeOf(lastSlots_[1])][shares],
			         &m.firstByNumber[turn][order + 8 * uses]},
			        turn, turn == wanted, kLimit))
				return turn;
		}
		return 2;
	}

	static bool hasVertex(const std::array<Index, 3>& face, Index v)
	{
		return face[0] == v || face[1] == v || face[2] == v;
	}

	void codeNumbers(Index f, std::uint8_t first)
	{
		for (std::size_t k = 0; k < 3; ++k) {
			const auto at = [&](std::size_t i) { return faces_[f][(first + i) % 3]; };
			if (number_[at(k)] == kNone) {
				const Index before = at(k + 2), after = at(k + 1);
				codeNumber(
				    at(k), number_[before], number_[after],
				    numberAcross(3 * f + Index((first + k) % 3), before, after), k);
			}
		}
	}

	/// Number of the vertex across the edge from a to b that the corner faces.
	Index numberAcross(Index corner, Index a, Index b) const
	{
		const Index next = across(corner);
		if (next != kNone)
			for (const Index v : faces_[next])
				if (v != a && v != b)
					return number_[v];
		return kNone;
	}

	/// @param a, b    numbers of the vertices before and after it in the face, or kNone
	/// @param across  of the vertex behind these, or kNone
	/// @param corner  its place in the face; 3: it is in none
	void codeNumber(Index v, Index a, Index b, Index across, std::size_t corner)
	{
		Models& m        = *models_;
		const Index last = lastNumbers_[0];
		std::array<Index, kNumbers> guess;
		guess.fill(kNone);
		guess[0]  = numbers_.at(0);
		guess[1]  = last + 1;
		guess[2]  = last - 1;
		guess[3]  = last + 2;
		guess[4]  = last - 2;
		guess[8]  = last + (last - lastNumbers_[1]);
		guess[14] = lastNumbers_[1] + (lastNumbers_[1] - lastNumbers_[3]);
		if (a != kNone) {
			guess[6]  = a + offsetA_[corner];
			guess[13] = guess[6] + (offsetA_[corner] - lastOffsetA_[corner]);
			guess[9]  = a + 1;
			guess[10] = a - 1;
		}
		if (b != kNone) {
			guess[7]  = b + offsetB_[corner];
			guess[11] = b + 1;
			guess[12] = b - 1;
		}
		if (a != kNone && b != kNone && across != kNone)
			guess[5] = a + b - across;
		Index wanted = kNone;
		if constexpr (!Coder::kReading)
			wanted = wanted_[v];
		const std::size_t context = corner + 4 * ((a != kNone ? 1u : 0u) + (b != kNone ? 2u : 0u));
		std::size_t slot          = 0;
		for (; slot < kNumbers; ++slot) {
			const auto end = guess.begin() + std::ptrdiff_t(slot);
			if (!numbers_.has(guess[slot]) || std::find(guess.begin(), end, guess[slot]) != end)
				continue;
			if (m.numberMixer.code(
			        coder_,
			        {&m.numberAfter[slot][lastGuesses_[0]],
			         &m.numberAfterTwo[slot][lastGuesses_[0]][lastGuesses_[1]],
			         &m.numberAt[slot][context], &m.numberWith[slot][lastSlots_[0]][context]},
			        int(slot), guess[slot] == wanted, kLimit))
				break;
		}
		lastGuesses_  = {slot, lastGuesses_[0]};
		const Index n = slot < kNumbers
		                    ? guess[slot]
		                    : codeStep(
		                          wanted, {guess[6], guess[7], guess[5], a, b, lastNumbers_[0],
		                                   lastNumbers_[1], lastNumbers_[2]});
		if (a != kNone) {
			lastOffsetA_[corner] = offsetA_[corner];
			offsetA_[corner]     = n - a;
		}
		if (b != kNone)
			offsetB_[corner] = n - b;
		number_[v] = n;
		std::copy_backward(lastNumbers_.begin(), lastNumbers_.end() - 1, lastNumbers_.end());
		lastNumbers_[0] = n;
		numbers_.erase(n);
	}

	/// A number by the free numbers between it and one of `places`, mostly the nearest.
	Index codeStep(Index wanted, const std::array<Index, kPlaces>& places)
	{
		Models& m       = *models_;
		const auto rank = [&](Index n) {
			return std::int64_t(numbers_.below(std::min(n, numbers_.size())));
		};
		std::size_t chosen = kPlaces;
		std::int64_t step  = 0;
		if constexpr (!Coder::kReading) {
			for (std::size_t i = 0; i < kPlaces; ++i) {
				const std::int64_t d = rank(wanted) - rank(places[i]);
				if (places[i] != kNone && (chosen == kPlaces || std::abs(d) < std::abs(step) / 2)) {
					chosen = i;
					step   = d;
				}
			}
		}
		std::size_t place = 0;
		for (; place + 1 < kPlaces; ++place)
			if (places[place] != kNone &&
			    codeBit(coder_, m.place[place][lastPlace_], place == chosen, kLimit))
				break;
		lastPlace_              = place;
		const std::int64_t from = rank(places[place]);
		if constexpr (!Coder::kReading)
			step = rank(wanted) - from;
		step      = m.step[place][std::size_t(std::min(lastStep_, 7))].code(coder_, step);
		lastStep_ = bitLength(std::uint64_t(step < 0 ? -step : step));
		return numbers_.at(
		    Index(std::clamp<std::int64_t>(from + step, 0, std::int64_t(numbers_.count()) - 1)));
	}

	Coder& coder_;
	const Triangles& faces_;
	const CornerTable& finest_;
	RankSet left_;              ///< faces not told yet
	RankSet front_;             ///< of these, the slots of those next to one that is told
	std::vector<Index> slotOf_; ///< #F
	std::vector<Index> faceAt_; ///< by slot
	RankSet numbers_;           ///< that no vertex has yet
	std::vector<Index> number_; ///< #V
	std::vector<Index> wanted_; ///< writing: #V

	std::array<Index, kAges> last_; ///< faces, the youngest first
	std::array<std::uint8_t, kAges> lastFirst_ {};
	std::array<std::uint8_t, 2> kinds_ {kAnywhere, kAnywhere};
	std::array<Index, kNear> near_ {};     ///< by slot
	std::size_t lastFilled_ = kNear;       ///< the highest slot that is filled
	Index told_             = 0;           ///< faces so far
	std::vector<Index> seenAt_;            ///< #F: value of told_ when the face last got a slot
	std::array<unsigned, kAges> among_ {}; ///< which slots are filled
	std::array<std::size_t, 2> lastSlots_ {kNear, kNear};
	int lastJump_ = 0;
	std::array<Index, 5> lastNumbers_ {
	    Index(0) - 1, Index(0) - 2, Index(0) - 3, Index(0) - 4, Index(0) - 5};
	/// By corner: of the last number from those of its neighbours in the face.
	std::array<Index, 4> offsetA_ {}, offsetB_ {}, lastOffsetA_ {};
	std::array<std::size_t, 2> lastGuesses_ {kNumbers, kNumbers};
	std::size_t lastPlace_ = 0;
	int lastStep_          = 0;
	std::unique_ptr<Models> models_;
};

} // namespace wavemesh
