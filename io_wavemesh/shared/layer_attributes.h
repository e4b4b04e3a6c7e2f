// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// MeshLab's names for what a layer has besides its shape (the bits of a save dialog, the data mask
/// of a layer) and the codec's channels, and the way from the one to the other.
#pragma once

#include <wavemesh/codec.h>
#include <wavemesh/vcg_attributes.h>

#include <common/ml_document/mesh_model.h>

#include <QStringList>

#include <memory>

namespace wavemesh {

/// What can be chosen in a save dialog, as bits of vcg::tri::io::Mask.
int saveCapability();
/// What is chosen there at first: as with PLY, all but flags and normals.
int saveDefault();

/// The channels that `layer` has of those in `saveMask` (bits of vcg::tri::io::Mask), and, whatever
/// the mask, its faux edges and its transformation if it has any. User-defined attributes are not
/// among them.
unsigned channelsOf(const MeshModel& layer, int saveMask);

/// The channels that `layer` has and that it is drawn with: what coarse levels show.
unsigned drawnChannels(const MeshModel& layer);

/// What `layer` has and `channels` do not, in a user's words: "vertex colours", ...
QStringList attributesNotKept(const MeshModel& layer, unsigned channels);

/// The attributes that a file has rounded, each with its step, in a user's words.
QStringList attributesRounded(const StreamInfo& info);

/// The layer's mesh with `channels`, as the codec takes it.
MeshData meshDataOf(const MeshModel& layer, unsigned channels);

/// A mesh that is on no layer, and what MeshLab has to be told of it.
struct LooseMesh
{
	std::unique_ptr<CMeshO> mesh;
	int dataMask = 0; ///< of MeshModel: the optional data that are switched on
	int fileMask = 0; ///< of vcg::tri::io::Mask: what came from the file
};

/// A mesh for a layer, from decoded arrays: bounding box, the attributes, and normals where these
/// have none.
LooseMesh makeMesh(const MeshData& data);

} // namespace wavemesh
