// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Attributes as channels of a VCG mesh; see wavemesh/vcg_attributes.h.
#pragma once

#include <wavemesh/detail/vcg_take.h>

#include <limits>

namespace wavemesh::vcg_detail {

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

/// A user-defined attribute of type T. VCG would take one of the same name and another
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
		CustomValue<T>::assign(handle[v], a.values.data() + v * std::size_t(a.components));
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
		CustomValue<T>::assign(handle[f], a.values.data() + f * std::size_t(a.components));
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
	else if (a.kind == AttributeKind::Custom && a.type == NumberType::Float)
		width == 3   ? setCustomOfVertices<vcg::Point3<float>>(a, m)
		: width == 1 ? setCustomOfVertices<float>(a, m)
		             : void();
	else if (a.kind == AttributeKind::Custom)
		width == 3   ? setCustomOfVertices<vcg::Point3<double>>(a, m)
		: width == 1 ? setCustomOfVertices<double>(a, m)
		             : void();
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
	else if (a.kind == AttributeKind::Custom && a.type == NumberType::Float)
		width == 3   ? setCustomOfFaces<vcg::Point3<float>>(a, m)
		: width == 1 ? setCustomOfFaces<float>(a, m)
		             : void();
	else if (a.kind == AttributeKind::Custom)
		width == 3   ? setCustomOfFaces<vcg::Point3<double>>(a, m)
		: width == 1 ? setCustomOfFaces<double>(a, m)
		             : void();
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

} // namespace wavemesh::vcg_detail
