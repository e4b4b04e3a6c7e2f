// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Meshes and options made of bytes.
#pragma once

#include "fuzz_check.h"

#include <wavemesh/codec.h>

namespace wavemesh::test {

/// Any options that are in range.
EncodeOptions drawnOptions(ByteSource& in);

/// Up to 255 vertices, any faces: pieces of surface, and whatever is none. Any numbers for
/// coordinates, any attributes, all well formed.
MeshData drawnMesh(ByteSource& in);

} // namespace wavemesh::test
