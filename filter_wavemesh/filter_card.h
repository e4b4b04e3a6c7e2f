// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What MeshLab shows of each filter before it runs.
#pragma once

#include <QString>

namespace wavemesh {

struct FilterCard
{
	QString name;       ///< in the menu
	QString pythonName; ///< in scripts
	QString info;       ///< on top of the dialog, HTML
	int classes;        ///< FilterPlugin::FilterClass, or'ed: the submenus
	int postCondition;  ///< MeshModel::MeshElement, or'ed: decides whether there is a preview
};

/// @param filter  FilterWavemeshPlugin::Filters; another one gives an empty card
const FilterCard& filterCard(int filter);

} // namespace wavemesh
