// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Attributes as bits, both ways: what they are; those of vertices level by level, each predicted
/// from its parents, so that the beginning of the stream gives a coarse level; then, on the
/// restored mesh, all others, predicted from the neighbours before them.
#pragma once

#include "finish/restoration.h"
#include "syntax/exact_syntax.h"

#include <wavemesh/mesh_data.h>

namespace wavemesh {

template <class Coder>
class AttributeSyntax
{
public:
	static constexpr int kMaxComponents           = 16;
	static constexpr std::uint32_t kMaxAttributes = 64;

	/// Reading, `attributes` gets what is read.
	/// @pre writing: values of vertices come in the decoder's order of vertices, with copies
	AttributeSyntax(Coder& coder, std::vector<Attribute>& attributes) :
	        coder_(coder), attributes_(attributes)
	{
	}

	/// @return false if what is read is no attribute
	bool codeHeader(std::vector<std::string>& textures)
	{
		const std::uint32_t count = codeRaw(coder_, 8, std::uint32_t(attributes_.size()));
		if (count > kMaxAttributes)
			return false;
		for (std::uint32_t i = 0; i < count && !coder_.exhausted(); ++i) {
			if constexpr (Coder::kReading)
				attributes_.emplace_back();
			Attribute& a = attributes_[i];
			a.of         = AttributeOf(codeRaw(coder_, 2, std::uint32_t(a.of)));
			a.kind       = AttributeKind(codeRaw(coder_, 8, std::uint32_t(a.kind)));
			a.type       = NumberType(codeRaw(coder_, 2, std::uint32_t(a.type)));
			a.components = 1 + int(codeRaw(coder_, 4, std::uint32_t(a.components - 1)));
			codeText(a.name, 8);
			if (a.type > NumberType::Double)
				return false;
			NumberFormat format;
			if constexpr (!Coder::kReading)
				format = formatFor(a);
			numbers_.emplace_back(coder_, format, std::size_t(a.components));
			same_.emplace_back();
		}
		const std::uint32_t names = codeRaw(coder_, 16, std::uint32_t(textures.size()));
		for (std::uint32_t i = 0; i < names && !coder_.exhausted(); ++i) {
			if constexpr (Coder::kReading)
				textures.emplace_back();
			codeText(textures[i], 16);
		}
		return true;
	}

	/// The next vertices of the decoder's order.
	/// @param parents  of each, see Parents in wavelet/lifting.h; empty: they are of the base mesh
	void codeVertices(
	    Index begin, Index end, const std::vector<std::array<Index, 3>>& parents, const Glue& glue)
	{
		for (std::size_t i = 0; i < attributes_.size(); ++i)
			if (attributes_[i].of == AttributeOf::Vertex)
				for (Index v = begin; v < end && !coder_.exhausted(); ++v) {
					if (glue.isCopy(v))
						copyRow(i, glue.first[v]);
					else if (parents.empty())
						codeRow(i, v, v < 1 ? kNone : v - 1, v < 2 ? kNone : v - 2);
					else
						codeRow(i, v, parents[v - begin][0], parents[v - begin][1]);
				}
	}

	/// What else there is. @pre the vertices' values are in the restored mesh's numbering
	/// @param known  vertices coded so far
	void codeRest(const RestoredMesh& mesh, const CornerTable& finest, Index known)
	{
		for (std::size_t i = 0; i < attributes_.size(); ++i)
			switch (attributes_[i].of) {
			case AttributeOf::Vertex:
				for (Index v = known; v < mesh.points.size() && !coder_.exhausted(); ++v)
					codeRow(i, v, v < 1 ? kNone : v - 1, v < 2 ? kNone : v - 2);
				break;
			case AttributeOf::Face:
				codeFaces(i, Index(mesh.triangles.size()), finest);
				break;
			case AttributeOf::Corner:
				codeCorners(i, mesh.triangles, finest);
				break;
			case AttributeOf::Mesh:
				codeRow(i, 0, kNone, kNone);
				break;
			}
	}

private:
	static NumberFormat formatFor(const Attribute& a)
	{
		if (a.type == NumberType::Integer)
			return {true, 0};
		// What a prediction is off by, about: a hundredth of the range.
		double low = 0, high = 0;
		std::vector<std::array<double, 3>> rows;
		rows.reserve(a.values.size() / 3 + 1);
		for (std::size_t i = 0; i < a.values.size(); ++i) {
			if (i % 3 == 0)
				rows.push_back({a.values[i], a.values[i], a.values[i]});
			rows.back()[i % 3] = a.values[i];
			if (std::isfinite(a.values[i])) {
				low  = std::min(low, a.values[i]);
				high = std::max(high, a.values[i]);
			}
		}
		const double spread = (high - low) / 100;
		return formatOf(rows, std::isfinite(spread) ? spread : 1);
	}

	void codeText(std::string& text, int lengthBits)
	{
		const std::uint32_t length = codeRaw(coder_, lengthBits, std::uint32_t(text.size()));
		for (std::uint32_t i = 0; i < length && !coder_.exhausted(); ++i) {
			if constexpr (Coder::kReading)
				text.push_back(0);
			text[i] = char(codeRaw(coder_, 8, std::uint8_t(text[i])));
		}
	}

	std::size_t width(std::size_t i) const { return std::size_t(attributes_[i].components); }
	double at(std::size_t i, Index row, std::size_t k) const
	{
		const double x = row == kNone ? 0 : attributes_[i].values[row * width(i) + k];
		return std::isfinite(x) ? x : 0;
	}

	/// A row next to the mean of two that are known, or to one, or to zeros.
	void codeRow(std::size_t i, Index row, Index a, Index b)
	{
		std::array<double, kMaxComponents> predicted {}, spread {};
		for (std::size_t k = 0; k < width(i); ++k) {
			const double x = at(i, a, k), y = b == kNone ? x : at(i, b, k);
			predicted[k] = 0.5 * x + 0.5 * y;
			spread[k]    = std::abs(0.5 * x - 0.5 * y);
		}
		codeValues(i, row, predicted, spread);
	}

	void codeValues(
	    std::size_t i,
	    Index row,
	    std::array<double, kMaxComponents>& predicted,
	    std::array<double, kMaxComponents>& spread)
	{
		auto& values = attributes_[i].values;
		for (std::size_t k = 0; k < width(i) && !coder_.exhausted(); ++k) {
			if constexpr (Coder::kReading)
				values.push_back(0);
			double& x = values[row * width(i) + k];
			x         = numbers_[i].code(predicted[k], spread[k], k, x);
			// Where one component is off the next one is.
			const double off = std::abs(x - predicted[k]);
			if (attributes_[i].kind == AttributeKind::Colour && k < 2 && k + 1 < width(i) &&
			    std::isfinite(off))
				predicted[k + 1] += x - predicted[k]; // brightness changes most
			if (k + 1 < width(i) && std::isfinite(off))
				spread[k + 1] = std::max(spread[k + 1], 0.5 * off);
		}
	}

	void copyRow(std::size_t i, Index from)
	{
		if constexpr (Coder::kReading)
			for (std::size_t k = 0; k < width(i); ++k) {
				const double x = attributes_[i].values[from * width(i) + k];
				attributes_[i].values.push_back(x);
			}
	}

	/// A face next to its first two neighbours before it, else to the faces before it.
	void codeFaces(std::size_t i, Index count, const CornerTable& finest)
	{
		for (Index f = 0; f < count && !coder_.exhausted(); ++f) {
			Index near[3] = {kNone, kNone, kNone};
			int n         = 0;
			for (Index c = 3 * f; c < 3 * f + 3; ++c)
				if (const Index g = faceBefore(finest, c); g != kNone)
					near[n++] = g;
			if (n == 0 && f > 0)
				near[0] = f - 1;
			codeRow(i, f, near[0], near[1]);
		}
	}

	/// Face across, if it comes before.
	static Index faceBefore(const CornerTable& finest, Index corner)
	{
		const Index d = corner < finest.cornerCount() ? finest.opposite[corner] : kNone;
		return d != kNone && d / 3 < corner / 3 ? d / 3 : kNone;
	}

	/// Rows of a corner's vertex in up to two faces next to its own that come before.
	static std::array<Index, 2>
	rowsBefore(const Triangles& triangles, const CornerTable& finest, Index f, Index vertex)
	{
		std::array<Index, 2> rows {kNone, kNone};
		std::size_t n = 0;
		for (Index c = 3 * f; c < 3 * f + 3; ++c)
			if (const Index g = faceBefore(finest, c); g != kNone && n < 2)
				for (Index k = 0; k < 3; ++k)
					if (triangles[g][k] == vertex) {
						rows[n++] = 3 * g + k;
						break;
					}
		return rows;
	}

	bool sameRow(std::size_t i, Index a, Index b) const
	{
		for (std::size_t k = 0; k < width(i); ++k)
			if (ordinalOf(attributes_[i].values[a * width(i) + k]) !=
			    ordinalOf(attributes_[i].values[b * width(i) + k]))
				return false;
		return true;
	}

	/// Each corner has what the same vertex has in a face next to it, unless there is a seam.
	void codeCorners(std::size_t i, const Triangles& triangles, const CornerTable& finest)
	{
		std::size_t last = 0;
		for (Index f = 0; f < triangles.size(); ++f)
			for (Index k = 0; k < 3 && !coder_.exhausted(); ++k) {
				const Index row = 3 * f + k, v = triangles[f][k];
				auto near = rowsBefore(triangles, finest, f, v);
				if (near[1] != kNone && sameRow(i, near[0], near[1]))
					near[1] = kNone;
				std::size_t context = 3 * last;
				bool known          = false;
				for (const Index from : near) {
					++context;
					if (from == kNone || known)
						continue;
					bool same = false;
					if constexpr (!Coder::kReading)
						same = sameRow(i, row, from);
					known = codeBit(coder_, same_[i][context], same);
					if (known)
						copyRow(i, from);
				}
				last = known ? 1 : 0;
				if (!known)
					codeRow(
					    i, row,
					    near[0] != kNone ? near[0]
					    : row > 0        ? row - 1
					                     : kNone,
					    k > 0 ? row - 1 : kNone);
			}
	}

	Coder& coder_;
	std::vector<Attribute>& attributes_;
	std::vector<ExactSyntax<Coder>> numbers_; ///< by attribute
	std::vector<std::array<AdaptiveBit, 16>> same_;
};

} // namespace wavemesh
