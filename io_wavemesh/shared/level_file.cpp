// SPDX-License-Identifier: GPL-3.0-or-later
#include "level_file.h"

#include <QFileInfo>
#include <QRegularExpression>

namespace wavemesh {

LevelFile levelFile(const QString& name)
{
	static const QRegularExpression pattern(
	    "^(.*)@(\\d{1,4})(\\.wmc)$", QRegularExpression::CaseInsensitiveOption);
	const auto match = pattern.match(name);
	if (!match.hasMatch() || QFileInfo::exists(name))
		return {name, -1};
	return {match.captured(1) + match.captured(3), match.captured(2).toInt()};
}

void nameLevelFile(MeshModel& layer, int level, int finest)
{
	QString name     = levelFile(layer.fullName()).file;
	const int suffix = name.lastIndexOf('.');
	if (QFileInfo(name).suffix().compare("wmc", Qt::CaseInsensitive) != 0)
		return;
	if (level < finest)
		name.insert(suffix, QString("@%1").arg(level));
	layer.setFileName(name);
}

} // namespace wavemesh
