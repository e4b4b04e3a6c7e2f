// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Channels of a VCG mesh as attributes; see wavemesh/vcg_attributes.h.
#pragma once

#include <wavemesh/mesh_data.h>

#include <vcg/complex/complex.h>

#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace wavemesh {

/// Channels of a VCG mesh, to be combined with | as unsigned numbers.
enum VcgChannel : unsigned {
	kVertexColour    = 1u << 0,
	kVertexNormal    = 1u << 1,
	kVertexQuality   = 1u << 2,
	kVertexTexCoord  = 1u << 3,
	kVertexRadius    = 1u << 4,
	kVertexSelection = 1u << 5,
	kFaceColour      = 1u << 6,
	kFaceNormal      = 1u << 7,
	kFaceQuality     = 1u << 8,
	kFaceSelection   = 1u << 9,
	kFauxEdges       = 1u << 10,
	kWedgeTexCoord   = 1u << 11,
	kTextures        = 1u << 12,
	kTransform       = 1u << 13,
	kCustom          = 1u << 14, ///< user-defined ones of vertices and faces: numbers and points
	kAllChannels     = (1u << 15) - 1,
};

namespace vcg_detail {

template <class MeshType, class = void>
struct HasTransform : std::false_type
{
};
template <class MeshType>
struct HasTransform<MeshType, std::void_t<decltype(std::declval<MeshType&>().Tr.ElementAt(0, 0))>>
        : std::true_type
{
};

template <class Scalar>
constexpr NumberType numberTypeOf()
{
	return std::is_integral_v<Scalar>        ? NumberType::Integer
	       : sizeof(Scalar) == sizeof(float) ? NumberType::Float
	                                         : NumberType::Double;
}

inline Attribute attribute(
    AttributeOf of, AttributeKind kind, NumberType type, int components, std::string name = {})
{
	Attribute a;
	a.of         = of;
	a.kind       = kind;
	a.type       = type;
	a.components = components;
	a.name       = std::move(name);
	return a;
}

/// Adds an attribute: `read(element, values)` appends the row of each element that is not deleted.
template <class Elements, class Read>
void add(MeshData& data, Attribute a, const Elements& elements, Read read)
{
	a.values.reserve(elements.size() * std::size_t(a.components));
	for (const auto& e : elements)
		if (!e.IsD())
			read(e, a.values);
	data.attributes.push_back(std::move(a));
}

template <class Values, class Numbers>
void append(Values& values, const Numbers& numbers, int count)
{
	for (int k = 0; k < count; ++k)
		values.push_back(double(numbers[k]));
}

template <class MeshType>
void addOfVertices(const MeshType& m, unsigned channels, MeshData& data)
{
	using Scalar          = typename MeshType::ScalarType;
	using Normal          = typename MeshType::VertexType::NormalType::ScalarType;
	constexpr auto number = numberTypeOf<Scalar>();
	const auto of         = AttributeOf::Vertex;
	if ((channels & kVertexColour) && vcg::tri::HasPerVertexColor(m))
		add(data, attribute(of, AttributeKind::Colour, NumberType::Integer, 4), m.vert,
		    [](const auto& v, auto& out) { append(out, v.cC(), 4); });
	if ((channels & kVertexNormal) && vcg::tri::HasPerVertexNormal(m))
		add(data, attribute(of, AttributeKind::Normal, numberTypeOf<Normal>(), 3), m.vert,
		    [](const auto& v, auto& out) { append(out, v.cN(), 3); });
	if ((channels & kVertexQuality) && vcg::tri::HasPerVertexQuality(m))
		add(data, attribute(of, AttributeKind::Quality, NumberType::Double, 1), m.vert,
		    [](const auto& v, auto& out) { out.push_back(double(v.cQ())); });
	if ((channels & kVertexTexCoord) && vcg::tri::HasPerVertexTexCoord(m))
		add(data, attribute(of, AttributeKind::TexCoord, NumberType::Double, 3), m.vert,
		    [](const auto& v, auto& out) {
			    out.push_back(double(v.cT().U()));
			    out.push_back(double(v.cT().V()));
			    out.push_back(double(v.cT().N()));
		    });
	if ((channels & kVertexRadius) && vcg::tri::HasPerVertexRadius(m))
		add(data, attribute(of, AttributeKind::Radius, number, 1), m.vert,
		    [](const auto& v, auto& out) { out.push_back(double(v.cR())); });
	if (channels & kVertexSelection)
		add(data, attribute(of, AttributeKind::Selected, NumberType::Integer, 1), m.vert,
		    [](const auto& v, auto& out) { out.push_back(v.IsS() ? 1 : 0); });
}

template <class MeshType>
void addOfFaces(const MeshType& m, unsigned channels, MeshData& data)
{
	const auto of = AttributeOf::Face;
	if ((channels & kFaceColour) && vcg::tri::HasPerFaceColor(m))
		add(data, attribute(of, AttributeKind::Colour, NumberType::Integer, 4), m.face,
		    [](const auto& f, auto& out) { append(out, f.cC(), 4); });
	if ((channels & kFaceNormal) && vcg::tri::HasPerFaceNormal(m))
		add(data, attribute(of, AttributeKind::Normal, NumberType::Double, 3), m.face,
		    [](const auto& f, auto& out) { append(out, f.cN(), 3); });
	if ((channels & kFaceQuality) && vcg::tri::HasPerFaceQuality(m))
		add(data, attribute(of, AttributeKind::Quality, NumberType::Double, 1), m.face,
		    [](const auto& f, auto& out) { out.push_back(double(f.cQ())); });
	if (channels & kFaceSelection)
		add(data, attribute(of, AttributeKind::Selected, NumberType::Integer, 1), m.face,
		    [](const auto& f, auto& out) { out.push_back(f.IsS() ? 1 : 0); });
	if (channels & kFauxEdges)
		add(data, attribute(of, AttributeKind::FauxEdges, NumberType::Integer, 1), m.face,
		    [](const auto& f, auto& out) {
			    out.push_back((f.IsF(0) ? 1 : 0) + (f.IsF(1) ? 2 : 0) + (f.IsF(2) ? 4 : 0));
		    });
	if ((channels & kWedgeTexCoord) && vcg::tri::HasPerWedgeTexCoord(m))
		add(data, attribute(AttributeOf::Corner, AttributeKind::TexCoord, NumberType::Double, 3),
		    m.face, [](const auto& f, auto& out) {
			    for (int k = 0; k < 3; ++k) {
				    out.push_back(double(f.cWT(k).U()));
				    out.push_back(double(f.cWT(k).V()));
				    out.push_back(double(f.cWT(k).N()));
			    }
		    });
}

/// A user-defined attribute's value as numbers: one, or the three of a point.
template <class T>
struct CustomValue
{
	using Number               = T;
	static constexpr int kSize = 1;
	static void append(std::vector<double>& out, const T& value) { out.push_back(double(value)); }
	static void assign(T& value, const double* row) { value = static_cast<T>(row[0]); }
};
template <class T>
struct CustomValue<vcg::Point3<T>>
{
	using Number               = T;
	static constexpr int kSize = 3;
	static void append(std::vector<double>& out, const vcg::Point3<T>& value)
	{
		for (int k = 0; k < 3; ++k)
			out.push_back(double(value[k]));
	}
	static void assign(vcg::Point3<T>& value, const double* row)
	{
		for (int k = 0; k < 3; ++k)
			value[k] = static_cast<T>(row[k]);
	}
};

/// User-defined attributes of type T.
template <class T, class MeshType>
void addCustom(const MeshType& m, MeshData& data)
{
	using Allocator = vcg::tri::Allocator<MeshType>;
	using Value     = CustomValue<T>;
	const auto make = [](AttributeOf of, const std::string& name) {
		return attribute(
		    of, AttributeKind::Custom, numberTypeOf<typename Value::Number>(), Value::kSize, name);
	};
	std::vector<std::string> names;
	Allocator::template GetAllPerVertexAttribute<T>(m, names);
	for (const std::string& name : names) {
		const auto handle = Allocator::template FindPerVertexAttribute<T>(m, name);
		add(data, make(AttributeOf::Vertex, name), m.vert, [&](const auto& v, auto& out) {
			Value::append(out, handle[std::size_t(vcg::tri::Index(m, v))]);
		});
	}
	names.clear();
	Allocator::template GetAllPerFaceAttribute<T>(m, names);
	for (const std::string& name : names) {
		const auto handle = Allocator::template FindPerFaceAttribute<T>(m, name);
		add(data, make(AttributeOf::Face, name), m.face, [&](const auto& f, auto& out) {
			Value::append(out, handle[std::size_t(vcg::tri::Index(m, f))]);
		});
	}
}

} // namespace vcg_detail
} // namespace wavemesh
