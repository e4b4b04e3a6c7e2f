// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How much work things are, so that progress moves evenly by time and not by level: measured on
/// meshes of 6 000 to 500 000 vertices, with every set of predictors. Only ratios count.
#pragma once

#include <wavemesh/codec.h>

#include <algorithm>
#include <array>

namespace wavemesh {

inline double attributeWork(const LevelInfo& level)
{
	return 17 * double(level.attributeBytes);
}

/// To read a level, and nearly as much to write it.
/// @param below  the level before; null: there is none
inline double levelWork(Mode mode, const LevelInfo& level, const LevelInfo* below)
{
	const double vertices = level.vertices, attributes = attributeWork(level);
	if (below == nullptr)
		return 10 * vertices + attributes;
	if (level.kind == LevelKind::Precise)
		return vertices * (4 + 9 * double(level.bits - below->bits)) + attributes;
	if (mode == Mode::Classic)
		return 8 * vertices + attributes;
	return 5 * vertices + 20 * std::max(0.0, vertices - double(below->vertices)) + attributes;
}

/// The part of a split that is connectivity, and comes first.
constexpr double kConnectivityWork = 0.35;

/// To read what follows the levels: restoration, order, exact coordinates, the attributes' rest.
inline std::array<double, 4> featureWork(const StreamInfo& info)
{
	const StreamFeatures& f = info.features;
	double rest             = double(f.attributeBytes);
	for (const LevelInfo& level : info.levels)
		rest -= double(level.attributeBytes);
	return {
	    30 * double(f.restorationBytes), (f.orderKept ? 27.0 : 0.0) * info.vertices,
	    (f.exact ? 6.0 : 0.0) * info.vertices, 17 * std::max(0.0, rest)};
}

} // namespace wavemesh
