// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The optional channels of a VCG mesh as attributes of a MeshData, and back. Header only, for any
/// VCG mesh type: what the type does not have, or has switched off, is left out.
#pragma once

#include <wavemesh/detail/vcg_set.h>
#include <wavemesh/detail/vcg_take.h>

namespace wavemesh {

/// Adds the channels of `m` to what toMeshData(m) made of it. `m` is not modified.
/// @param channels  of VcgChannel, combined; those that `m` does not have are left out
template <class MeshType>
void addAttributes(const MeshType& m, unsigned channels, MeshData& data)
{
	vcg_detail::addOfVertices(m, channels, data);
	vcg_detail::addOfFaces(m, channels, data);
	if (channels & kCustom) {
		vcg_detail::addCustom<float>(m, data);
		vcg_detail::addCustom<double>(m, data);
		vcg_detail::addCustom<vcg::Point3<float>>(m, data);
		vcg_detail::addCustom<vcg::Point3<double>>(m, data);
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
