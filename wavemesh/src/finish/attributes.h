// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The attributes' chunk: written at once, read along with the levels.
#pragma once

#include "container/container.h"
#include "finish/element_order.h"
#include "syntax/attribute_syntax.h"

namespace wavemesh {

/// @return InvalidArgument, naming the attribute, if it is none for this mesh
Status checkAttributes(const MeshData& mesh);

/// Numbers for each vertex, face and corner.
std::array<std::uint32_t, 3> attributeWidths(const std::vector<Attribute>& attributes);

struct AttributeSource
{
	const MeshData& original;
	const CornerTable& finest;
	const std::vector<Index>& originalVertex;         ///< #V_J: behind each of level J
	const std::vector<std::array<Index, 3>>& parents; ///< #(V_J - V_0)
	const Glue& glue;
	const RestoredMesh& restored;
	const RestoredSource& source;
	const ElementOrder& order;
};

/// Payload of the chunk. @param rows  of the head, for the levels' numbers of vertices
std::vector<std::uint8_t>
writeAttributes(const AttributeSource& from, const std::vector<LevelRow>& rows);

/// Reads the chunk level by level. What is wrong with it is told at the end.
class AttributeReader
{
public:
	AttributeReader(const Head& head, const std::uint8_t* payload, std::size_t size);
	AttributeReader(const AttributeReader&)            = delete;
	AttributeReader& operator=(const AttributeReader&) = delete;

	/// The vertices of the next level.
	/// @param vertices  there, old ones included
	/// @param parents   of the new ones; empty for the base mesh
	void
	advance(Index vertices, const std::vector<std::array<Index, 3>>& parents, const Glue& glue);
	/// Those of vertices, as far as advance() came.
	std::vector<Attribute> ofLevel() const;

	/// All others. Afterwards everything is in the numbering of the restored mesh.
	Status
	finish(const RestoredMesh& restored, const CornerTable& finest, const RestoredNumbers& numbers);
	const std::vector<Attribute>& attributes() const { return attributes_; }
	const std::vector<std::string>& textures() const { return textures_; }

private:
	RangeDecoder coder_;
	std::uint32_t digest_ = 0;
	std::vector<Attribute> attributes_;
	std::vector<std::string> textures_;
	AttributeSyntax<RangeDecoder> syntax_;
	bool good_   = false;
	Index known_ = 0; ///< vertices
};

/// `attributes` of a restored mesh in the original's order.
std::vector<Attribute> inOrder(std::vector<Attribute> attributes, const ElementOrder& order);

} // namespace wavemesh
