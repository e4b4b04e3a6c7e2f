// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The optional channels of a VCG mesh as attributes of a MeshData, and back. Header only, for any
/// VCG mesh type: what the type does not have, or has switched off, is left out.
#pragma once

#include <wavemesh/mesh_data.h>

#include <vcg/complex/complex.h>

#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace wavemesh {

/// Channels, to be combined.
enum Channel : unsigned {
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
	kCustom      = 1u << 14, ///< user-defined attributes of vertices and faces, float and double
	kAllChannels = (1u << 15) - 1,
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

/// The number as a `Number`; a file may have any: what an integer type cannot hold becomes its
/// nearest, not-a-number 0.
template <class Number>
Number narrowed(double value)
{
	if constexpr (std::is_integral_v<Number>) {
		constexpr double low = std::numeric_limits<Number>::min();
		constexpr double top = std::numeric_limits<Number>::max();
		return value >= low && value <= top ? static_cast<Number>(value)
		                                    : static_cast<Number>(
		                                          value > top   ? top
		                                          : value < low ? low
		                                                        : 0);
	}
	else
		return static_cast<Number>(value);
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

/// User-defined attributes of numbers of type T.
template <class T, class MeshType>
void addCustom(const MeshType& m, MeshData& data)
{
	using Allocator = vcg::tri::Allocator<MeshType>;
	std::vector<std::string> names;
	Allocator::template GetAllPerVertexAttribute<T>(m, names);
	for (const std::string& name : names) {
		const auto handle = Allocator::template FindPerVertexAttribute<T>(m, name);
		std::size_t i     = 0;
		add(data, attribute(AttributeOf::Vertex, AttributeKind::Custom, numberTypeOf<T>(), 1, name),
		    m.vert, [&](const auto& v, auto& out) {
			    i = std::size_t(vcg::tri::Index(m, v));
			    out.push_back(double(handle[i]));
		    });
	}
	names.clear();
	Allocator::template GetAllPerFaceAttribute<T>(m, names);
	for (const std::string& name : names) {
		const auto handle = Allocator::template FindPerFaceAttribute<T>(m, name);
		add(data, attribute(AttributeOf::Face, AttributeKind::Custom, numberTypeOf<T>(), 1, name),
		    m.face, [&](const auto& f, auto& out) {
			    out.push_back(double(handle[std::size_t(vcg::tri::Index(m, f))]));
		    });
	}
}

} // namespace vcg_detail

/// Adds the channels of `m` to what toMeshData(m) made of it. `m` is not modified.
/// @param channels  of Channel, combined; those that `m` does not have are left out
template <class MeshType>
void addAttributes(const MeshType& m, unsigned channels, MeshData& data)
{
	vcg_detail::addOfVertices(m, channels, data);
	vcg_detail::addOfFaces(m, channels, data);
	if (channels & kCustom) {
		vcg_detail::addCustom<float>(m, data);
		vcg_detail::addCustom<double>(m, data);
	}
	if (channels & kTextures)
		data.textures.assign(m.textures.begin(), m.textures.end());
	if constexpr (vcg_detail::HasTransform<MeshType>::value)
		if (channels & kTransform) {
			Attribute a = vcg_detail::attribute(
			    AttributeOf::Mesh, AttributeKind::Transform, NumberType::Double, 16);
			for (int i = 0; i < 4; ++i)
				for (int k = 0; k < 4; ++k)
					a.values.push_back(double(m.Tr.ElementAt(i, k)));
			data.attributes.push_back(std::move(a));
		}
}

/// Which channels `data` has: for switching them on in a mesh before setAttributes().
inline unsigned channelsOf(const MeshData& data)
{
	unsigned channels = data.textures.empty() ? 0u : unsigned(kTextures);
	for (const Attribute& a : data.attributes) {
		const bool face = a.of == AttributeOf::Face;
		switch (a.kind) {
		case AttributeKind::Colour:
			channels |= face ? kFaceColour : kVertexColour;
			break;
		case AttributeKind::Normal:
			channels |= face ? kFaceNormal : kVertexNormal;
			break;
		case AttributeKind::Quality:
			channels |= face ? kFaceQuality : kVertexQuality;
			break;
		case AttributeKind::TexCoord:
			channels |= a.of == AttributeOf::Corner ? kWedgeTexCoord : kVertexTexCoord;
			break;
		case AttributeKind::Radius:
			channels |= kVertexRadius;
			break;
		case AttributeKind::Selected:
			channels |= face ? kFaceSelection : kVertexSelection;
			break;
		case AttributeKind::FauxEdges:
			channels |= kFauxEdges;
			break;
		case AttributeKind::Transform:
			channels |= kTransform;
			break;
		case AttributeKind::Custom:
			channels |= kCustom;
			break;
		}
	}
	return channels;
}

namespace vcg_detail {

template <class Number>
void assign(const double* row, int count, Number&& number)
{
	for (int k = 0; k < count; ++k)
		number[k] = narrowed<std::decay_t<decltype(number[k])>>(row[k]);
}

/// Does `all`, a mesh's attributes of some element, have one of this name?
template <class All>
bool isTaken(const All& all, const std::string& name)
{
	for (const auto& one : all)
		if (!name.empty() && one._name == name)
			return true;
	return false;
}

/// A user-defined attribute of numbers of type T. VCG would take one of the same name and another
/// type for it: the first is kept.
template <class T, class MeshType>
void setCustomOfVertices(const Attribute& a, MeshType& m)
{
	using Allocator = vcg::tri::Allocator<MeshType>;
	auto handle     = Allocator::template FindPerVertexAttribute<T>(m, a.name);
	if (!Allocator::IsValidHandle(m, handle)) {
		if (isTaken(m.vert_attr, a.name))
			return;
		handle = Allocator::template AddPerVertexAttribute<T>(m, a.name);
	}
	for (std::size_t v = 0; v < m.vert.size(); ++v)
		handle[v] = static_cast<T>(a.values[v]);
}

template <class T, class MeshType>
void setCustomOfFaces(const Attribute& a, MeshType& m)
{
	using Allocator = vcg::tri::Allocator<MeshType>;
	auto handle     = Allocator::template FindPerFaceAttribute<T>(m, a.name);
	if (!Allocator::IsValidHandle(m, handle)) {
		if (isTaken(m.face_attr, a.name))
			return;
		handle = Allocator::template AddPerFaceAttribute<T>(m, a.name);
	}
	for (std::size_t f = 0; f < m.face.size(); ++f)
		handle[f] = static_cast<T>(a.values[f]);
}

template <class MeshType>
void setOfVertices(const Attribute& a, MeshType& m)
{
	using Quality    = typename MeshType::VertexType::QualityType;
	using Radius     = typename MeshType::VertexType::RadiusType;
	const auto width = std::size_t(a.components);
	const auto each  = [&](auto set) {
        for (std::size_t v = 0; v < m.vert.size(); ++v)
            set(m.vert[v], a.values.data() + v * width);
	};
	if (a.kind == AttributeKind::Colour && width == 4 && vcg::tri::HasPerVertexColor(m))
		each([](auto& v, const double* row) { assign(row, 4, v.C()); });
	else if (a.kind == AttributeKind::Normal && width == 3 && vcg::tri::HasPerVertexNormal(m))
		each([](auto& v, const double* row) { assign(row, 3, v.N()); });
	else if (a.kind == AttributeKind::Quality && width == 1 && vcg::tri::HasPerVertexQuality(m))
		each([](auto& v, const double* row) { v.Q() = Quality(row[0]); });
	else if (a.kind == AttributeKind::Radius && width == 1 && vcg::tri::HasPerVertexRadius(m))
		each([](auto& v, const double* row) { v.R() = Radius(row[0]); });
	else if (a.kind == AttributeKind::TexCoord && width == 3 && vcg::tri::HasPerVertexTexCoord(m))
		each([](auto& v, const double* row) {
			v.T().U() = static_cast<std::decay_t<decltype(v.T().U())>>(row[0]);
			v.T().V() = static_cast<std::decay_t<decltype(v.T().V())>>(row[1]);
			v.T().N() = narrowed<short>(row[2]);
		});
	else if (a.kind == AttributeKind::Selected && width == 1)
		each([](auto& v, const double* row) { row[0] != 0 ? v.SetS() : v.ClearS(); });
	else if (a.kind == AttributeKind::Custom && width == 1 && a.type == NumberType::Float)
		setCustomOfVertices<float>(a, m);
	else if (a.kind == AttributeKind::Custom && width == 1)
		setCustomOfVertices<double>(a, m);
}

template <class MeshType>
void setOfFaces(const Attribute& a, MeshType& m)
{
	using Quality    = typename MeshType::FaceType::QualityType;
	const auto width = std::size_t(a.components);
	const auto each  = [&](auto set) {
        for (std::size_t f = 0; f < m.face.size(); ++f)
            set(m.face[f], a.values.data() + f * width);
	};
	if (a.kind == AttributeKind::Colour && width == 4 && vcg::tri::HasPerFaceColor(m))
		each([](auto& f, const double* row) { assign(row, 4, f.C()); });
	else if (a.kind == AttributeKind::Normal && width == 3 && vcg::tri::HasPerFaceNormal(m))
		each([](auto& f, const double* row) { assign(row, 3, f.N()); });
	else if (a.kind == AttributeKind::Quality && width == 1 && vcg::tri::HasPerFaceQuality(m))
		each([](auto& f, const double* row) { f.Q() = Quality(row[0]); });
	else if (a.kind == AttributeKind::Selected && width == 1)
		each([](auto& f, const double* row) { row[0] != 0 ? f.SetS() : f.ClearS(); });
	else if (a.kind == AttributeKind::FauxEdges && width == 1)
		each([](auto& f, const double* row) {
			for (int k = 0; k < 3; ++k)
				(narrowed<int>(row[0]) >> k) & 1 ? f.SetF(k) : f.ClearF(k);
		});
	else if (a.kind == AttributeKind::Custom && width == 1 && a.type == NumberType::Float)
		setCustomOfFaces<float>(a, m);
	else if (a.kind == AttributeKind::Custom && width == 1)
		setCustomOfFaces<double>(a, m);
}

template <class MeshType>
void setOfCorners(const Attribute& a, MeshType& m)
{
	if (a.kind != AttributeKind::TexCoord || a.components != 3 || !vcg::tri::HasPerWedgeTexCoord(m))
		return;
	for (std::size_t f = 0; f < m.face.size(); ++f)
		for (int k = 0; k < 3; ++k) {
			const double* row = a.values.data() + 9 * f + 3 * std::size_t(k);
			auto& t           = m.face[f].WT(k);
			t.U()             = static_cast<std::decay_t<decltype(t.U())>>(row[0]);
			t.V()             = static_cast<std::decay_t<decltype(t.V())>>(row[1]);
			t.N()             = narrowed<short>(row[2]);
		}
}

} // namespace vcg_detail

/// Sets the attributes of `data` in `m`, which fromMeshData(data, m) has filled. Channels that `m`
/// does not have, or has switched off, are left out: see channelsOf().
template <class MeshType>
void setAttributes(const MeshData& data, MeshType& m)
{
	for (const Attribute& a : data.attributes)
		switch (a.of) {
		case AttributeOf::Vertex:
			vcg_detail::setOfVertices(a, m);
			break;
		case AttributeOf::Face:
			vcg_detail::setOfFaces(a, m);
			break;
		case AttributeOf::Corner:
			vcg_detail::setOfCorners(a, m);
			break;
		case AttributeOf::Mesh:
			if constexpr (vcg_detail::HasTransform<MeshType>::value)
				if (a.kind == AttributeKind::Transform && a.components == 16)
					for (int i = 0; i < 16; ++i)
						m.Tr.ElementAt(i / 4, i % 4) =
						    static_cast<typename MeshType::ScalarType>(a.values[std::size_t(i)]);
			break;
		}
	m.textures.assign(data.textures.begin(), data.textures.end());
}

} // namespace wavemesh
