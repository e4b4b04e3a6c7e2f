// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How far the levels of a mesh are from the finest: an estimate from what each split moves, for
/// the encoder's schedule. Costs no distance search.
#pragma once

#include "encode/levels.h"

namespace wavemesh {

/// @return for each level, coarsest first, about the root mean square of the distance of its
///         surface from the finest level's, both at full precision; lattice units, 0 for the
///         finest. Within a factor of two of what sampling measures on smooth surfaces. Linear.
std::vector<double> levelErrors(const Levels& levels);

} // namespace wavemesh
