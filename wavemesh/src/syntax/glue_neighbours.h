// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What lies around the copies of a vertex while the base mesh grows: the originals that a new copy
/// most likely is of (docs/wmc_format.md, 12.2).
///
/// The candidates next to a copy are the originals around all *other* copies, by copy, then by
/// place, each once. An original that is around several copies is listed by the first of them, or
/// by the second where the first is the copy itself; so two places of each original are enough, and
/// of these the first few.
#pragma once

#include "mesh/glue.h"

#include <array>
#include <vector>

namespace wavemesh {

class GlueNeighbours
{
public:
	static constexpr std::size_t kAround     = 24; ///< neighbours of a copy that are looked at
	static constexpr std::size_t kCandidates = 32;

	/// @param glue  of the vertices so far; must stay
	explicit GlueNeighbours(const Glue& glue) : glue_(glue) {}

	/// After the next vertex came to the glue.
	void addVertex()
	{
		const Index v = Index(around_.size()), first = glue_.first[v];
		around_.emplace_back();
		seen_.emplace_back();
		if (first != v && seen_[first].empty())
			for (std::size_t i = 0; i < around_[first].size(); ++i)
				see(first, i);
	}

	/// `to` is next to v in a face.
	void add(Index v, Index to)
	{
		if (around_[v].size() == kAround)
			return;
		around_[v].push_back(glue_.first[to]);
		if (glue_.isShared(v))
			see(v, around_[v].size() - 1);
	}

	/// Appends the candidates next to v, if it is shared, to what is not yet in `list`; up to
	/// kCandidates in all. O(1).
	void append(Index v, std::vector<Index>& list) const
	{
		if (v == kNone || !glue_.isShared(v))
			return;
		for (const Seen& s : seen_[glue_.first[v]])
			if (s.copy != v && list.size() < kCandidates &&
			    std::find(list.begin(), list.end(), s.original) == list.end())
				list.push_back(s.original);
	}

private:
	struct Seen
	{
		Index copy, original;
		std::uint32_t place; ///< around the copy

		bool operator<(const Seen& b) const
		{
			return copy != b.copy ? copy < b.copy : place < b.place;
		}
	};
	/// All around one copy may be what is not wanted, and of the rest each be there twice.
	static constexpr std::size_t kKept = kAround + 2 * kCandidates;

	/// Keeps an original around a copy if it is one of the first.
	void see(Index copy, std::size_t place)
	{
		const Seen fresh {copy, around_[copy][place], std::uint32_t(place)};
		std::vector<Seen>& all = seen_[glue_.first[copy]];
		int times              = 0;
		auto last              = all.end();
		for (auto s = all.begin(); s != all.end(); ++s)
			if (s->original == fresh.original) {
				if (s->copy == copy)
					return;
				++times;
				last = s;
			}
		if (times == 2) {
			if (*last < fresh)
				return;
			all.erase(last);
		}
		else if (all.size() == kKept) {
			if (all.back() < fresh)
				return;
			all.pop_back();
		}
		all.insert(std::upper_bound(all.begin(), all.end(), fresh), fresh);
	}

	const Glue& glue_;
	std::vector<std::vector<Index>> around_; ///< #V: originals, the first few
	std::vector<std::vector<Seen>> seen_;    ///< #V: by the first copy, in order; if shared
};

} // namespace wavemesh
