// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Names of levels as files. All that MeshLab's projects and *Reload* remember of a layer is the
/// name of its file: so a layer that shows level 3 of bunny.wmc is called bunny@3.wmc, and opening
/// a file of that name, where there is none, opens level 3 of bunny.wmc.
#pragma once

#include <common/ml_document/mesh_model.h>

#include <QString>

namespace wavemesh {

struct LevelFile
{
	QString file;   ///< the one to read
	int level = -1; ///< -1: the name does not tell
};

/// What a name means. A file that is there means itself.
LevelFile levelFile(const QString& name);

/// Names the layer's file by the level that it shows: the whole file's own name if that is the
/// finest. Leaves layers alone that came from no .wmc.
void nameLevelFile(MeshModel& layer, int level, int finest);

} // namespace wavemesh
