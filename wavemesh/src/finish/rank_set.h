// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A set of numbers below n that tells how many of its members lie below a number, and which member
/// has how many below it (a Fenwick tree: all in O(log n)).
#pragma once

#include "mesh/corner_table.h"

namespace wavemesh {

class RankSet
{
public:
	/// @param full  all numbers below n are members at first, or none
	RankSet(Index n, bool full) : n_(n), tree_(std::size_t(n) + 1, 0), member_(n, full)
	{
		if (!full)
			return;
		count_ = n;
		for (Index i = 1; i <= n; ++i)
			tree_[i] = i & (~i + 1); // a node counts as many numbers as its lowest bit says
	}

	Index size() const { return n_; }
	Index count() const { return count_; }
	bool has(Index x) const { return x < n_ && member_[x]; }

	/// @pre x is no member, or is one
	void insert(Index x) { change(x, true); }
	void erase(Index x) { change(x, false); }

	/// Members below x.
	Index below(Index x) const
	{
		Index sum = 0;
		for (Index i = x; i > 0; i &= i - 1)
			sum += tree_[i];
		return sum;
	}
	/// The member with `rank` members below it. @pre rank < count()
	Index at(Index rank) const
	{
		Index position = 0, step = 1;
		while (step <= n_ / 2)
			step *= 2;
		for (; step > 0; step /= 2)
			if (position + step <= n_ && tree_[position + step] <= rank) {
				position += step;
				rank -= tree_[position];
			}
		return position;
	}

private:
	void change(Index x, bool member)
	{
		member_[x] = member;
		count_ += member ? 1 : Index(0) - 1;
		for (Index i = x + 1; i <= n_; i += i & (~i + 1))
			tree_[i] += member ? 1 : Index(0) - 1;
	}

	Index n_, count_ = 0;
	std::vector<Index> tree_;
	std::vector<bool> member_;
};

} // namespace wavemesh
