// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish/attributes.h"

#include "container/byte_io.h"

namespace wavemesh {
namespace {

constexpr std::size_t kMaxAttributes = 64;
constexpr std::size_t kDigestSize    = 4;

std::size_t rowsOf(const MeshData& mesh, AttributeOf of)
{
	switch (of) {
	case AttributeOf::Vertex:
		return mesh.positions.size();
	case AttributeOf::Face:
		return mesh.triangles.size();
	case AttributeOf::Corner:
		return 3 * mesh.triangles.size();
	case AttributeOf::Mesh:
		return 1;
	}
	return 0;
}

bool fits(double x, NumberType type)
{
	if (type == NumberType::Integer)
		return isDecimal(x, {true, 0});
	return type == NumberType::Double || isFloat(x);
}

/// Rows of `values` in another order; row from[i] comes to i.
std::vector<double>
picked(const std::vector<double>& values, const std::vector<Index>& from, std::size_t width)
{
	std::vector<double> out;
	out.reserve(from.size() * width);
	for (const Index row : from)
		for (std::size_t k = 0; k < width; ++k)
			out.push_back(values[row * width + k]);
	return out;
}

/// For each corner of the restored mesh the original's.
std::vector<Index> cornersOf(const RestoredSource& source, const ElementOrder& order)
{
	std::vector<Index> corners(3 * source.face.size());
	for (Index f = 0; f < source.face.size(); ++f)
		for (Index k = 0; k < 3; ++k)
			corners[3 * f + (order.first[source.face[f]] + k) % 3] = 3 * source.face[f] + k;
	return corners;
}

std::uint32_t
digestOf(const std::vector<Attribute>& attributes, const std::vector<std::string>& names)
{
	ByteWriter out;
	for (const Attribute& a : attributes)
		for (const double x : a.values)
			out.real64(x);
	for (const std::string& name : names)
		out.bytes.insert(out.bytes.end(), name.begin(), name.end());
	return checksum(out.bytes.data(), out.bytes.size());
}

Status wrong(const std::string& what)
{
	return {StatusCode::InvalidArgument, what};
}

} // namespace

Status checkAttributes(const MeshData& mesh)
{
	if (mesh.attributes.size() > kMaxAttributes)
		return wrong("the mesh has more than 64 attributes");
	if (mesh.textures.size() > 0xffff)
		return wrong("the mesh has more than 65535 textures");
	for (const std::string& name : mesh.textures)
		if (name.size() > 0xffff)
			return wrong("a texture's name is longer than 65535 bytes");
	for (std::size_t i = 0; i < mesh.attributes.size(); ++i) {
		const Attribute& a     = mesh.attributes[i];
		const std::string name = "attribute " + std::to_string(i) + " (" + a.name + ")";
		if (a.components < 1 || a.components > 16 || a.name.size() > 255 ||
		    a.of > AttributeOf::Mesh || a.type > NumberType::Double)
			return wrong(name + " is not well formed");
		const auto width = std::size_t(a.components);
		if (a.values.size() != rowsOf(mesh, a.of) * width)
			return wrong(name + " does not have one row for each element");
		for (std::size_t k = 0; k < a.values.size(); ++k)
			if (!fits(a.values[k], a.type))
				return wrong(
				    name + " has a number in row " + std::to_string(k / width) +
				    " that is not of its type");
	}
	return {};
}

std::array<std::uint32_t, 3> attributeWidths(const std::vector<Attribute>& attributes)
{
	std::array<std::uint32_t, 3> widths {};
	for (const Attribute& a : attributes)
		if (a.of != AttributeOf::Mesh)
			widths[std::size_t(a.of)] += std::uint32_t(a.components);
	return widths;
}

std::vector<std::uint8_t>
writeAttributes(const AttributeSource& from, const std::vector<LevelRow>& rows)
{
	std::vector<Attribute> attributes = from.original.attributes;
	std::vector<std::vector<double>> ofLevels(attributes.size()); // of vertices, in their numbering
	const std::vector<Index> corners = cornersOf(from.source, from.order);
	for (std::size_t i = 0; i < attributes.size(); ++i) {
		Attribute& a     = attributes[i];
		const auto width = std::size_t(a.components);
		if (a.of == AttributeOf::Vertex) {
			ofLevels[i] = picked(a.values, from.originalVertex, width);
			a.values    = picked(a.values, from.source.vertex, width);
		}
		else if (a.of == AttributeOf::Face)
			a.values = picked(a.values, from.source.face, width);
		else if (a.of == AttributeOf::Corner)
			a.values = picked(a.values, corners, width);
	}
	std::vector<std::string> textures = from.original.textures;
	ByteWriter out;
	out.fixed(digestOf(attributes, textures));
	RangeEncoder coder;
	AttributeSyntax<RangeEncoder> syntax(coder, attributes);
	(void)syntax.codeHeader(textures);
	const auto exchange = [&] {
		for (std::size_t i = 0; i < attributes.size(); ++i)
			if (attributes[i].of == AttributeOf::Vertex)
				attributes[i].values.swap(ofLevels[i]);
	};
	exchange();
	Index known = 0;
	for (const LevelRow& row : rows) {
		std::vector<std::array<Index, 3>> parents;
		if (known != 0)
			parents.assign(
			    from.parents.begin() + (known - rows[0].vertices),
			    from.parents.begin() + (row.vertices - rows[0].vertices));
		syntax.codeVertices(known, row.vertices, parents, from.glue);
		known = row.vertices;
	}
	exchange();
	syntax.codeRest(from.restored, from.finest, restoredNumbers(from.glue, known).count);
	const auto stream = coder.finish();
	out.bytes.insert(out.bytes.end(), stream.begin(), stream.end());
	return std::move(out.bytes);
}

AttributeReader::AttributeReader(const Head& head, const std::uint8_t* payload, std::size_t size) :
        coder_(payload + std::min(size, kDigestSize), size - std::min(size, kDigestSize)),
        syntax_(coder_, attributes_)
{
	ByteReader in(payload, size);
	in.fixed(digest_);
	good_ = syntax_.codeHeader(textures_) && !coder_.exhausted() &&
	        attributeWidths(attributes_) == head.attributeWidths;
}

void AttributeReader::advance(
    Index vertices, const std::vector<std::array<Index, 3>>& parents, const Glue& glue)
{
	if (good_)
		syntax_.codeVertices(known_, vertices, parents, glue);
	good_  = good_ && !coder_.exhausted();
	known_ = vertices;
}

std::vector<Attribute> AttributeReader::ofLevel() const
{
	std::vector<Attribute> out;
	for (const Attribute& a : attributes_)
		if (good_ && a.of == AttributeOf::Vertex)
			out.push_back(a);
	return out;
}

Status AttributeReader::finish(
    const RestoredMesh& restored, const CornerTable& finest, const RestoredNumbers& numbers)
{
	if (!good_)
		return {StatusCode::Corrupt, "the attributes contradict themselves"};
	std::vector<Index> first; // of each restored vertex, one of level J
	for (Index v = 0; v < numbers.of.size(); ++v)
		if (numbers.of[v] == first.size())
			first.push_back(v);
	for (Attribute& a : attributes_)
		if (a.of == AttributeOf::Vertex)
			a.values = picked(a.values, first, std::size_t(a.components));
	syntax_.codeRest(restored, finest, numbers.count);
	good_ = !coder_.exhausted();
	if (!good_)
		return {StatusCode::Corrupt, "the attributes end although their chunk is whole"};
	if (digestOf(attributes_, textures_) != digest_)
		return {StatusCode::ChecksumMismatch, "the attributes do not match their digest"};
	return {};
}

std::vector<Attribute> inOrder(std::vector<Attribute> attributes, const ElementOrder& order)
{
	std::vector<Index> vertices(order.vertex.size()), corners;
	for (Index v = 0; v < vertices.size(); ++v)
		vertices[order.vertex[v]] = v;
	for (std::size_t i = 0; i < order.face.size(); ++i)
		for (Index k = 0; k < 3; ++k)
			corners.push_back(3 * order.face[i] + (order.first[i] + k) % 3);
	for (Attribute& a : attributes) {
		const auto width = std::size_t(a.components);
		if (a.of == AttributeOf::Vertex)
			a.values = picked(a.values, vertices, width);
		else if (a.of == AttributeOf::Face)
			a.values = picked(a.values, order.face, width);
		else if (a.of == AttributeOf::Corner)
			a.values = picked(a.values, corners, width);
	}
	return attributes;
}

} // namespace wavemesh
