// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A picture of a mesh without a graphics card or a window.
#pragma once

#include <wavemesh/mesh_data.h>

#include <QImage>

namespace wavemesh {

/// Draws the mesh, seen from a little above and aside, filling the picture, lit from behind the
/// eye, on a transparent ground. Both sides of a face are drawn.
/// @param mesh  at least one face
/// @param size  of the square picture in pixels, 1..2048
QImage pictureOf(const MeshData& mesh, int size);

} // namespace wavemesh
