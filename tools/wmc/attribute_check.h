// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Do the attributes of a decoded mesh belong to the same elements as the original's?
#pragma once

#include "isomorphism.h"

#include <wavemesh/codec.h>

#include <string>

namespace wavemesh::tool {

/// The attributes of `decoded` next to those of the original, whatever the order of vertices, faces
/// and corners: bit for bit, or within half the step that `info` states.
///
/// @param originalPlaces, decodedPlaces  the two with labels at their vertices that agree
/// @return empty, or which attribute is not as promised
std::string whatDiffersInAttributes(
    const MeshData& original,
    const LabelledMesh& originalPlaces,
    const MeshData& decoded,
    const LabelledMesh& decodedPlaces,
    const StreamInfo& info);

} // namespace wavemesh::tool
