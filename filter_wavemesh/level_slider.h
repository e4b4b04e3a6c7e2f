// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The slider of Browse Levels: how its way divides among the levels, and what it tells of them.
#pragma once

#include <wavemesh/codec.h>

#include <common/parameters/rich_parameter_list.h>

#include <QString>

namespace wavemesh {

/// What the slider's way from the left to the right is divided by.
enum class Snap { Level, Bytes, Error };

/// The levels that can be shown: all of a file, or fewer if it is cut.
struct LevelRange
{
	StreamInfo info;
	int finest = 0; ///< that can be shown
	int shown  = 0;
};

/// "12 345 vertices", ... of one level, in short lines: the label of the slider.
QString levelCard(const LevelRange& range, int level);

void addSliderParameters(RichParameterList& list, const LevelRange& range);

/// The level that is asked for, 0..finest.
/// @throws MLException if a parameter makes no sense
int chosenLevel(const RichParameterList& list, const StreamInfo& info, int finest);

/// The level at `way`, 0..1, of the slider. By bytes: the finest level within a size that grows by
/// equal factors along the way; by error: the coarsest level within an error that falls so. Either
/// way 0 is the base mesh and 1 the finest level.
int levelAt(const StreamInfo& info, int finest, double way, Snap snap);

} // namespace wavemesh
