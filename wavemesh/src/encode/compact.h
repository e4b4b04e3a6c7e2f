// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The levels of a file in the compact mode: splits, and refinements that make positions more
/// precise.
#pragma once

#include "attributes/attribute_levels.h"
#include "encode/level_writer.h"
#include "encode/levels.h"
#include "encode/schedule.h"

namespace wavemesh {

/// Writes the levels as the schedule has it.
///
/// @param head  mode, lattice and features are set; the level table is filled in
/// @param attributes  writes those of the levels; or nullptr
/// @return false if the user cancelled
bool writeCompact(
    const Levels& levels,
    const Schedule& schedule,
    AttributeWriter* attributes,
    Head& head,
    std::vector<std::uint8_t>& chunks,
    const Stage& stage);

} // namespace wavemesh
