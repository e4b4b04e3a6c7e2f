// SPDX-License-Identifier: GPL-3.0-or-later
#include "layer_attributes.h"

#include <wavemesh/vcg_wmc.h>

#include <wrap/io_trimesh/io_mask.h>

#include <algorithm>
#include <iterator>
#include <typeindex>
#include <utility>

namespace wavemesh {
namespace {

using Mask = vcg::tri::io::Mask;

/// A kind of data by all its names.
struct Kind
{
	int file;         ///< bit of a save dialog; 0: none
	int layer;        ///< bit of a layer's data mask; 0: every layer has it
	unsigned channel; ///< 0: the codec has none
	const char* name; ///< if its loss is worth a word
};

constexpr Kind kKinds[] = {
    {Mask::IOM_VERTCOLOR, MeshModel::MM_VERTCOLOR, kVertexColour, "vertex colours"},
    {Mask::IOM_VERTQUALITY, MeshModel::MM_VERTQUALITY, kVertexQuality, "vertex quality"},
    {Mask::IOM_VERTRADIUS, MeshModel::MM_VERTRADIUS, kVertexRadius, "vertex radius"},
    {Mask::IOM_VERTTEXCOORD, MeshModel::MM_VERTTEXCOORD, kVertexTexCoord,
     "vertex texture coordinates"},
    {Mask::IOM_VERTNORMAL, 0, kVertexNormal, nullptr},
    {Mask::IOM_VERTFLAGS, 0, kVertexSelection, nullptr},
    {Mask::IOM_WEDGTEXCOORD, MeshModel::MM_WEDGTEXCOORD, kWedgeTexCoord,
     "wedge texture coordinates"},
    {Mask::IOM_FACECOLOR, MeshModel::MM_FACECOLOR, kFaceColour, "face colours"},
    {Mask::IOM_FACEQUALITY, MeshModel::MM_FACEQUALITY, kFaceQuality, "face quality"},
    {Mask::IOM_FACENORMAL, 0, kFaceNormal, nullptr},
    {Mask::IOM_FACEFLAGS, 0, kFaceSelection, nullptr},
    {Mask::IOM_BITPOLYGONAL, MeshModel::MM_POLYGONAL, kFauxEdges, "polygons"},
};

bool has(const MeshModel& layer, const Kind& kind)
{
	return kind.layer == 0 || layer.hasDataMask(kind.layer);
}

bool hasFauxEdges(const CMeshO& m)
{
	return std::any_of(m.face.begin(), m.face.end(), [](const CFaceO& f) {
		return !f.IsD() && (f.IsF(0) || f.IsF(1) || f.IsF(2));
	});
}

/// Names of user-defined attributes, but for those that a file is given.
template <class Attributes>
QStringList userDefined(const Attributes& all, unsigned channels)
{
	const std::type_index kept[] = {
	    typeid(float), typeid(double), typeid(vcg::Point3<float>), typeid(vcg::Point3<double>)};
	QStringList names;
	for (const auto& a : all) {
		const bool hasPlace =
		    std::find(std::begin(kept), std::end(kept), a._type) != std::end(kept);
		if (!a._name.empty() && !(hasPlace && (channels & kCustom)))
			names << QString::fromStdString(a._name);
	}
	return names;
}

/// Switches on what `channels` need, which has to come before they are written.
void enable(CMeshO& m, unsigned channels)
{
	if (channels & kVertexTexCoord)
		m.vert.EnableTexCoord();
	if (channels & kVertexRadius)
		m.vert.EnableRadius();
	if (channels & kFaceColour)
		m.face.EnableColor();
	if (channels & kFaceQuality)
		m.face.EnableQuality();
	if (channels & kWedgeTexCoord)
		m.face.EnableWedgeTexCoord();
}

} // namespace

int saveCapability()
{
	int bits = 0;
	for (const Kind& kind : kKinds)
		bits |= kind.channel == kFauxEdges ? 0 : kind.file;
	return bits;
}

int saveDefault()
{
	return saveCapability() & ~(Mask::IOM_FLAGS | Mask::IOM_VERTNORMAL | Mask::IOM_FACENORMAL);
}

unsigned channelsOf(const MeshModel& layer, int saveMask)
{
	unsigned channels = 0;
	for (const Kind& kind : kKinds)
		if ((saveMask & kind.file) && has(layer, kind))
			channels |= kind.channel;
	if (channels & (kVertexTexCoord | kWedgeTexCoord))
		channels |= kTextures;
	channels &= ~unsigned(kFauxEdges);
	if (hasFauxEdges(layer.cm))
		channels |= kFauxEdges;
	if (layer.cm.Tr != Matrix44m::Identity())
		channels |= kTransform;
	return channels;
}

unsigned drawnChannels(const MeshModel& layer)
{
	const unsigned drawn = kVertexColour | kVertexQuality | kVertexRadius | kVertexTexCoord |
	                       kFaceColour | kFaceQuality | kWedgeTexCoord | kTextures;
	return channelsOf(layer, saveDefault()) & drawn;
}

QStringList attributesRounded(const StreamInfo& info)
{
	const auto nameOf = [](AttributeKind kind) {
		switch (kind) {
		case AttributeKind::Normal:
			return "normals";
		case AttributeKind::TexCoord:
			return "texture coordinates";
		case AttributeKind::Radius:
			return "radius";
		case AttributeKind::Quality:
			return "quality";
		default:
			return "attributes";
		}
	};
	QStringList names;
	for (const AttributeInfo& a : info.attributes)
		if (a.bits > 0)
			names << QString("%1 %2 to steps of %3 (%4 bits)")
			             .arg(
			                 a.of == AttributeOf::Vertex ? "vertex"
			                 : a.of == AttributeOf::Face ? "face"
			                                             : "wedge")
			             .arg(nameOf(a.kind))
			             .arg(a.step, 0, 'g', 3)
			             .arg(a.bits);
	return names;
}

QStringList attributesNotKept(const MeshModel& layer, unsigned channels)
{
	if (!hasFauxEdges(layer.cm))
		channels |= kFauxEdges; // triangles only: there is nothing to lose
	QStringList names;
	for (const Kind& kind : kKinds)
		if (kind.name != nullptr && has(layer, kind) && !(channels & kind.channel))
			names << kind.name;
	for (const auto& [of, list] :
	     {std::pair("vertices", userDefined(layer.cm.vert_attr, channels)),
	      std::pair("faces", userDefined(layer.cm.face_attr, channels))})
		if (!list.isEmpty())
			names
			    << QString("user-defined attributes of %1 (%2)").arg(QString(of), list.join(", "));
	if (layer.cm.en > 0)
		names << "edges";
	return names;
}

MeshData meshDataOf(const MeshModel& layer, unsigned channels)
{
	MeshData data = toMeshData(layer.cm);
	addAttributes(layer.cm, channels, data);
	return data;
}

LooseMesh makeMesh(const MeshData& data)
{
	const unsigned channels = channelsOf(data);
	LooseMesh made;
	made.mesh = std::make_unique<CMeshO>();
	CMeshO& m = *made.mesh;
	enable(m, channels);
	fromMeshData(data, m);
	// As MeshLab computes them when it opens a file.
	vcg::tri::UpdateNormal<CMeshO>::PerVertexAngleWeighted(m);
	setAttributes(data, m);
	if (!(channels & (kVertexTexCoord | kWedgeTexCoord)))
		m.textures.clear(); // of a finer level
	m.svn = int(vcg::tri::UpdateSelection<CMeshO>::VertexCount(m));
	m.sfn = int(vcg::tri::UpdateSelection<CMeshO>::FaceCount(m));
	for (const Kind& kind : kKinds)
		if (channels & kind.channel) {
			made.dataMask |= kind.layer;
			made.fileMask |= kind.file;
		}
	return made;
}

} // namespace wavemesh
