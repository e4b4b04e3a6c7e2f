// SPDX-License-Identifier: GPL-3.0-or-later
#include "layer_stream.h"

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

/// How closely a layer that shows the stream's level is compared with it.
Extent comparedOf(const LayerStream& stream)
{
	return stream.finest ? Extent::Attributes : Extent::Shape;
}

class Hash
{
public:
	explicit Hash(std::uint64_t seed) : hash_(seed) {}
	void mix(std::uint64_t word)
	{
		hash_ = (hash_ ^ word) * 0x9e3779b97f4a7c15ull;
		hash_ ^= hash_ >> 29;
	}
	template <class Number>
	void mixBits(Number number)
	{
		std::uint64_t word = 0;
		std::memcpy(&word, &number, sizeof number);
		mix(word);
	}
	void mixColour(const vcg::Color4b& c)
	{
		for (int k = 0; k < 4; ++k)
			mix(c[k]);
	}
	template <class TexCoord>
	void mixTexCoord(const TexCoord& t)
	{
		mixBits(t.U());
		mixBits(t.V());
		mixBits(t.N());
	}
	std::uint64_t value() const { return hash_; }

private:
	std::uint64_t hash_;
};

void mixAttributes(const CMeshO& m, Hash& hash)
{
	for (const CVertexO& v : m.vert) {
		if (v.IsD())
			continue;
		hash.mixColour(v.cC());
		hash.mixBits(v.cQ());
		if (m.vert.IsTexCoordEnabled())
			hash.mixTexCoord(v.cT());
		if (m.vert.IsRadiusEnabled())
			hash.mixBits(v.cR());
	}
	for (const CFaceO& f : m.face) {
		if (f.IsD())
			continue;
		if (m.face.IsColorEnabled())
			hash.mixColour(f.cC());
		if (m.face.IsQualityEnabled())
			hash.mixBits(f.cQ());
		if (m.face.IsWedgeTexCoordEnabled())
			for (int k = 0; k < 3; ++k)
				hash.mixTexCoord(f.cWT(k));
	}
}

} // namespace

const LayerStream* findStream(const CMeshO& m)
{
	auto handle = Attributes::FindPerMeshAttribute<LayerStream>(m, kStreamAttribute);
	return Attributes::IsValidHandle(m, handle) && handle().bytes ? &handle() : nullptr;
}

const LayerStream* findValidStream(const CMeshO& m)
{
	const LayerStream* stream = findStream(m);
	return stream != nullptr && stream->fingerprint == fingerprint(m, comparedOf(*stream))
	           ? stream
	           : nullptr;
}

void keepStream(CMeshO& m, SharedBytes bytes, int level)
{
	LayerStream stream;
	const auto info    = readInfo(bytes->data(), bytes->size());
	stream.finest      = info.ok() && level == info->finestLevel() && bytes->size() >= info->bytes;
	stream.bytes       = std::move(bytes);
	stream.level       = level;
	stream.fingerprint = fingerprint(m, comparedOf(stream));
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

std::uint64_t fingerprint(const CMeshO& m, Extent extent)
{
	Hash hash(std::uint64_t(m.vn) * 0x9e3779b97f4a7c15ull + std::uint64_t(m.fn));
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
		for (int k = 0; k < 3; ++k)
			hash.mixBits(m.vert[i].cP()[k]);
	}
	for (const CFaceO& f : m.face)
		for (int k = 0; k < 3 && !f.IsD(); ++k) {
			const std::size_t i = vcg::tri::Index(m, f.cV(k));
			hash.mix(rank.empty() ? i : rank[i]);
		}
	if (extent == Extent::Attributes)
		mixAttributes(m, hash);
	return hash.value();
}

std::unique_ptr<CMeshO> exchangeMesh(MeshModel& layer, LooseMesh loose)
{
	auto old = std::make_unique<CMeshO>();
	// Clearing the data mask disables the data themselves: while no mesh is there to lose them.
	swapMeshes(layer.cm, *old);
	layer.clearDataMask(layer.dataMask() & kOptionalData);
	swapMeshes(layer.cm, *loose.mesh);
	layer.updateDataMask(loose.dataMask & kOptionalData);
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

} // namespace wavemesh
