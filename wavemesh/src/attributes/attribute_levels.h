// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The encoder's side of attributes: which rows of the original the elements of every level have.
#pragma once

#include "encode/levels.h"
#include "finish/element_order.h"
#include "syntax/attribute_syntax.h"

namespace wavemesh {

/// The attributes of a mesh as they are coded.
struct AttributeRows
{
	std::vector<Channel> channels;
	Tables tables;

	explicit AttributeRows(const MeshData& mesh);
	/// Do two elements have the same in all attributes that levels have?
	bool same(AttributeOf of, Index a, Index b) const;
	/// Where the corners at an edge differ from those across it. @param cut  of that mesh
	Seams seams(const MeshData& mesh, const ManifoldCut& cut) const;
};

class AttributeLevels
{
public:
	/// @param from    of the original; must stay
	/// @param levels  whole; nothing of it is kept
	AttributeLevels(
	    const AttributeRows& from,
	    const MeshData& original,
	    const QuantisedMesh& mesh,
	    const Levels& levels);

	const std::vector<Channel>& channels() const { return from_.channels; }
	/// Of a level, counting splits only.
	Tables tables(std::size_t level) const;
	/// Of the restored mesh.
	Tables restoredTables() const;
	const RestoredMesh& restored() const { return restored_; }
	/// Elements of the finest level without copies: vertices, faces, corners.
	std::array<Index, 3> known() const;

private:
	struct Level
	{
		Index vertices;
		std::vector<Index> face, corner; ///< of the finest level, which it takes its row from
		std::vector<Index> chart;        ///< #F: piece between seams that its corners' rows are of
	};
	struct Charts;

	void coarsen(const Levels& levels);
	Index usual(const Level& fine, const Descent& descent, Index first) const;
	void takeCorners(
	    const CornerTable& parent,
	    const CornerTable& child,
	    const Descent& descent,
	    const Charts& charts,
	    const Level& fine,
	    Level& level) const;
	Tables picked(
	    const std::vector<Index>& vertex,
	    const std::vector<Index>& face,
	    const std::vector<Index>& corner) const;

	const AttributeRows& from_;
	std::vector<Index> vertex_;        ///< #V_J: of the original, behind each of level J
	std::vector<Index> face_, corner_; ///< the same of faces, corners
	std::vector<Level> levels_;        ///< coarsest first
	std::vector<Index> restoredVertex_, restoredFace_, restoredCorner_; ///< of the original
	RestoredMesh restored_;
	Index knownVertices_ = 0;
};

/// Writes them along with the levels.
class AttributeWriter
{
public:
	explicit AttributeWriter(const AttributeLevels& from) : from_(from), syntax_(from.channels()) {}

	void base(RangeEncoder& coder, const CornerTable& table, const Glue& glue)
	{
		syntax_.codeBase(coder, table, glue, from_.tables(0));
	}
	/// @param level  that the split leads to, counting splits only
	void split(
	    RangeEncoder& coder,
	    std::size_t level,
	    const CornerTable& parent,
	    const CornerTable& child,
	    const Refinement& refinement,
	    const Parents& parents)
	{
		syntax_.codeSplit(coder, parent, child, refinement, parents, from_.tables(level));
	}
	/// Payload of the chunk behind the levels.
	/// @param channels  [out] with what they took
	std::vector<std::uint8_t> rest(std::vector<Channel>& channels);

private:
	const AttributeLevels& from_;
	AttributeSyntax syntax_;
};

/// XXH32 over all numbers, as 64-bit floats in the order of the channels.
std::uint32_t digestOf(const Tables& tables);

} // namespace wavemesh
