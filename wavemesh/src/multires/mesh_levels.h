// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The levels of a mesh as the caller has it, without a file.
#pragma once

#include "multires/hierarchy.h"

#include <wavemesh/multiresolution.h>

namespace wavemesh {

/// Coarsens `mesh`, and refines it again: levels numbered from the base up; Replay::source leads
/// back to the rows of the mesh. Takes the first 8/10 of the progress.
/// @return InvalidArgument, Unsupported, LimitExceeded, Cancelled
Result<Replay> replayLevels(const MeshData& mesh, const MultiresolutionOptions& options);

} // namespace wavemesh
