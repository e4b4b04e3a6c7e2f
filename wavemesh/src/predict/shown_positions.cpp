// SPDX-License-Identifier: GPL-3.0-or-later
#include "predict/shown_positions.h"

#include "mesh/integer_math.h"

#include <algorithm>
#include <optional>

namespace wavemesh {
namespace {

class Bulge
{
public:
	Bulge(const CornerTable& table, const std::vector<LatticePoint>& positions, int latticeBits) :
	        table_(table), positions_(positions),
	        normals_(vertexNormals(table, rounded(positions, latticeBits)))
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
	/// As precise as clampedCross() allows.
	static std::vector<LatticePoint> rounded(std::vector<LatticePoint> positions, int latticeBits)
	{
		for (LatticePoint& p : positions)
			for (std::int32_t& x : p)
				x >>= std::max(0, latticeBits - 16);
		return positions;
	}

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
	std::vector<LatticePoint> shown = likelyPositions(table, cells, shift, glue);
	if (parents.empty())
		return shown;
	const Bulge bulge(table, shown, latticeBits);
	const std::int64_t trust = bulge.trust(parents, std::max(0, latticeBits - 12));
	if (trust == 0)
		return shown;
	const std::vector<std::int64_t> heights = bulge.heights();
	if (heights.empty())
		return shown;
	const std::int64_t reach = 8 * ((std::int64_t(1) << shift) - 1);
	for (std::size_t v = 0; v < shown.size(); ++v) {
		if (glue.isShared(Index(v)))
			continue;
		const LatticePoint middle = middleOfCell(cells[v], shift);
		for (std::size_t k = 0; k < 3; ++k) {
			const std::int64_t further = (trust * heights[v] * bulge.normal(v)[k]) >> 22;
			shown[v][k]                = static_cast<std::int32_t>(
                middle[k] + std::clamp(shown[v][k] + further - middle[k], -reach, reach));
		}
	}
	return shown;
}

} // namespace wavemesh
