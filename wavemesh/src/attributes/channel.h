// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// An attribute as the file has it: what it is, and how its numbers are coded. Numbers of a channel
/// are kept as doubles in rows; on a lattice they are whole, 0 .. 2^bits - 1.
#pragma once

#include "attributes/number_format.h"

#include <wavemesh/mesh_data.h>
#include <wavemesh/status.h>

namespace wavemesh {

/// The lattice of a column: number n stands for low + step * n.
struct Column
{
	static constexpr int kMostBits = 24;

	double low  = 0;
	double step = 1;    ///< 1 if whole
	int bits    = 0;    ///< 0..24; 0: all are `low`
	bool whole  = true; ///< integers, exact
};

struct Channel
{
	static constexpr std::uint32_t kMost        = 64;
	static constexpr std::uint32_t kMostColumns = 16;
	static constexpr int kMostOctahedronBits    = 20;

	AttributeOf of     = AttributeOf::Vertex;
	AttributeKind kind = AttributeKind::Custom;
	NumberType type    = NumberType::Float;
	int components     = 1;
	std::string name;
	std::vector<Column> columns; ///< one for each component; empty: all numbers are exact
	/// Not 0: rows are points of an octahedron of radius 2^(octahedron - 1), and have no columns.
	int octahedron = 0;
	NumberFormat exact;      ///< if there is neither
	std::uint64_t bytes = 0; ///< of the file, about

	std::size_t width() const { return static_cast<std::size_t>(components); }
	bool onLattice() const { return !columns.empty(); }
	/// Edges inside polygons belong to the finest mesh alone, normals follow from its positions
	/// best: all of their rows come behind the levels.
	bool inLevels() const { return !isFauxEdges() && !isNormal(); }
	bool isNormal() const
	{
		return kind == AttributeKind::Normal && of != AttributeOf::Mesh && components == 3;
	}
	/// Do the rows depend on which corner of a face is the first?
	bool isFauxEdges() const;
	/// Of the columns that are rounded, the most bits, and their step; 0 if every number is exact.
	/// On an octahedron, its bits, and twice what a component may be off.
	int bits() const;
	double step() const;
};

/// @return InvalidArgument, naming the attribute, if it is none for this mesh
Status checkAttributes(const MeshData& mesh);

/// How to code `attribute`. Numbers that are not finite are kept, whatever its bits.
Channel makeChannel(const Attribute& attribute);

/// Rows in another order: row from[i] comes to i.
std::vector<double> pickedRows(
    const std::vector<double>& rows, const std::vector<std::uint32_t>& from, std::size_t width);

/// The same of edges of polygons in faces whose corners have other places.
/// @param corner  for each corner of the new faces, in order, the old one that it was
std::vector<double> turnedFauxEdges(
    const std::vector<double>& rows,
    const std::vector<std::uint32_t>& from,
    const std::vector<std::uint32_t>& corner);

/// Numbers to rows of the channel.
std::vector<double> toRows(const Channel& channel, const std::vector<double>& values);
/// And back.
Attribute toAttribute(const Channel& channel, const std::vector<double>& rows);

} // namespace wavemesh
