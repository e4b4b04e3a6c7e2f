// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What ties a layer to the `.wmc` it shows, and the few ways in which a level is put on a layer.
/// io_wavemesh leaves the compressed bytes on the layers it opens; filter_wavemesh finds them.
#pragma once

#include "layer_attributes.h"

#include <wavemesh/codec.h>

#include <common/ml_document/mesh_model.h>

#include <QString>

#include <cstdint>
#include <memory>
#include <vector>

namespace wavemesh {

using SharedBytes = std::shared_ptr<const std::vector<std::uint8_t>>;

/// Kept on the layer as a per-mesh attribute of VCG. Both plugins compile this very definition;
/// VCG compares name and size of an attribute, no run-time type, so that it crosses from one to the
/// other. It goes with the layer and does not follow a duplicate of it.
struct LayerStream
{
	SharedBytes bytes;                 ///< a whole `.wmc`, or the part of it that was read
	int level                 = 0;     ///< that the layer showed when this was written
	bool finest               = false; ///< is it the finest, whole?
	std::uint64_t fingerprint = 0; ///< of the mesh then: another one now means that it was edited
};

/// @return null if the layer has none
const LayerStream* findStream(const CMeshO& m);
/// The stream of a layer that was not edited since keepStream(). Colours and the like of the finest
/// level count too; a coarse level may be coloured and stays a level.
/// @return null if there is none
const LayerStream* findValidStream(const CMeshO& m);
/// Keeps the stream whose level `level` the layer shows now.
void keepStream(CMeshO& m, SharedBytes bytes, int level);
void dropStream(CMeshO& m);

/// How many levels, from the base mesh on, the first `size` bytes of a stream hold whole.
int wholeLevels(const StreamInfo& info, std::uint64_t size);

/// What a fingerprint is taken of.
enum class Extent {
	Shape,      ///< coordinates and connectivity
	Attributes, ///< these, colours, quality, radius and texture coordinates; not what MeshLab
	            ///< computes or changes by itself: normals, selection, names of textures
};

/// Hash of the elements that are not deleted. Linear.
std::uint64_t fingerprint(const CMeshO& m, Extent extent);

/// Exchanges what the layer shows for `loose`, and its data mask of optional data for that one's.
/// The transformation and the camera stay the layer's. No element is copied: what comes back can be
/// put back, bit for bit.
/// @return the mesh that was there, with its attributes (streams among them)
std::unique_ptr<CMeshO> exchangeMesh(MeshModel& layer, LooseMesh loose);

/// A layer's label with the level in it: "bunny.wmc" becomes "bunny (level 3 of 9).wmc", since
/// MeshLab's list of layers hides what looks like a suffix. Replaces the level it may have.
QString levelLabel(const QString& label, int level, int finest);

/// The label without the level.
QString plainLabel(QString label);

} // namespace wavemesh
