// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How much work things are, so that progress moves evenly by time and not by level: measured on
/// meshes of 50 000 vertices. Only ratios count.
#pragma once

#include <wavemesh/codec.h>

#include <algorithm>

namespace wavemesh {

/// To read a level, and nearly as much to write it.
/// @param below  the level before; null: there is none
inline double levelWork(Mode mode, const LevelInfo& level, const LevelInfo* below)
{
	const double vertices = level.vertices;
	if (below == nullptr)
		return 10 * vertices;
	if (level.kind == LevelKind::Precise)
		return vertices * (14 + 6 * double(level.bits - below->bits));
	if (mode == Mode::Classic)
		return 8 * vertices;
	return 5 * vertices + 20 * std::max(0.0, vertices - double(below->vertices));
}

/// The part of a split that is connectivity, and comes first.
constexpr double kConnectivityWork = 0.35;

/// To read what follows the levels.
inline double featureWork(const StreamFeatures& f)
{
	return 30 * double(f.restorationBytes + f.orderBytes + f.exactBytes + f.attributeBytes);
}

} // namespace wavemesh
