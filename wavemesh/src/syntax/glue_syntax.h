// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Which vertices of the base mesh are copies of earlier ones, coded as the base mesh grows: a copy
/// costs its reference, mostly to a neighbour of another copy of a vertex at the gate, and no
/// position.
#pragma once

#include "entropy/models.h"
#include "syntax/glue_neighbours.h"

#include <unordered_map>

namespace wavemesh {

template <class Coder>
class GlueSyntax
{
public:
	explicit GlueSyntax(Coder& coder) : coder_(coder) {}
	GlueSyntax(const GlueSyntax&)            = delete; // a part looks at another
	GlueSyntax& operator=(const GlueSyntax&) = delete;

	/// Writing: `group` tells for each vertex of the base as given which original it shares with
	/// others, kNone if with none.
	void write(const std::vector<Index>* group) { group_ = group; }

	/// Codes whether the vertex that comes next is a copy; @return the first one, kNone if it is
	/// none, or kNone with failed() if the file contradicts itself.
	/// @param source    writing: the vertex of the base as given
	/// @param from, to  known neighbours of the vertex, or kNone
	Index next(Index source, Index from, Index to)
	{
		const Index v = Index(glue_.first.size());
		Index first   = kNone;
		if constexpr (!Coder::kReading) {
			const Index id = (*group_)[source];
			if (id != kNone)
				first = firstOf_.emplace(id, v).first->second;
			if (first == v)
				first = kNone;
		}
		const std::size_t context = (isShared(from) ? 1u : 0u) + (isShared(to) ? 2u : 0u);
		if (codeBit(coder_, isCopy_[context], first != kNone, 60) && !coder_.exhausted())
			first = codeFirst(first, from, to);
		else
			first = kNone;
		glue_.first.push_back(first == kNone ? v : first);
		glue_.shared.push_back(first != kNone);
		if (first != kNone)
			glue_.shared[first] = 1;
		neighbours_.addVertex();
		return first;
	}
	bool failed() const { return failed_; }

	/// A face of the base mesh.
	void addFace(Index a, Index b, Index c)
	{
		const Index v[3] = {a, b, c};
		for (int k = 0; k < 3; ++k)
			for (int m = 1; m < 3; ++m)
				neighbours_.add(v[k], v[(k + m) % 3]);
	}

	Glue take() { return std::move(glue_); }

private:
	bool isShared(Index v) const { return v != kNone && glue_.shared[v] != 0; }

	Index codeFirst(Index first, Index from, Index to)
	{
		candidates_.clear();
		neighbours_.append(from, candidates_);
		neighbours_.append(to, candidates_);
		const std::size_t at = std::size_t(
		    std::find(candidates_.begin(), candidates_.end(), first) - candidates_.begin());
		for (std::size_t i = 0; i < candidates_.size(); ++i)
			if (codeBit(coder_, isThis_[i], i == at, 60))
				return candidates_[i];
		first = codeRaw(coder_, bitLength(glue_.first.size()), first);
		if (first < glue_.first.size() && glue_.first[first] == first)
			return first;
		failed_ = true;
		return kNone;
	}

	Coder& coder_;
	Glue glue_;
	bool failed_ = false;
	GlueNeighbours neighbours_ {glue_};
	std::vector<Index> candidates_;
	std::array<AdaptiveBit, 4> isCopy_;
	std::array<AdaptiveBit, GlueNeighbours::kCandidates> isThis_;

	// Writing only.
	const std::vector<Index>* group_ = nullptr;
	std::unordered_map<Index, Index> firstOf_; ///< original -> first vertex
};

} // namespace wavemesh
