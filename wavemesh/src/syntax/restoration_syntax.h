// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A Restoration as bits, both ways.
#pragma once

#include "finish/restoration.h"
#include "syntax/point_set_syntax.h"

namespace wavemesh {

template <class Coder>
class RestorationSyntax
{
public:
	/// @param glued  vertices of the restored mesh that are not isolated
	RestorationSyntax(Coder& coder, const CornerTable& finest, Index glued, int bits) :
	        coder_(coder), finest_(finest), glued_(glued), bits_(bits)
	{
	}

	/// @param vertices, faces  of the original
	/// @return Corrupt if the numbers contradict each other; reading, the caller checks for
	///         exhaustion first.
	/// @pre writing: r.isolated is in the order of PointSetSyntax
	Status code(Restoration& r, Index vertices, Index faces)
	{
		if (vertices < glued_ || faces < finest_.faceCount())
			return corrupt();
		codeTurned(r.turned);
		if (!codeCopies(r.copies, faces - finest_.faceCount()))
			return corrupt();
		points_.code(r.isolated, vertices - glued_, bits_);
		return codeDegenerate(r.degenerate, vertices) ? Status() : corrupt();
	}

private:
	static Status corrupt() { return {StatusCode::Corrupt, "the restoration contradicts itself"}; }

	/// Sums of a value over the faces next to f that come before it: how many there are, and how
	/// many of them have it.
	template <class Has>
	std::size_t neighbourhood(Index f, Has&& has) const
	{
		std::size_t with = 0, without = 0;
		for (Index c = 3 * f; c < 3 * f + 3; ++c) {
			const Index d = finest_.opposite[c];
			if (d != kNone && d / 3 < f)
				++(has(d / 3) ? with : without);
		}
		return 4 * with + without;
	}

	void codeTurned(std::vector<std::uint8_t>& turned)
	{
		const bool any =
		    codeBit(coder_, flag_[0], std::find(turned.begin(), turned.end(), 1) != turned.end());
		turned.resize(finest_.faceCount(), 0);
		for (Index f = 0; any && f < finest_.faceCount() && !coder_.exhausted(); ++f) {
			const std::size_t context = neighbourhood(f, [&](Index g) { return turned[g] != 0; });
			turned[f]                 = codeBit(coder_, turned_[context], turned[f] != 0);
		}
	}

	/// Sets left_ to the number of faces that are no copies.
	bool codeCopies(std::vector<Restoration::Copies>& copies, Index most)
	{
		left_ = most;
		if (!codeBit(coder_, flag_[1], !copies.empty()))
			return true;
		copies.resize(finest_.faceCount());
		const auto has = [&](Index g) { return copies[g].same + copies[g].turned != 0; };
		for (Index f = 0; f < finest_.faceCount() && !coder_.exhausted(); ++f) {
			auto& c = copies[f];
			if (!codeBit(coder_, hasCopies_[neighbourhood(f, has)], has(f)))
				continue;
			const std::uint64_t all =
			    1 + copies_.code(coder_, std::uint64_t(c.same) + c.turned - 1);
			const std::uint64_t turned = turnedCopies_.code(coder_, c.turned);
			if (all > left_ || turned > all)
				return coder_.exhausted();
			c = {Index(all - turned), Index(turned)};
			left_ -= Index(all);
		}
		return true;
	}

	bool codeDegenerate(std::vector<std::array<Index, 2>>& faces, Index vertices)
	{
		Index last = 0;
		for (Index i = 0; i < left_ && !coder_.exhausted(); ++i) {
			std::array<Index, 2> f {};
			if constexpr (!Coder::kReading)
				f = faces[i];
			const std::int64_t twice = last + step_.code(coder_, std::int64_t(f[0]) - last);
			const std::int64_t once  = twice + other_.code(coder_, std::int64_t(f[1]) - twice);
			if (twice < 0 || twice >= vertices || once < 0 || once >= vertices)
				return coder_.exhausted();
			last = Index(twice);
			if constexpr (Coder::kReading)
				faces.push_back({Index(twice), Index(once)});
		}
		return true;
	}

	Coder& coder_;
	const CornerTable& finest_;
	Index glued_;
	int bits_;
	Index left_ = 0;
	std::array<AdaptiveBit, 2> flag_;
	std::array<AdaptiveBit, 16> turned_, hasCopies_;
	AdaptiveUnsigned<32> copies_, turnedCopies_;
	AdaptiveSigned<32> step_, other_;
	PointSetSyntax<Coder> points_ {coder_};
};

} // namespace wavemesh
