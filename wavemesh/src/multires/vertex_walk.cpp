// SPDX-License-Identifier: GPL-3.0-or-later
#include "multires/vertex_walk.h"

namespace wavemesh {
namespace {

class Walk
{
public:
	explicit Walk(const CornerTable& table) :
	        table_(table), seen_(table.vertexCount, 0), visited_(table.faceCount(), 0)
	{
		order_.reserve(table.vertexCount);
		waiting_.reserve(table.faceCount());
	}

	std::vector<Index> run()
	{
		for (Index f = 0; f < table_.faceCount(); ++f) {
			if (visited_[f])
				continue;
			visited_[f] = 1;
			for (Index c = 3 * f; c < 3 * f + 3; ++c) {
				see(table_.vertex[c]);
				waiting_.push_back(c);
			}
			component();
		}
		return std::move(order_);
	}

private:
	void see(Index v)
	{
		if (!seen_[v]) {
			seen_[v] = 1;
			order_.push_back(v);
		}
	}

	/// Across the edges that wait, until none does.
	void component()
	{
		while (!ready_.empty() || next_ < waiting_.size()) {
			Index corner;
			if (!ready_.empty()) {
				corner = ready_.back();
				ready_.pop_back();
			}
			else
				corner = waiting_[next_++];
			const Index across = table_.opposite[corner];
			if (across == kNone || visited_[across / 3])
				continue;
			visited_[across / 3] = 1;
			see(table_.vertex[across]);
			meet(nextCorner(across));
			meet(prevCorner(across));
		}
	}

	void meet(Index corner)
	{
		const Index across = table_.opposite[corner];
		if (across == kNone || visited_[across / 3])
			return;
		(seen_[table_.vertex[across]] ? ready_ : waiting_).push_back(corner);
	}

	const CornerTable& table_;
	std::vector<std::uint8_t> seen_, visited_;
	std::vector<Index> order_;
	std::vector<Index> ready_;   ///< corners facing an edge; the vertex behind is known
	std::vector<Index> waiting_; ///< the vertex behind was not known when the edge was met
	std::size_t next_ = 0;       ///< of waiting_
};

} // namespace

std::vector<Index> vertexWalk(const CornerTable& table)
{
	return Walk(table).run();
}

} // namespace wavemesh
