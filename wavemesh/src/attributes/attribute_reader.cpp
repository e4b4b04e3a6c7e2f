// SPDX-License-Identifier: GPL-3.0-or-later
#include "attributes/attribute_reader.h"

#include "attributes/attribute_levels.h"

namespace wavemesh {

void AttributeReader::restore(
    const RestoredNumbers& numbers,
    const RestoredMesh& restored,
    const std::vector<std::uint8_t>& turned)
{
	restored_ = syntax_.tables();
	std::vector<Index> vertex, corner; // of level J
	for (Index v = 0; v < numbers.of.size(); ++v)
		if (numbers.of[v] == vertex.size())
			vertex.push_back(v);
	const Index faces = head_.rows.back().faces;
	for (Index c = 0; c < 3 * faces; ++c)
		corner.push_back(!turned.empty() && turned[c / 3] ? turnedCorner(c) : c);
	known_ = {numbers.count, faces, 3 * faces};
	const std::array<std::size_t, 3> count {
	    Index(restored.points.size()), Index(restored.triangles.size()),
	    Index(3 * restored.triangles.size())};
	for (std::size_t i = 0; i < restored_.size(); ++i) {
		const Channel& channel = head_.channels[i];
		if (channel.of == AttributeOf::Vertex && channel.inLevels())
			restored_[i] = pickedRows(restored_[i], vertex, channel.width());
		else if (channel.of == AttributeOf::Corner && channel.inLevels())
			restored_[i] = pickedRows(restored_[i], corner, channel.width());
		if (channel.of == AttributeOf::Mesh)
			continue;
		std::vector<double>& rows = restored_[i];
		const std::size_t end     = count[std::size_t(channel.of)] * channel.width();
		rows.reserve(end);
		while (rows.size() < end)
			rows.push_back(
			    rows.size() < channel.width() ? 0
			                                  : *(rows.end() - std::ptrdiff_t(channel.width())));
	}
}

Status AttributeReader::readRest(
    RangeDecoder& coder, std::uint32_t digest, const RestoredMesh& restored, Watch& watch)
{
	syntax_.codeRest(coder, known_, restored, std::move(restored_), watch);
	restored_ = syntax_.tables();
	if (watch.stopped())
		return cancelled();
	if (coder.exhausted())
		return {StatusCode::Corrupt, "the attributes end although their chunk is whole"};
	if (digestOf(restored_) != digest)
		return {StatusCode::ChecksumMismatch, "the attributes do not match their digest"};
	whole_ = true;
	return {};
}

std::vector<Attribute> AttributeReader::attributesOf(const Tables& tables) const
{
	std::vector<Attribute> out;
	for (std::size_t i = 0; i < tables.size(); ++i)
		if (whole_ || head_.channels[i].inLevels())
			out.push_back(toAttribute(head_.channels[i], tables[i]));
	return out;
}

std::vector<Attribute> AttributeReader::restoredAttributes(const ElementOrder& order) const
{
	if (order.empty())
		return attributesOf(restored_);
	std::vector<Index> vertices(order.vertex.size()), corners;
	for (Index v = 0; v < vertices.size(); ++v)
		vertices[order.vertex[v]] = v;
	for (std::size_t i = 0; i < order.face.size(); ++i)
		for (Index k = 0; k < 3; ++k)
			corners.push_back(3 * order.face[i] + (order.first[i] + k) % 3);
	Tables tables = restored_;
	for (std::size_t i = 0; i < tables.size(); ++i) {
		const Channel& c = head_.channels[i];
		if (c.of == AttributeOf::Vertex)
			tables[i] = pickedRows(tables[i], vertices, c.width());
		else if (c.isFauxEdges())
			tables[i] = turnedFauxEdges(tables[i], order.face, corners);
		else if (c.of == AttributeOf::Face)
			tables[i] = pickedRows(tables[i], order.face, c.width());
		else if (c.of == AttributeOf::Corner)
			tables[i] = pickedRows(tables[i], corners, c.width());
	}
	return attributesOf(tables);
}

} // namespace wavemesh
