// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a simplification is asked to reach, and the level that reaches it.
#pragma once

#include <wavemesh/codec.h>

#include <common/ml_document/mesh_model.h>
#include <common/parameters/rich_parameter_list.h>

#include <QString>

namespace wavemesh {

struct SimplifyTarget
{
	/// In the order of the dialog's list.
	enum Kind { LevelsRemoved, Level, Vertices, Percentage, Bytes, Error };

	Kind kind    = LevelsRemoved;
	double value = 1; ///< levels, vertices, percent, bytes or model units
};

/// Appends one parameter for the kind and one for the value of each kind.
void addTargetParameters(RichParameterList& list, const MeshModel& layer);

/// Reads them back; what a script leaves out has the value that the dialog would show for `layer`.
/// @throws MLException if a value makes no sense (a negative number of vertices, ...)
SimplifyTarget simplifyTarget(const RichParameterList& list, const MeshModel& layer);

struct ChosenLevel
{
	int level = 0;
	bool met  = true; ///< false: no level reaches the target, this is the one closest to it
};

/// Vertices, percentage and bytes are ceilings: the finest level below them. The error is one too:
/// the coarsest level below it. Levels are clamped to those there are.
ChosenLevel chooseLevel(const StreamInfo& info, const SimplifyTarget& target);

} // namespace wavemesh
