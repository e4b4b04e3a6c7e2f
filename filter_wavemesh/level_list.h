// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Which levels become layers.
#pragma once

#include <common/parameters/rich_parameter_list.h>

#include <vector>

namespace wavemesh {

void addLevelListParameters(RichParameterList& list);

/// The chosen levels, ascending, none twice, all in 0..finest, at least one.
/// @throws MLException naming what is wrong
std::vector<int> levelList(const RichParameterList& list, int finest);

} // namespace wavemesh
