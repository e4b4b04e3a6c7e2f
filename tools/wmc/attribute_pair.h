// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// An attribute of an original and of the mesh decoded: whether rows agree, and which are alike.
#pragma once

#include "attribute_options.h"

#include <wavemesh/mesh_data.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace wavemesh::tool {

/// Attributes of a face or vertex as numbers that say which are alike.
using Signature = std::vector<std::int64_t>;

/// An attribute of both meshes.
class Pair
{
public:
	Pair(const Attribute& original, const Attribute& decoded, double step) :
	        original_(original), decoded_(decoded), step_(step), snapped_(original.values)
	{
		for (std::size_t k = 0; step > 0 && k < width(); ++k)
			snap(k);
	}

	AttributeOf of() const { return original_.of; }
	bool isFauxEdges() const { return original_.kind == AttributeKind::FauxEdges; }
	std::string name() const { return nameOf(original_.of, original_.kind, original_.name); }

	bool agree(std::size_t a, std::size_t b) const
	{
		for (std::size_t k = 0; k < width(); ++k)
			if (!isNear(original_.values[a * width() + k], decoded_.values[b * width() + k]))
				return false;
		return true;
	}
	/// Of faces, corner k of b lying on corner k + turn of a.
	bool agreeTurned(std::size_t a, std::size_t b, std::uint32_t turn) const
	{
		const auto bits       = [](double x) { return static_cast<std::uint32_t>(x) & 7; };
		const std::uint32_t x = bits(original_.values[a]), y = bits(decoded_.values[b]);
		return ((x >> turn) | (x << (3 - turn))) % 8 == y;
	}

	/// Bit patterns of a row: of the decoded mesh, or what the original's should have become.
	void append(bool isDecoded, std::size_t row, Signature& to) const
	{
		const auto& values = isDecoded ? decoded_.values : snapped_;
		for (std::size_t k = 0; k < width(); ++k)
			to.push_back(patternOf(values[row * width() + k]));
	}
	void appendTurned(bool isDecoded, std::size_t face, std::uint32_t first, Signature& to) const
	{
		const auto bits =
		    static_cast<unsigned>((isDecoded ? decoded_ : original_).values[face]) & 7;
		to.push_back(((bits >> first) | (bits << (3 - first))) % 8);
	}

private:
	std::size_t width() const { return std::size_t(original_.components); }

	static std::int64_t patternOf(double x)
	{
		std::int64_t pattern;
		std::memcpy(&pattern, &x, sizeof x);
		return pattern;
	}

	/// Puts the original's numbers of a column on the nearest that the decoded mesh has.
	void snap(std::size_t column)
	{
		std::vector<double> known;
		for (std::size_t i = column; i < decoded_.values.size(); i += width())
			if (std::isfinite(decoded_.values[i]))
				known.push_back(decoded_.values[i]);
		std::sort(known.begin(), known.end());
		for (std::size_t i = column; i < snapped_.size(); i += width()) {
			if (known.empty() || !std::isfinite(snapped_[i]))
				continue;
			const auto above = std::lower_bound(known.begin(), known.end(), snapped_[i]);
			const auto below = above == known.begin() ? above : above - 1;
			snapped_[i]      = above == known.end() || snapped_[i] - *below < *above - snapped_[i]
			                       ? *below
			                       : *above;
		}
	}

	bool isNear(double x, double y) const
	{
		if (std::memcmp(&x, &y, sizeof x) == 0)
			return true;
		// Half a step, and the rounding to 32 bits.
		return step_ > 0 && std::abs(x - y) <= 0.5 * step_ * (1 + 1e-9) + 1e-7 * std::abs(x);
	}

	const Attribute& original_;
	const Attribute& decoded_;
	double step_;
	std::vector<double> snapped_; ///< the original's, as the decoded mesh should have them
};

} // namespace wavemesh::tool
