// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Attributes as bits, both ways. With each level come the rows of its new vertices, and the rows
/// of its faces and corners as far as they are not those of the level before; behind the levels,
/// those of elements that are on no level.
#pragma once

#include "attributes/descent.h"
#include "finish/restoration.h"
#include "stage.h"
#include "syntax/exact_syntax.h"
#include "syntax/lattice_syntax.h"
#include "syntax/normal_syntax.h"

namespace wavemesh {

/// Rows of each channel.
using Tables = std::vector<std::vector<double>>;

class AttributeSyntax
{
public:
	/// @param channels  must stay
	explicit AttributeSyntax(const std::vector<Channel>& channels) :
	        channels_(channels), tables_(channels.size()), flags_(channels.size()),
	        bits_(channels.size(), 0)
	{
		for (const Channel& c : channels) {
			lattice_.emplace_back(c.columns);
			exact_.emplace_back();
			normal_.push_back(
			    c.octahedron > 0 ? std::make_unique<NormalSyntax>(c.octahedron) : nullptr);
		}
	}

	/// The rows of the base mesh, and those of the whole mesh.
	/// @param next      writing: the tables of the level, with a row for each vertex, copies too
	/// @param progress  by channels; what was coded is of no use if it returned false
	template <class Coder>
	void codeBase(
	    Coder& coder,
	    const CornerTable& table,
	    const Glue& glue,
	    Tables next              = {},
	    const Progress& progress = {})
	{
		begin<Coder>(table, std::move(next));
		const Fans fans(table);
		for (std::size_t i = 0; i < channels_.size() && goesOn(progress, i); ++i)
			inLevel(coder, i, [&] {
				switch (channels_[i].of) {
				case AttributeOf::Vertex:
					for (Index v = 0; v < table.vertexCount; ++v)
						if (glue.isCopy(v))
							copyRow(i, v, rowAt(i, glue.first[v]));
						else
							codeRow(coder, i, v, rowsBefore(i, v));
					break;
				case AttributeOf::Face:
					for (Index f = 0; f < table.faceCount(); ++f)
						codeRow(coder, i, f, facesBefore(i, table, f));
					break;
				case AttributeOf::Corner:
					codeBaseCorners(coder, i, table, fans);
					break;
				case AttributeOf::Mesh:
					codeRow(coder, i, 0, {});
					break;
				}
			});
	}

	/// What the rows of the next level differ from those of this one. See codeBase().
	template <class Coder>
	void codeSplit(
	    Coder& coder,
	    const CornerTable& parent,
	    const CornerTable& child,
	    const Refinement& refinement,
	    const Parents& parents,
	    Tables next              = {},
	    const Progress& progress = {})
	{
		const Fans fans(child);
		const Descent descent = descentOf(parent, child, refinement, parents, fans);
		begin<Coder>(child, std::move(next));
		for (std::size_t i = 0; i < channels_.size() && goesOn(progress, i); ++i)
			inLevel(coder, i, [&] {
				switch (channels_[i].of) {
				case AttributeOf::Vertex:
					for (Index v = parent.vertexCount; v < child.vertexCount; ++v) {
						const Index at = v - parent.vertexCount;
						codeRow(coder, i, v, near(i, parent, parents[at], descent.edge[at]));
					}
					break;
				case AttributeOf::Face:
					codeFaces(coder, i, child, descent);
					break;
				case AttributeOf::Corner:
					for (Index v = 0; v < child.vertexCount; ++v)
						if (fans.begin[v] < fans.begin[v + 1])
							codeFan(coder, i, v < parent.vertexCount, parent, descent, fans, v);
					break;
				case AttributeOf::Mesh:
					break;
				}
			});
	}

	/// The rows from `known` on of vertices, faces and corners that are on no level; all normals
	/// and edges of polygons.
	/// @param mesh  the restored one
	/// @param next  tables of the restored mesh; reading: right as far as known
	/// What was coded is of no use if `watch` stopped.
	template <class Coder>
	void codeRest(
	    Coder& coder,
	    const std::array<Index, 3>& known,
	    const RestoredMesh& mesh,
	    Tables next,
	    Watch& watch)
	{
		tables_          = std::move(next);
		std::size_t done = 0, all = 0;
		for (std::size_t i = 0; i < channels_.size(); ++i)
			all += rowsFrom(i, firstOfRest(i, known));
		for (std::size_t i = 0; i < channels_.size() && !watch.stopped(); ++i)
			counted(coder, i, [&] {
				std::vector<double> normals;
				if (channels_[i].isNormal())
					normals = toRows(channels_[i], normalsOf(mesh, channels_[i].of));
				const Index first = firstOfRest(i, known);
				const Index end   = first + rowsFrom(i, first);
				for (Index row = first; row < end && watch.goesOn(done++, all); ++row)
					codeRow(
					    coder, i, row,
					    channels_[i].isNormal()
					        ? NearRows {normals.data() + row * width(i), nullptr, nullptr, nullptr}
					        : rowsBefore(i, row));
			});
	}

	/// Of the level reached.
	const Tables& tables() const { return tables_; }
	/// What channel i took so far. Writing only.
	std::uint64_t bits(std::size_t i) const { return bits_[i]; }

private:
	struct Flags
	{
		std::array<AdaptiveBit, 4> kept;   ///< all corners of an old vertex, all faces of a face
		std::array<AdaptiveBit, 4> single; ///< all corners of a new vertex are alike
		std::array<AdaptiveBit, 4> same, other;
		std::size_t last = 0; ///< answer to `kept` or `single` before, 0 or 1
	};

	bool goesOn(const Progress& progress, std::size_t i) const
	{
		return !progress || progress(double(i) / double(channels_.size()));
	}
	std::size_t width(std::size_t i) const { return channels_[i].width(); }
	const double* rowAt(std::size_t i, Index row) const
	{
		return tables_[i].data() + row * width(i);
	}
	const double* beforeAt(std::size_t i, Index row) const
	{
		return row == kNone ? nullptr : before_[i].data() + row * width(i);
	}
	bool same(std::size_t i, const double* a, const double* b) const
	{
		return a == b || (a && b && std::memcmp(a, b, width(i) * sizeof *a) == 0);
	}

	/// The first row of a channel that is on no level, and how many there are from it on.
	Index firstOfRest(std::size_t i, const std::array<Index, 3>& known) const
	{
		const Channel& c = channels_[i];
		return c.of == AttributeOf::Mesh || !c.inLevels() ? 0 : known[std::size_t(c.of)];
	}
	Index rowsFrom(std::size_t i, Index first) const
	{
		return channels_[i].of == AttributeOf::Mesh ? 0
		                                            : Index(tables_[i].size() / width(i)) - first;
	}

	/// Goes on to the next level's tables.
	template <class Coder>
	void begin(const CornerTable& table, Tables next)
	{
		before_ = std::move(tables_);
		tables_ = std::move(next);
		if constexpr (Coder::kReading) {
			const std::size_t count[4] = {
			    table.vertexCount, table.faceCount(), table.cornerCount(), 1};
			tables_.assign(channels_.size(), {});
			for (std::size_t i = 0; i < channels_.size(); ++i) {
				const AttributeOf of = channels_[i].of;
				if (of == AttributeOf::Vertex || of == AttributeOf::Mesh)
					tables_[i] = std::move(before_[i]);
				if (channels_[i].inLevels())
					tables_[i].resize(width(i) * count[std::size_t(of)]);
			}
		}
	}

	template <class Coder, class Code>
	void inLevel(Coder& coder, std::size_t i, Code code)
	{
		if (channels_[i].inLevels())
			counted(coder, i, code);
	}

	template <class Coder, class Code>
	void counted(Coder& coder, std::size_t i, Code code)
	{
		if constexpr (Coder::kReading)
			code();
		else {
			const auto position = [&coder] {
				const RangeEncoder::Mark at = coder.mark();
				return 8 * at.size + 32 - std::size_t(bitLength(at.high - at.low));
			};
			const std::uint64_t from = position();
			code();
			bits_[i] += position() - from;
		}
	}

	// ---- rows ---------------------------------------------------------------------------------

	void copyRow(std::size_t i, Index row, const double* from)
	{
		double* to = tables_[i].data() + row * width(i);
		for (std::size_t k = 0; k < width(i); ++k)
			to[k] = from ? from[k] : 0;
	}

	template <class Coder>
	void codeRow(Coder& coder, std::size_t i, Index row, const NearRows& near)
	{
		double* to = tables_[i].data() + row * width(i);
		if (normal_[i])
			normal_[i]->code(coder, to, near.a);
		else if (channels_[i].onLattice())
			lattice_[i].code(coder, to, near);
		else
			codeExact(coder, i, to, near);
		if (coder.exhausted())
			copyRow(i, row, near.a);
	}

	template <class Coder>
	void codeExact(Coder& coder, std::size_t i, double* row, const NearRows& near)
	{
		if (!exact_[i])
			exact_[i] = std::make_unique<ExactSyntax>(channels_[i].exact, width(i));
		double onward = 0, off = 0; // what the column before tells of this one
		for (std::size_t k = 0; k < width(i) && !coder.exhausted(); ++k) {
			const auto finite = [&](const double* from) {
				return from && std::isfinite(from[k]) ? from[k] : 0;
			};
			const double x = finite(near.a), y = near.b ? finite(near.b) : x;
			const double predicted = 0.5 * x + 0.5 * y + onward;
			const double spread    = std::max(std::abs(0.5 * x - 0.5 * y), 0.5 * off);
			row[k]                 = exact_[i]->code(coder, predicted, spread, k, row[k]);
			off                    = std::abs(row[k] - predicted);
			onward = channels_[i].kind == AttributeKind::Colour && k < 2 && std::isfinite(off)
			             ? row[k] - predicted // brightness changes most
			             : 0;
			off    = std::isfinite(off) ? off : 0;
		}
	}

	NearRows rowsBefore(std::size_t i, Index row) const
	{
		return {
		    row > 0 ? rowAt(i, row - 1) : nullptr, row > 1 ? rowAt(i, row - 2) : nullptr, nullptr,
		    nullptr};
	}

	/// Those of up to two neighbours of face f that come before it, else of the face before.
	NearRows facesBefore(std::size_t i, const CornerTable& table, Index f) const
	{
		NearRows near;
		for (Index c = 3 * f; c < 3 * f + 3; ++c) {
			const Index d = table.opposite[c];
			if (d == kNone || d / 3 >= f)
				continue;
			if (near.a)
				near.b = rowAt(i, d / 3);
			else
				near.a = rowAt(i, d / 3);
		}
		if (!near.a && f > 0)
			near.a = rowAt(i, f - 1);
		return near;
	}

	/// Of a new vertex: its parents, and those across their edge.
	NearRows
	near(std::size_t i, const CornerTable& parent, const std::array<Index, 3>& parents, Index edge)
	    const
	{
		NearRows out {rowAt(i, parents[0]), rowAt(i, parents[1]), nullptr, nullptr};
		if (edge != kNone && parent.opposite[edge] != kNone) {
			out.left  = rowAt(i, parent.vertex[edge]);
			out.right = rowAt(i, parent.vertex[parent.opposite[edge]]);
		}
		return out;
	}

	/// The same of a new vertex' corner; across the edge only where there is no seam.
	NearRows near(std::size_t i, const CornerTable& parent, const std::array<Index, 2>& from) const
	{
		NearRows out {beforeAt(i, from[0]), beforeAt(i, from[1]), nullptr, nullptr};
		if (from[0] == kNone || from[1] == kNone)
			return out;
		const Index c = nextCorner(from[0]) == from[1] ? nextCorner(from[1]) : nextCorner(from[0]);
		const Index d = parent.opposite[c];
		if (d != kNone && same(i, beforeAt(i, nextCorner(c)), beforeAt(i, prevCorner(d))) &&
		    same(i, beforeAt(i, prevCorner(c)), beforeAt(i, nextCorner(d)))) {
			out.left  = beforeAt(i, c);
			out.right = beforeAt(i, d);
		}
		return out;
	}

	// ---- faces --------------------------------------------------------------------------------

	/// The faces that a face became are like it, all or one by one.
	template <class Coder>
	void codeFaces(Coder& coder, std::size_t i, const CornerTable& child, const Descent& descent)
	{
		Flags& flags      = flags_[i];
		const Index count = child.faceCount();
		for (Index f = 0, end = 0; f < count; f = end) {
			const double* from = beforeAt(i, descent.face[f]);
			bool kept          = true;
			for (end = f; end < count && descent.face[end] == descent.face[f]; ++end)
				kept = kept && same(i, rowAt(i, end), from);
			flags.last = kept =
			    codeBit(coder, flags.kept[flags.last + (end - f > 1 ? 2 : 0)], kept);
			for (Index g = f; g < end; ++g)
				if (kept || codeBit(coder, flags.same[0], same(i, rowAt(i, g), from)))
					copyRow(i, g, from);
				else {
					NearRows rows = facesBefore(i, child, g);
					rows.b        = rows.a;
					rows.a        = from;
					codeRow(coder, i, g, rows);
				}
		}
	}

	// ---- corners ------------------------------------------------------------------------------

	/// The corners of one vertex of the base mesh: each next to those of its face that come before.
	template <class Coder>
	void codeBaseCorners(Coder& coder, std::size_t i, const CornerTable& table, const Fans& fans)
	{
		Index last = kNone; // corner of the vertex before
		for (Index v = 0; v < table.vertexCount; ++v) {
			const auto expected = [&](Index c) {
				NearRows rows;
				for (const Index d : {nextCorner(c), prevCorner(c)})
					if (table.vertex[d] < v)
						(rows.a ? rows.b : rows.a) = rowAt(i, d);
				if (!rows.a && last != kNone)
					rows.a = rowAt(i, last);
				return rows;
			};
			codeNew(coder, i, fans, v, expected);
			if (fans.begin[v] < fans.begin[v + 1])
				last = fans.corner[fans.begin[v]];
		}
	}

	template <class Coder>
	void codeFan(
	    Coder& coder,
	    std::size_t i,
	    bool isOld,
	    const CornerTable& parent,
	    const Descent& descent,
	    const Fans& fans,
	    Index v)
	{
		const auto expected = [&](Index c) { return near(i, parent, descent.corner[c]); };
		if (isOld)
			codeOld(coder, i, fans, v, expected);
		else
			codeNew(coder, i, fans, v, expected);
	}

	/// Rows that differ, of the fan's corners so far, the last one's first.
	template <std::size_t kMost>
	struct Rows
	{
		std::array<const double*, kMost> row;
		std::size_t count = 0;
	};
	static constexpr std::size_t kOthers = 4;
	using Others                         = Rows<kOthers>;
	using Recent                         = Rows<kOthers + 1>; ///< one of them may not count

	void remember(std::size_t i, const double* row, Recent& recent) const
	{
		std::size_t n = 0;
		while (n < recent.count && !same(i, recent.row[n], row))
			++n;
		recent.count = std::max(recent.count, std::min(n + 1, recent.row.size()));
		for (n = std::min(n, recent.row.size() - 1); n > 0; --n)
			recent.row[n] = recent.row[n - 1];
		recent.row[0] = row;
	}
	Others othersThan(std::size_t i, const double* not1, const Recent& recent) const
	{
		Others out;
		for (std::size_t n = 0; n < recent.count && out.count < out.row.size(); ++n)
			if (!not1 || !same(i, recent.row[n], not1))
				out.row[out.count++] = recent.row[n];
		return out;
	}

	/// One of the rows before it, or a row of its own.
	template <class Coder>
	void codeOther(Coder& coder, std::size_t i, Index c, const Others& others, const NearRows& near)
	{
		for (std::size_t n = 0; n < others.count; ++n)
			if (codeBit(coder, flags_[i].other[n], same(i, rowAt(i, c), others.row[n]))) {
				copyRow(i, c, others.row[n]);
				return;
			}
		codeRow(coder, i, c, near);
	}

	/// Corners of a vertex of the level before: most are as they were.
	template <class Coder, class Expected>
	void codeOld(Coder& coder, std::size_t i, const Fans& fans, Index v, Expected expected)
	{
		Flags& flags      = flags_[i];
		const Index begin = fans.begin[v], end = fans.begin[v + 1];
		bool kept = true, alike = true;
		const double* first = expected(fans.corner[begin]).a;
		for (Index j = begin; j < end; ++j) {
			const double* from = expected(fans.corner[j]).a;
			kept               = kept && same(i, rowAt(i, fans.corner[j]), from);
			alike              = alike && same(i, first, from);
		}
		flags.last = kept = codeBit(coder, flags.kept[flags.last + (alike ? 0 : 2)], kept);
		Recent recent;
		for (Index j = begin; j < end; ++j) {
			const Index c       = fans.corner[j];
			const NearRows rows = expected(c);
			if (kept || codeBit(coder, flags.same[1], same(i, rowAt(i, c), rows.a)))
				copyRow(i, c, rows.a);
			else
				codeOther(coder, i, c, othersThan(i, rows.a, recent), rows);
			if (!kept)
				remember(i, rowAt(i, c), recent);
		}
	}

	/// Corners of a new vertex: each like the one before it in the fan, unless there is a seam.
	template <class Coder, class Expected>
	void codeNew(Coder& coder, std::size_t i, const Fans& fans, Index v, Expected expected)
	{
		Flags& flags      = flags_[i];
		const Index begin = fans.begin[v], end = fans.begin[v + 1];
		if (begin == end)
			return;
		bool single = true, alike = true;
		const NearRows first = expected(fans.corner[begin]);
		for (Index j = begin + 1; j < end; ++j) {
			const NearRows rows = expected(fans.corner[j]);
			single = single && same(i, rowAt(i, fans.corner[j]), rowAt(i, fans.corner[begin]));
			alike  = alike && isAsExpected(i, first, rows);
		}
		codeRow(coder, i, fans.corner[begin], first);
		if (end - begin > 1)
			flags.last = single =
			    codeBit(coder, flags.single[flags.last + (alike ? 0 : 2)], single);
		NearRows last = first;
		Recent recent;
		remember(i, rowAt(i, fans.corner[begin]), recent);
		for (Index j = begin + 1; j < end; ++j) {
			const Index c             = fans.corner[j];
			const double* row         = rowAt(i, fans.corner[j - 1]);
			const NearRows rows       = expected(c);
			const std::size_t context = isAsExpected(i, last, rows) ? 2 : 3;
			if (single || codeBit(coder, flags.same[context], same(i, rowAt(i, c), row)))
				copyRow(i, c, row);
			else
				codeOther(coder, i, c, othersThan(i, row, recent), rows);
			if (!single)
				remember(i, rowAt(i, c), recent);
			last = rows;
		}
	}

	/// Do two corners of a vertex expect the same, from whichever side?
	bool isAsExpected(std::size_t i, const NearRows& x, const NearRows& y) const
	{
		return (same(i, x.a, y.a) && same(i, x.b, y.b)) || (same(i, x.a, y.b) && same(i, x.b, y.a));
	}

	const std::vector<Channel>& channels_;
	Tables tables_, before_;
	std::vector<LatticeSyntax> lattice_;
	std::vector<std::unique_ptr<ExactSyntax>> exact_;
	std::vector<std::unique_ptr<NormalSyntax>> normal_;
	std::vector<Flags> flags_;
	std::vector<std::uint64_t> bits_;
};

} // namespace wavemesh
