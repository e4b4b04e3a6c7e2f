// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What ties a layer to the `.wmc` it shows, and the few ways in which a level is put on a layer.
/// io_wavemesh leaves the compressed bytes on the layers it opens; filter_wavemesh finds them.
#pragma once

#include <wavemesh/codec.h>

#include <common/ml_document/mesh_model.h>

#include <QString>
#include <QStringList>

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
	SharedBytes bytes;             ///< a whole `.wmc`, or the part of it that was read
	int level                 = 0; ///< that the layer showed when this was written
	std::uint64_t fingerprint = 0; ///< of the mesh then: another one now means that it was edited
};

/// @return null if the layer has none
const LayerStream* findStream(const CMeshO& m);
void keepStream(CMeshO& m, LayerStream stream);
void dropStream(CMeshO& m);

/// How many levels, from the base mesh on, the first `size` bytes of a stream hold whole.
int wholeLevels(const StreamInfo& info, std::uint64_t size);

/// Hash of the coordinates and the connectivity of the elements that are not deleted. Linear.
std::uint64_t fingerprint(const CMeshO& m);

/// A mesh for a layer, with normals and bounding box, from decoded arrays.
std::unique_ptr<CMeshO> makeMesh(const MeshData& data);

/// Exchanges what the layer shows for `mesh`, and its data mask of optional data for `dataMask`.
/// The transformation and the camera stay the layer's. No element is copied: what comes back can be
/// put back, bit for bit.
/// @return the mesh that was there, with its attributes (streams among them)
std::unique_ptr<CMeshO>
exchangeMesh(MeshModel& layer, std::unique_ptr<CMeshO> mesh, int dataMask = MeshModel::MM_NONE);

/// A layer's label with the level in it: "bunny.wmc" becomes "bunny (level 3 of 9).wmc", since
/// MeshLab's list of layers hides what looks like a suffix. Replaces the level it may have.
QString levelLabel(const QString& label, int level, int finest);

/// The label without the level.
QString plainLabel(QString label);

/// What the layer has that a level cannot hold yet, in a user's words: "vertex colours", ...
QStringList attributesNotKept(const MeshModel& layer);

} // namespace wavemesh
