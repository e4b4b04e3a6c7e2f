// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The levels of a layer, at hand for browsing.
#pragma once

#include "level_decoder.h"

#include <shared/layer_attributes.h>
#include <shared/layer_stream.h>

#include <wavemesh/codec.h>

#include <memory>
#include <vector>

namespace wavemesh {

/// The levels of one layer: a decoder with those that it passed, and every mesh that the layer has
/// shown, while it shows another. All of them together hold less than twice what the finest does.
///
/// Kept on the layer between the calls, so that it lives and dies with it.
/// Invariant: whoever comes back to a level gets the mesh that was taken from the layer there, with
/// its colours and all else, or, where there was none, the decoded one.
class LayerLevels
{
public:
	/// The levels of what the layer shows, if it still shows what was last put there.
	/// @param ahead  may be null; taken if it is for this stream and there are no levels yet
	/// @return null if the layer has no stream, or was edited since
	static std::shared_ptr<LayerLevels>
	find(MeshModel& layer, std::shared_ptr<LevelDecoder> ahead = nullptr);

	/// Begins anew, with a stream whose level `shown` is what the layer shows: what is not decoded
	/// from it is the layer's own. Replaces what may be on the layer.
	static std::shared_ptr<LayerLevels>
	attach(MeshModel& layer, std::shared_ptr<LevelDecoder> decoder, int shown);

	/// Does the layer have levels, be they those of its mesh or of one that was edited since?
	static bool areOn(const MeshModel& layer);

	/// Takes levels and stream off the layer; the mesh stays as it is.
	static void detach(MeshModel& layer);

	/// What the head of the stream says of each level.
	const StreamInfo& info() const { return decoder_->info(); }
	/// The finest level there is: below info().finestLevel() if the stream is cut.
	int finest() const { return finest_; }
	int shown() const { return shown_; }

	/// Shows a level, 0..finest(). Cost: decoding, once, the levels up to it that were not decoded
	/// before, and making a mesh of each that is shown; then next to nothing.
	void show(MeshModel& layer, int level);

	/// Puts a level on another layer: a copy of what this one shows there, or would show.
	/// @param layer  the one these levels belong to
	void copyTo(MeshModel& other, const MeshModel& layer, int level);

	/// The finest level as the codec takes it: what the layer had, or what is decoded.
	/// @param layer  the one these levels belong to
	MeshData finestMesh(const MeshModel& layer);

	const SharedBytes& stream() const { return decoder_->stream(); }

private:
	explicit LayerLevels(std::shared_ptr<LevelDecoder> decoder);
	void keepOn(MeshModel& layer, std::shared_ptr<LayerLevels> self) const;

	std::shared_ptr<LevelDecoder> decoder_;
	std::vector<LooseMesh> away_; ///< by level; empty where the layer has not been
	int finest_ = 0;
	int shown_  = 0;
};

} // namespace wavemesh
