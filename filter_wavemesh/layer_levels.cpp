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

LayerLevels::LayerLevels(SharedBytes stream, Decoder decoder) :
        stream_(std::move(stream)), decoder_(std::move(decoder))
{
	finest_ = info().finestLevel();
	away_.resize(info().levels.size());
	if (stream_->size() >= info().bytes)
		return;
	// A cut file: the last level may be there in part, and only the decoder knows.
	while (decoder_.level() < finest_) {
		const Status status = decoder_.advance();
		if (decoder_.level() == int(passed_.size()))
			passed_.push_back(decoder_.mesh());
		if (!status.ok())
			break;
	}
	if (passed_.empty())
		throw MLException("Wavemesh: the layer's .wmc ends before its base mesh.");
	finest_ = decoder_.level();
}

std::shared_ptr<LayerLevels> LayerLevels::find(MeshModel& layer)
{
	const LayerStream* stream = findValidStream(layer.cm);
	if (stream == nullptr)
		return nullptr;
	std::shared_ptr<LayerLevels> levels = levelsOn(layer.cm);
	if (levels && levels->stream_ == stream->bytes && levels->shown_ == stream->level)
		return levels;
	return attach(layer, stream->bytes, stream->level);
}

std::shared_ptr<LayerLevels> LayerLevels::attach(MeshModel& layer, SharedBytes stream, int shown)
{
	auto decoder = Decoder::open(stream->data(), stream->size());
	require(decoder.status(), "Cannot browse the levels");
	const std::shared_ptr<LayerLevels> levels(
	    new LayerLevels(std::move(stream), std::move(*decoder)));
	levels->shown_ = std::clamp(shown, 0, levels->finest_);
	levels->keepOn(layer, levels);
	return levels;
}

void LayerLevels::detach(MeshModel& layer)
{
	Attributes::DeletePerMeshAttribute(layer.cm, kLevelsAttribute);
	dropStream(layer.cm);
}

void LayerLevels::keepOn(MeshModel& layer, std::shared_ptr<LayerLevels> self) const
{
	keepStream(layer.cm, stream_, shown_);
	levelsOn(layer.cm) = std::move(self);
}

const MeshData& LayerLevels::decoded(int level)
{
	while (int(passed_.size()) <= level) {
		require(decoder_.advance(), "Cannot decode the level");
		passed_.push_back(decoder_.mesh());
	}
	return passed_[std::size_t(level)];
}

void LayerLevels::show(MeshModel& layer, int level)
{
	if (level == shown_)
		return;
	const std::shared_ptr<LayerLevels> self = levelsOn(layer.cm);
	LooseMesh& wanted                       = away_[std::size_t(level)];
	const bool first                        = !wanted.mesh;
	// What can fail comes before the layer is touched.
	if (first)
		wanted = makeMesh(decoded(level));

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
	const LooseMesh& away = away_[std::size_t(finest_)];
	if (level != finest_ || (!away.mesh && shown_ != finest_))
		exchangeMesh(other, makeMesh(decoded(level)));
	else {
		const CMeshO& mesh = away.mesh ? *away.mesh : layer.cm;
		const int mask     = away.mesh ? away.dataMask : layer.dataMask();
		exchangeMesh(other, {std::make_unique<CMeshO>(mesh), mask, 0});
	}
	for (const std::string& name : other.cm.textures)
		other.addTexture(name, layer.getTexture(name));
	keepStream(other.cm, stream_, level);
}

MeshData LayerLevels::finestMesh(const MeshModel& layer)
{
	if (shown_ == finest_)
		return toMeshData(layer.cm);
	const LooseMesh& away = away_[std::size_t(finest_)];
	return away.mesh ? toMeshData(*away.mesh) : decoded(finest_);
}

} // namespace wavemesh
