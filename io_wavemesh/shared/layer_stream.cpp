// SPDX-License-Identifier: GPL-3.0-or-later
#include "layer_stream.h"

#include <wavemesh/vcg_wmc.h>

#include <QRegularExpression>

#include <cstring>
#include <utility>

namespace wavemesh {
namespace {

constexpr char kStreamAttribute[] = "wavemesh.stream";

/// Data that a layer need not have, and that a level does not bring.
constexpr int kOptionalData =
    MeshModel::MM_VERTCOLOR | MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTMARK |
    MeshModel::MM_VERTFACETOPO | MeshModel::MM_VERTCURVDIR | MeshModel::MM_VERTRADIUS |
    MeshModel::MM_VERTTEXCOORD | MeshModel::MM_FACECOLOR | MeshModel::MM_FACEQUALITY |
    MeshModel::MM_FACEMARK | MeshModel::MM_FACEFACETOPO | MeshModel::MM_FACECURVDIR |
    MeshModel::MM_WEDGTEXCOORD | MeshModel::MM_POLYGONAL;

using Attributes = vcg::tri::Allocator<CMeshO>;

/// CMeshO's swap leaves the transformation (which is the layer's) but forgets these counters.
void swapMeshes(CMeshO& onLayer, CMeshO& other)
{
	using std::swap;
	swap(onLayer, other);
	swap(onLayer.sfn, other.sfn);
	swap(onLayer.svn, other.svn);
	swap(onLayer.pfn, other.pfn);
	swap(onLayer.pvn, other.pvn);
	swap(onLayer.shot, other.shot); // back again: the camera is the layer's
}

} // namespace

const LayerStream* findStream(const CMeshO& m)
{
	auto handle = Attributes::FindPerMeshAttribute<LayerStream>(m, kStreamAttribute);
	return Attributes::IsValidHandle(m, handle) && handle().bytes ? &handle() : nullptr;
}

void keepStream(CMeshO& m, LayerStream stream)
{
	Attributes::GetPerMeshAttribute<LayerStream>(m, kStreamAttribute)() = std::move(stream);
}

void dropStream(CMeshO& m)
{
	Attributes::DeletePerMeshAttribute(m, kStreamAttribute);
}

int wholeLevels(const StreamInfo& info, std::uint64_t size)
{
	int count = 0;
	for (const LevelInfo& level : info.levels)
		count += level.prefix <= size;
	return count;
}

std::uint64_t fingerprint(const CMeshO& m)
{
	std::uint64_t hash = std::uint64_t(m.vn) * 0x9e3779b97f4a7c15ull + std::uint64_t(m.fn);
	const auto mix     = [&hash](std::uint64_t word) {
        hash = (hash ^ word) * 0x9e3779b97f4a7c15ull;
        hash ^= hash >> 29;
	};
	// Deleted vertices vanish when MeshLab compacts the mesh, which is no edit: count without them.
	std::vector<std::uint64_t> rank;
	std::uint64_t count = 0;
	if (m.vert.size() != std::size_t(m.vn))
		rank.resize(m.vert.size());
	for (std::size_t i = 0; i < m.vert.size(); ++i) {
		if (m.vert[i].IsD())
			continue;
		if (!rank.empty())
			rank[i] = count++;
		for (int k = 0; k < 3; ++k) {
			std::uint64_t word = 0;
			std::memcpy(&word, &m.vert[i].cP()[k], sizeof(Scalarm));
			mix(word);
		}
	}
	for (const CFaceO& f : m.face)
		for (int k = 0; k < 3 && !f.IsD(); ++k) {
			const std::size_t i = vcg::tri::Index(m, f.cV(k));
			mix(rank.empty() ? i : rank[i]);
		}
	return hash;
}

std::unique_ptr<CMeshO> makeMesh(const MeshData& data)
{
	auto mesh = std::make_unique<CMeshO>();
	fromMeshData(data, *mesh);
	// As MeshLab computes them when it opens a file.
	vcg::tri::UpdateNormal<CMeshO>::PerVertexAngleWeighted(*mesh);
	return mesh;
}

std::unique_ptr<CMeshO> exchangeMesh(MeshModel& layer, std::unique_ptr<CMeshO> mesh, int dataMask)
{
	auto old = std::make_unique<CMeshO>();
	// Clearing the data mask disables the data themselves: while no mesh is there to lose them.
	swapMeshes(layer.cm, *old);
	layer.clearDataMask(layer.dataMask() & kOptionalData);
	swapMeshes(layer.cm, *mesh);
	layer.updateDataMask(dataMask & kOptionalData);
	return old;
}

QString levelLabel(const QString& label, int level, int finest)
{
	QString text     = plainLabel(label);
	const int suffix = text.lastIndexOf('.');
	return text.insert(
	    suffix < 0 ? text.size() : suffix, QString(" (level %1 of %2)").arg(level).arg(finest));
}

QString plainLabel(QString label)
{
	return label.remove(QRegularExpression(" \\(level \\d+ of \\d+\\)(?=(\\.[^.]*)?$)"));
}

QStringList attributesNotKept(const MeshModel& layer)
{
	static const struct
	{
		int mask;
		const char* name;
	} kinds[] = {
	    {MeshModel::MM_VERTCOLOR, "vertex colours"},
	    {MeshModel::MM_VERTQUALITY, "vertex quality"},
	    {MeshModel::MM_VERTRADIUS, "vertex radius"},
	    {MeshModel::MM_VERTTEXCOORD, "vertex texture coordinates"},
	    {MeshModel::MM_WEDGTEXCOORD, "wedge texture coordinates"},
	    {MeshModel::MM_FACECOLOR, "face colours"},
	    {MeshModel::MM_FACEQUALITY, "face quality"},
	    {MeshModel::MM_POLYGONAL, "polygons (they become triangles)"},
	};
	QStringList names;
	for (const auto& kind : kinds)
		if (layer.hasDataMask(kind.mask))
			names << kind.name;
	if (layer.cm.en > 0)
		names << "edges";
	return names;
}

} // namespace wavemesh
