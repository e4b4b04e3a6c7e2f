// SPDX-License-Identifier: GPL-3.0-or-later
#include "layer_levels.h"

#include <shared/layer_attributes.h>
#include <shared/plugin_support.h>

#include <wavemesh/vcg_wmc.h>

#include <algorithm>

namespace wavemesh {
namespace {

constexpr char kLevelsAttribute[] = "wavemesh.levels";

using Attributes = vcg::tri::Allocator<CMeshO>;

std::shared_ptr<LayerLevels>& levelsOn(CMeshO& m)
{
	return Attributes::GetPerMeshAttribute<std::shared_ptr<LayerLevels>>(m, kLevelsAttribute)();
}

} // namespace

LayerLevels::LayerLevels(std::shared_ptr<LevelDecoder> decoder) : decoder_(std::move(decoder))
{
	finest_ = info().finestLevel();
	away_.resize(info().levels.size());
	if (stream()->size() >= info().bytes)
		return;
	// A cut file: the last level may be there in part, and only the decoder knows.
	finest_ = decoder_->finestThatComes();
	if (finest_ < 0)
		throw MLException("Wavemesh: the layer's .wmc ends before its base mesh.");
}

std::shared_ptr<LayerLevels>
LayerLevels::find(MeshModel& layer, std::shared_ptr<LevelDecoder> ahead)
{
	const LayerStream* stream = findValidStream(layer.cm);
	if (stream == nullptr)
		return nullptr;
	std::shared_ptr<LayerLevels> levels = levelsOn(layer.cm);
	if (levels && levels->stream() == stream->bytes && levels->shown_ == stream->level)
		return levels;
	if (!ahead || ahead->stream() != stream->bytes)
		ahead = std::make_shared<LevelDecoder>(stream->bytes);
	return attach(layer, std::move(ahead), stream->level);
}

std::shared_ptr<LayerLevels>
LayerLevels::attach(MeshModel& layer, std::shared_ptr<LevelDecoder> decoder, int shown)
{
	const std::shared_ptr<LayerLevels> levels(new LayerLevels(std::move(decoder)));
	levels->shown_ = std::clamp(shown, 0, levels->finest_);
	levels->keepOn(layer, levels);
	return levels;
}

bool LayerLevels::areOn(const MeshModel& layer)
{
	using Levels = std::shared_ptr<LayerLevels>;
	auto handle  = Attributes::FindPerMeshAttribute<Levels>(layer.cm, kLevelsAttribute);
	return Attributes::IsValidHandle(layer.cm, handle) && handle();
}

void LayerLevels::detach(MeshModel& layer)
{
	Attributes::DeletePerMeshAttribute(layer.cm, kLevelsAttribute);
	dropStream(layer.cm);
}

void LayerLevels::keepOn(MeshModel& layer, std::shared_ptr<LayerLevels> self) const
{
	keepStream(layer.cm, stream(), shown_);
	levelsOn(layer.cm) = std::move(self);
}

void LayerLevels::show(MeshModel& layer, int level)
{
	if (level == shown_)
		return;
	const std::shared_ptr<LayerLevels> self = levelsOn(layer.cm);
	LooseMesh& wanted                       = away_[std::size_t(level)];
	const bool first                        = !wanted.mesh;
	// What can fail comes before the layer is touched.
	if (first) {
		wanted = makeMesh(decoder_->at(level));
		decoder_->forget(level);
	}

	detach(layer); // the levels must not go away with a mesh that they keep
	const int mask             = layer.dataMask();
	auto old                   = exchangeMesh(layer, std::move(wanted));
	away_[std::size_t(shown_)] = {std::move(old), mask, 0};
	shown_                     = level;
	if (first)
		layer.loadTextures(); // those that no level before had
	keepOn(layer, self);
}

void LayerLevels::copyTo(MeshModel& other, const MeshModel& layer, int level)
{
	other.cm.Tr           = layer.cm.Tr;
	const LooseMesh& away = away_[std::size_t(level)];
	if (level == shown_)
		exchangeMesh(other, {std::make_unique<CMeshO>(layer.cm), layer.dataMask(), 0});
	else if (away.mesh)
		exchangeMesh(other, {std::make_unique<CMeshO>(*away.mesh), away.dataMask, 0});
	else
		exchangeMesh(other, makeMesh(decoder_->at(level)));
	for (const std::string& name : other.cm.textures)
		other.addTexture(name, layer.getTexture(name));
	keepStream(other.cm, stream(), level);
}

MeshData LayerLevels::finestMesh(const MeshModel& layer)
{
	if (shown_ == finest_)
		return toMeshData(layer.cm);
	const LooseMesh& away = away_[std::size_t(finest_)];
	return away.mesh ? toMeshData(*away.mesh) : decoder_->at(finest_);
}

} // namespace wavemesh
