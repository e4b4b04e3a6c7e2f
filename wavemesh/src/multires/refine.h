// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One step of irregular subdivision, M^{j-1} -> M^j (paper sec. III, fig. 1, 2, 4, 5): the
/// decoder's half, and the encoder's proof that its coarsening can be undone.
#pragma once

#include "multires/refinement.h"

namespace wavemesh {

/// Which faces of `parent` may be the partner of a flip across `edgeCorner` (the corner, in the
/// 1:2 face, that faces the edge to flip), given the faces already involved in a flip: a face with
/// no child on that edge that is 1:1 or 1:2, shares no second edge, and neither of the two used
/// before.
///
/// @param flipped  #parent faces: 1 where the face already takes part in a flip
bool canFlip(
    const CornerTable& parent,
    const Refinement& refinement,
    const std::vector<std::uint8_t>& flipped,
    Index edgeCorner);

/// Subdivides `parent`. Face f's descendants are contiguous and in the order of the faces.
///
/// @param refinement  arrays must match `parent`; each flip must satisfy canFlip() in face order
/// @return connectivity of the finer level. Linear; never fails.
CornerTable refine(const CornerTable& parent, const Refinement& refinement);

} // namespace wavemesh
