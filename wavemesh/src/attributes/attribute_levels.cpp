// SPDX-License-Identifier: GPL-3.0-or-later
#include "attributes/attribute_levels.h"

#include "container/byte_io.h"

#include <algorithm>
#include <numeric>

namespace wavemesh {
namespace {

/// For each corner of the restored mesh the original's.
std::vector<Index> cornersOf(const RestoredSource& source, const ElementOrder& order)
{
	std::vector<Index> corners(3 * source.face.size());
	for (Index f = 0; f < source.face.size(); ++f)
		for (Index k = 0; k < 3; ++k)
			corners[3 * f + (order.first[source.face[f]] + k) % 3] = 3 * source.face[f] + k;
	return corners;
}

} // namespace

AttributeRows::AttributeRows(const MeshData& mesh)
{
	for (const Attribute& a : mesh.attributes) {
		channels.push_back(makeChannel(a));
		tables.push_back(toRows(channels.back(), a.values));
	}
}

bool AttributeRows::same(AttributeOf of, Index a, Index b) const
{
	for (std::size_t i = 0; i < channels.size(); ++i) {
		const std::size_t width = channels[i].width();
		if (channels[i].of == of && channels[i].inLevels() &&
		    std::memcmp(
		        tables[i].data() + a * width, tables[i].data() + b * width,
		        width * sizeof(double)) != 0)
			return false;
	}
	return true;
}

namespace {

/// Calls back with the lower corner of each inner edge, and whether the corners at its ends are the
/// same on both sides. @param row  for each corner
template <class Each>
void forEachEdge(
    const AttributeRows& rows, const CornerTable& table, const std::vector<Index>& row, Each each)
{
	for (Index c = 0; c < table.cornerCount(); ++c) {
		const Index d = table.opposite[c];
		if (d != kNone && c < d)
			each(
			    c, rows.same(AttributeOf::Corner, row[nextCorner(c)], row[prevCorner(d)]) &&
			           rows.same(AttributeOf::Corner, row[prevCorner(c)], row[nextCorner(d)]));
	}
}

} // namespace

Seams AttributeRows::seams(const MeshData& mesh, const ManifoldCut& cut) const
{
	const CornerTable& table = cut.table;
	std::vector<Index> row(table.cornerCount());
	for (Index c = 0; c < table.cornerCount(); ++c) {
		const auto& t = mesh.triangles[cut.face[c / 3]];
		const auto at = std::find(t.begin(), t.end(), cut.vertex[table.vertex[c]]);
		row[c]        = 3 * cut.face[c / 3] + Index(at - t.begin());
	}
	std::vector<std::uint8_t> onSeam(table.cornerCount(), 0);
	forEachEdge(*this, table, row, [&](Index c, bool same) {
		onSeam[c] = onSeam[table.opposite[c]] = !same;
	});
	return Seams(table, onSeam);
}

AttributeLevels::AttributeLevels(
    const AttributeRows& from,
    const MeshData& original,
    const QuantisedMesh& mesh,
    const Levels& levels) :
        from_(from)
{
	const CornerTable& finest     = levels.replay.finest;
	const RestoredNumbers numbers = restoredNumbers(levels.glue, finest.vertexCount);
	knownVertices_                = numbers.count;
	RestoredSource source;
	const Restoration r = whatToRestore(
	    mesh.cut, original, mesh.lattice, finest, levels.replay.source, numbers, source);
	restored_       = restore(finest, levels.positions, numbers, r);
	restoredVertex_ = source.vertex;
	restoredFace_   = source.face;
	restoredCorner_ = cornersOf(source, orderOf(original.triangles, restored_, source));

	for (const Index v : levels.replay.source)
		vertex_.push_back(mesh.cut.vertex[v]);
	face_.assign(source.face.begin(), source.face.begin() + finest.faceCount());
	for (Index c = 0; c < finest.cornerCount(); ++c)
		corner_.push_back(restoredCorner_[r.turned[c / 3] ? turnedCorner(c) : c]);
	coarsen(levels);
}

/// Of the faces that came from one, from `first` on: the one that most others are like.
Index AttributeLevels::usual(const Level& fine, const Descent& descent, Index first) const
{
	Index best = first, most = 0;
	for (Index g = first; g < descent.face.size() && descent.face[g] == descent.face[first]; ++g) {
		Index alike = 0;
		for (Index h = first; h < descent.face.size() && descent.face[h] == descent.face[first];
		     ++h)
			alike += from_.same(AttributeOf::Face, face_[fine.face[g]], face_[fine.face[h]]);
		if (alike > most) {
			most = alike;
			best = g;
		}
	}
	return best;
}

/// The finest level's charts, and the corners at each vertex.
struct AttributeLevels::Charts
{
	Fans fans;
	std::vector<Index> chart;   ///< #F_J: the same number for all faces of a piece
	std::vector<Index> byChart; ///< corners of each fan by charts: hubs may have very many

	explicit Charts(const CornerTable& finest) : fans(finest), chart(finest.faceCount())
	{
		std::iota(chart.begin(), chart.end(), Index(0));
	}
	Index root(Index f)
	{
		while (chart[f] != f)
			f = chart[f] = chart[chart[f]];
		return f;
	}
	/// Once it is known which faces belong together.
	void close()
	{
		for (Index f = 0; f < chart.size(); ++f)
			chart[f] = root(f);
		byChart       = fans.corner;
		const auto at = [&](Index i) { return byChart.begin() + std::ptrdiff_t(fans.begin[i]); };
		for (Index v = 0; v + 1 < fans.begin.size(); ++v)
			std::stable_sort(
			    at(v), at(v + 1), [&](Index c, Index d) { return chart[c / 3] < chart[d / 3]; });
	}
	/// The first corner of the fan at v with a row of this chart, or kNone. @pre close()
	Index find(Index v, Index wanted) const
	{
		const auto end = byChart.begin() + std::ptrdiff_t(fans.begin[v + 1]);
		const auto it  = std::lower_bound(
		     byChart.begin() + std::ptrdiff_t(fans.begin[v]), end, wanted,
		     [&](Index c, Index w) { return chart[c / 3] < w; });
		return it != end && chart[*it / 3] == wanted ? *it : kNone;
	}
	/// Of the charts given, the first that all corners of a face have; else the first.
	Index shared(const CornerTable& table, Index face, const std::vector<Index>& charts) const
	{
		for (const Index wanted : charts) {
			bool all = true;
			for (Index c = 3 * face; c < 3 * face + 3; ++c)
				all = all && find(table.vertex[c], wanted) != kNone;
			if (all)
				return wanted;
		}
		return charts[0];
	}
};

/// Each coarse face has the row of one of the faces it became. Its corners have rows of one chart,
/// if one of those around has some at all three of its vertices: no face is drawn across a seam
/// without need.
void AttributeLevels::coarsen(const Levels& levels)
{
	const CornerTable& finest = levels.replay.finest;
	Charts charts(finest);
	forEachEdge(from_, finest, corner_, [&](Index c, bool same) {
		if (same)
			charts.chart[charts.root(c / 3)] = charts.root(finest.opposite[c] / 3);
	});
	charts.close();

	levels_.resize(levels.splits() + 1);
	Level& last   = levels_.back();
	last.vertices = finest.vertexCount;
	last.chart    = charts.chart;
	last.face.resize(finest.faceCount());
	last.corner.resize(finest.cornerCount());
	std::iota(last.face.begin(), last.face.end(), Index(0));
	std::iota(last.corner.begin(), last.corner.end(), Index(0));
	for (std::size_t i = levels.splits(); i-- > 0;) {
		const CornerTable &parent = levels.table(i), &child = levels.table(i + 1);
		const Refinement& r   = levels.replay.levels[i].refinement;
		const Descent descent = descentOf(parent, child, r, parentsOf(parent, r), Fans(child));
		const Level& fine     = levels_[i + 1];
		Level& level          = levels_[i];
		level.vertices        = parent.vertexCount;
		for (Index g = 0; g < child.faceCount(); ++g)
			if (g == 0 || descent.face[g] != descent.face[g - 1])
				level.face.push_back(fine.face[usual(fine, descent, g)]);
		takeCorners(parent, child, descent, charts, fine, level);
	}
}

void AttributeLevels::takeCorners(
    const CornerTable& parent,
    const CornerTable& child,
    const Descent& descent,
    const Charts& charts,
    const Level& fine,
    Level& level) const
{
	constexpr Index kMost = 8; // charts that are tried, so that hubs cost nothing
	Index g               = 0;
	for (Index f = 0; f < parent.faceCount(); ++f) {
		std::vector<Index> tried;
		for (; g < child.faceCount() && descent.face[g] == f; ++g)
			tried.push_back(fine.chart[g]);
		const Index v = parent.vertex[3 * f];
		for (Index j = charts.fans.begin[v]; j < charts.fans.begin[v + 1] && tried.size() < kMost;
		     ++j)
			tried.push_back(charts.chart[charts.fans.corner[j] / 3]);
		level.chart.push_back(charts.shared(parent, f, tried));
	}
	level.corner.assign(parent.cornerCount(), kNone);
	std::vector<Index> anyChart(parent.cornerCount(), kNone);
	for (Index c = 0; c < child.cornerCount(); ++c) {
		const Index p = descent.corner[c][0];
		if (p == kNone || child.vertex[c] >= parent.vertexCount)
			continue;
		if (anyChart[p] == kNone)
			anyChart[p] = fine.corner[c];
		if (level.corner[p] == kNone && charts.chart[fine.corner[c] / 3] == level.chart[p / 3])
			level.corner[p] = fine.corner[c];
	}
	for (Index p = 0; p < parent.cornerCount(); ++p) {
		const Index v = parent.vertex[p];
		if (level.corner[p] == kNone)
			level.corner[p] = charts.find(v, level.chart[p / 3]);
		if (level.corner[p] == kNone)
			level.corner[p] =
			    anyChart[p] != kNone ? anyChart[p] : charts.fans.corner[charts.fans.begin[v]];
	}
}

Tables AttributeLevels::picked(
    const std::vector<Index>& vertex,
    const std::vector<Index>& face,
    const std::vector<Index>& corner) const
{
	Tables out;
	for (std::size_t i = 0; i < from_.channels.size(); ++i) {
		const std::size_t width = from_.channels[i].width();
		if (from_.channels[i].isFauxEdges()) {
			out.push_back(turnedFauxEdges(from_.tables[i], face, corner));
			continue;
		}
		switch (from_.channels[i].of) {
		case AttributeOf::Vertex:
			out.push_back(pickedRows(from_.tables[i], vertex, width));
			break;
		case AttributeOf::Face:
			out.push_back(pickedRows(from_.tables[i], face, width));
			break;
		case AttributeOf::Corner:
			out.push_back(pickedRows(from_.tables[i], corner, width));
			break;
		case AttributeOf::Mesh:
			out.push_back(from_.tables[i]);
			break;
		}
	}
	return out;
}

Tables AttributeLevels::tables(std::size_t level) const
{
	const Level& l = levels_[level];
	std::vector<Index> vertex(vertex_.begin(), vertex_.begin() + l.vertices), face, corner;
	for (const Index f : l.face)
		face.push_back(face_[f]);
	for (const Index c : l.corner)
		corner.push_back(corner_[c]);
	return picked(vertex, face, corner);
}

Tables AttributeLevels::restoredTables() const
{
	return picked(restoredVertex_, restoredFace_, restoredCorner_);
}

std::array<Index, 3> AttributeLevels::known() const
{
	return {knownVertices_, Index(face_.size()), Index(corner_.size())};
}

std::vector<std::uint8_t> AttributeWriter::rest(std::vector<Channel>& channels)
{
	const Tables tables = from_.restoredTables();
	ByteWriter out;
	out.fixed(digestOf(tables));
	RangeEncoder coder;
	Watch never;
	syntax_.codeRest(coder, from_.known(), from_.restored(), tables, never);
	const auto stream = coder.finish();
	out.bytes.insert(out.bytes.end(), stream.begin(), stream.end());
	channels = from_.channels();
	for (std::size_t i = 0; i < channels.size(); ++i)
		channels[i].bytes = (syntax_.bits(i) + 7) / 8;
	return std::move(out.bytes);
}

std::uint32_t digestOf(const Tables& tables)
{
	ByteWriter out;
	for (const auto& rows : tables)
		for (const double x : rows)
			out.real64(x);
	return checksum(out.bytes.data(), out.bytes.size());
}

} // namespace wavemesh
