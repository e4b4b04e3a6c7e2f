// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The decoder's side of attributes: read along with the levels, then put into the numbering of the
/// restored mesh.
#pragma once

#include "container/container.h"
#include "finish/element_order.h"
#include "syntax/attribute_syntax.h"

namespace wavemesh {

class AttributeReader
{
public:
	/// @param head  must stay
	explicit AttributeReader(const Head& head) : head_(head), syntax_(head.channels) {}

	/// With the level; the coder may be exhausted afterwards, then rows that did not come are
	/// those of what they are predicted from.
	void
	base(RangeDecoder& coder, const CornerTable& table, const Glue& glue, const Progress& progress)
	{
		syntax_.codeBase(coder, table, glue, {}, progress);
	}
	void split(
	    RangeDecoder& coder,
	    const CornerTable& parent,
	    const CornerTable& child,
	    const Refinement& refinement,
	    const Parents& parents,
	    const Progress& progress)
	{
		syntax_.codeSplit(coder, parent, child, refinement, parents, {}, progress);
	}
	/// Of the level reached.
	std::vector<Attribute> ofLevel() const { return attributesOf(syntax_.tables()); }

	/// Goes on to the restored mesh. Elements that are on no level get the row before theirs.
	/// @param turned  #F_J: 1 for faces that the original has the other way round; or empty
	void restore(
	    const RestoredNumbers& numbers,
	    const RestoredMesh& restored,
	    const std::vector<std::uint8_t>& turned);
	/// The chunk behind the levels; restore() comes first.
	/// @return Corrupt, ChecksumMismatch, Cancelled
	Status
	readRest(RangeDecoder& coder, std::uint32_t digest, const RestoredMesh& restored, Watch& watch);
	/// Of the restored mesh.
	/// @param order  of the original, or empty
	std::vector<Attribute> restoredAttributes(const ElementOrder& order) const;

private:
	/// Those that are on levels; once the rest was read, all.
	std::vector<Attribute> attributesOf(const Tables& tables) const;

	const Head& head_;
	AttributeSyntax syntax_;
	Tables restored_;
	bool whole_ = false;            ///< the rest was read
	std::array<Index, 3> known_ {}; ///< vertices, faces, corners of the restored mesh on levels
};

} // namespace wavemesh
