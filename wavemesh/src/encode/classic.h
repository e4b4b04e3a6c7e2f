// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The levels of a file in the classic mode: every refinement is a split at full precision.
#pragma once

#include "attributes/attribute_levels.h"
#include "encode/level_writer.h"
#include "encode/levels.h"

namespace wavemesh {

/// Analyses the levels and writes them; `levels` is used up on the way, its finest table and
/// positions are left.
///
/// @param head  mode, lifting, lattice and features are set; the level table is filled in
/// @param attributes  writes those of the levels; or nullptr
/// @return false if the user cancelled
bool writeClassic(
    Levels& levels,
    AttributeWriter* attributes,
    Head& head,
    std::vector<std::uint8_t>& chunks,
    const Stage& stage);

} // namespace wavemesh
