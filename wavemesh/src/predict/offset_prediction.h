// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Where a vertex is by least squares: each coordinate from what the vertex sees, and its height
/// above the surface once more, from where the tangent planes around pass.
#pragma once

#include "predict/vertex_view.h"

namespace wavemesh {

/// Fills in offset, plainOffset and height of a view. @pre its features are there
void predictOffset(const PositionModels& models, VertexView& view);

/// @param offset  where the vertex is, from the view's origin
void learnOffset(PositionModels& models, const VertexView& view, const Vector& offset);

} // namespace wavemesh
