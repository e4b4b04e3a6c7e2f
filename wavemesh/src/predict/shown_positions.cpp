// SPDX-License-Identifier: GPL-3.0-or-later
#include "predict/shown_positions.h"

#include "mesh/integer_math.h"

#include <algorithm>
#include <optional>

namespace wavemesh {
namespace {

/// Normals as precise as clampedCross() allows.
std::vector<UnitVector>
normalsAt(const CornerTable& table, std::vector<LatticePoint> positions, int latticeBits)
{
	for (LatticePoint& p : positions)
		for (std::int32_t& x : p)
			x >>= std::max(0, latticeBits - 16);
	return vertexNormals(table, positions);
}

/// The vertices of a level, each somewhere in its cell.
class InCells
{
public:
	InCells(const std::vector<LatticePoint>& cells, int shift, const Glue& glue) :
	        cells_(cells), shift_(shift), glue_(glue), positions_(middlesOfCells(cells, shift))
	{
	}

	const std::vector<LatticePoint>& positions() const { return positions_; }

	/// Moves a vertex along its normal; one that lies at the same place as others stays.
	/// @param way       in 1/16 of a lattice unit, times 2^fraction / 16384
	void move(std::size_t v, std::int64_t way, int fraction, const UnitVector& n)
	{
		if (glue_.isShared(Index(v)))
			return;
		const LatticePoint middle = middleOfCell(cells_[v], shift_);
		for (std::size_t k = 0; k < 3; ++k) {
			const std::int64_t off = positions_[v][k] - middle[k] + ((way * n[k]) >> fraction);
			positions_[v][k] =
			    static_cast<std::int32_t>(middle[k] + std::clamp(off, -reach(), reach()));
		}
	}

	/// From the middle of a cell to its outermost parts.
	std::int64_t reach() const { return 8 * ((std::int64_t(1) << shift_) - 1); }
	int shift() const { return shift_; }

private:
	const std::vector<LatticePoint>& cells_;
	int shift_;
	const Glue& glue_;
	std::vector<LatticePoint> positions_; ///< 1/16 of a lattice unit
};

/// Moves all vertices along their normals towards where the surface is smoothest: that many
/// quarters of the way where it is short, hardly at all where it is long, since then it is the
/// shape that bends. What is short: the more vertices have a way within their cells, the more.
void smooth(InCells& level, const CornerTable& table, int latticeBits, int quarters)
{
	const std::vector<UnitVector> normals = normalsAt(table, level.positions(), latticeBits);
	const std::vector<LatticePoint> second =
	    laplacians(table, laplacians(table, level.positions()));
	const int scale          = std::max(0, level.shift() - 8); // products stay below 2^63
	const std::int64_t reach = level.reach() >> scale;
	std::vector<std::int64_t> ways(second.size());
	for (std::size_t v = 0; v < ways.size(); ++v) {
		const Vector bend {
		    -std::int64_t(second[v][0]), -std::int64_t(second[v][1]), -std::int64_t(second[v][2])};
		ways[v] = along(bend, normals[v]) >> scale;
	}
	const std::int64_t within = std::count_if(
	    ways.begin(), ways.end(), [&](std::int64_t way) { return std::abs(way) < reach; });
	const std::int64_t beyond = std::int64_t(ways.size()) - within;
	const std::int64_t odds   = std::min<std::int64_t>(44, 16 * within / (beyond + 1));
	const std::int64_t square =
	    std::max<std::int64_t>(1, (5 * odds * odds * odds * reach * reach) >> 12);
	for (std::size_t v = 0; v < ways.size(); ++v) {
		const std::int64_t way = square * ways[v] / (square + ways[v] * ways[v]);
		level.move(v, quarters * way * (1 << scale), 16, normals[v]);
	}
}

class Bulge
{
public:
	Bulge(const CornerTable& table, const std::vector<LatticePoint>& positions, int latticeBits) :
	        table_(table), positions_(positions), normals_(normalsAt(table, positions, latticeBits))
	{
	}

	/// How far a surface with the normals of two vertices stands above the middle between them: an
	/// eighth of what the normals differ along the way. Nothing where that is steeper than a smooth
	/// surface would be, as across an edge of the shape.
	std::optional<std::int64_t> overMiddle(Index u, Index v) const
	{
		std::int64_t product = 0, square = 0;
		for (std::size_t k = 0; k < 3; ++k) {
			const std::int64_t way = std::int64_t(positions_[v][k]) - positions_[u][k];
			product += way * (normals_[v][k] - normals_[u][k]);
			square += way * way;
		}
		const std::int64_t height = product >> 17;
		if (height * height > square >> 7)
			return {};
		return height;
	}

	/// How much of such heights is true of vertices whose parents are known, 0..256: nothing if not
	/// more than half of it.
	/// @param scale  so many bits less make heights smaller than 2^15, and sums of products than
	///               2^63
	std::int64_t trust(const Parents& parents, int scale) const
	{
		std::int64_t agreed = 0, all = 0;
		std::size_t child = table_.vertexCount - parents.size();
		for (const auto& p : parents) {
			const std::size_t v = child++;
			if (p[2] != kNone) // the centre of a face
				continue;
			std::int64_t height = 0;
			for (std::size_t k = 0; k < 3; ++k)
				height += (2 * std::int64_t(positions_[v][k]) - positions_[p[0]][k] -
				           positions_[p[1]][k]) *
				          (normals_[p[0]][k] + normals_[p[1]][k]);
			const std::int64_t guess = overMiddle(p[0], p[1]).value_or(0) >> scale;
			agreed += (height >> (16 + scale)) * guess;
			all += guess * guess;
		}
		const std::int64_t more = 2 * agreed - all;
		if (more <= 0)
			return 0;
		const int shift = std::max(0, bitLength(static_cast<std::uint64_t>(all)) - 40);
		return std::min<std::int64_t>(256, 256 * (more >> shift) / (all >> shift));
	}

	/// Mean over the edges around a vertex, each counted once for each face shared. #V; empty for a
	/// shape of planes and edges: more than a quarter of its edges are steep.
	std::vector<std::int64_t> heights() const
	{
		std::vector<std::int64_t> sums(table_.vertexCount, 0), counts(table_.vertexCount, 0);
		std::int64_t steep = 0;
		for (Index c = 0; c < table_.cornerCount(); ++c) {
			const Index u = table_.vertex[c], v = table_.vertex[nextCorner(c)];
			const auto height = overMiddle(u, v);
			steep += !height;
			for (const Index end : {u, v}) {
				sums[end] += height.value_or(0);
				++counts[end];
			}
		}
		if (4 * steep > std::int64_t(table_.cornerCount()))
			return {};
		for (std::size_t v = 0; v < sums.size(); ++v)
			sums[v] /= std::max<std::int64_t>(1, counts[v]);
		return sums;
	}

	const UnitVector& normal(std::size_t v) const { return normals_[v]; }

private:
	const CornerTable& table_;
	const std::vector<LatticePoint>& positions_;
	const std::vector<UnitVector> normals_;
};

} // namespace

std::vector<LatticePoint> shownPositions(
    const CornerTable& table,
    const Parents& parents,
    const std::vector<LatticePoint>& cells,
    int shift,
    int latticeBits,
    const Glue& glue)
{
	InCells shown(cells, shift, glue);
	if (parents.empty()) {
		smooth(shown, table, latticeBits, 3);
		smooth(shown, table, latticeBits, 3);
		return shown.positions();
	}
	smooth(shown, table, latticeBits, 2);
	const Bulge bulge(table, shown.positions(), latticeBits);
	const std::int64_t trust = bulge.trust(parents, std::max(0, latticeBits - 12));
	if (trust == 0)
		return shown.positions();
	const std::vector<std::int64_t> heights = bulge.heights();
	for (std::size_t v = 0; v < heights.size(); ++v)
		shown.move(v, trust * heights[v], 22, bulge.normal(v));
	return shown.positions();
}

} // namespace wavemesh
