// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What ties a layer to the `.wmc` it shows, and the few ways in which a level is put on a layer.
/// io_wavemesh leaves the compressed bytes on the layers it opens; filter_wavemesh finds them there.
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
	SharedBytes   bytes;           ///< a whole `.wmc`, or the part of it that was read
	int           level       = 0; ///< that the layer showed when this was written
	std::uint64_t fingerprint = 0; ///< of the mesh then: another one now means that it was edited
};

/// @return null if the layer has none
const LayerStream* findStream(const CMeshO& m);
void               keepStream(CMeshO& m, LayerStream stream);
void               dropStream(CMeshO& m);

/// Hash of the coordinates and the connectivity of the elements that are not deleted. Linear.
std::uint64_t fingerprint(const CMeshO& m);

/// Takes the mesh off the layer, with all it has. Leaves an empty one under the same transformation
/// and camera, and the layer's data mask telling so. Streams and other attributes go with the mesh.
CMeshO takeMesh(MeshModel& layer);

/// Puts a mesh, with the data mask its layer had, back in place of what the layer shows. The
/// transformation and the camera stay the layer's. Bit for bit: the elements are not copied.
void putMesh(MeshModel& layer, CMeshO&& mesh, int dataMask);

/// Shows `data` in place of the layer's mesh, which is lost: coordinates, connectivity, normals.
void showOnLayer(MeshModel& layer, const MeshData& data);

/// `label` with " (level 3 of 9)" after it, in place of the one it may have. Nothing after it for
/// the finest level.
QString levelLabel(const QString& label, int level, int finest);

/// What the layer has that a level cannot hold yet, in a user's words: "vertex colours", ...
QStringList attributesNotKept(const MeshModel& layer);

} // namespace wavemesh
