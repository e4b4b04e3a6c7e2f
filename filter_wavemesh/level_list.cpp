// SPDX-License-Identifier: GPL-3.0-or-later
#include "level_list.h"

#include <shared/plugin_support.h>

#include <QStringList>

#include <algorithm>
#include <set>

namespace wavemesh {

void addLevelListParameters(RichParameterList& list)
{
	list.addParam(RichInt("from", 0, "From level", "0 is the base mesh, the coarsest."));
	list.addParam(RichInt(
	    "to", kFinestLevel, "To level",
	    "-1, or a number larger than there are levels, is the finest level."));
	list.addParam(
	    RichInt("step", 1, "Step", "Every how many levels: 1 for each, 2 for every other."));
	list.addParam(RichString(
	    "levels", "", "Or these levels",
	    "A list of levels, such as <i>0, 2, 5, -1</i>, used in place of the range above. -1 is the "
	    "finest level."));
}

std::vector<int> levelList(const RichParameterList& list, int finest)
{
	const auto clamped = [finest](int level) {
		return level < 0 ? finest : std::min(level, finest);
	};
	std::set<int> chosen;
	const QString text = textOf(list, "levels", "").simplified();
	if (!text.isEmpty()) {
		for (const QString& word : text.split(text.contains(',') ? ',' : ' ')) {
			bool isNumber   = false;
			const int level = word.trimmed().toInt(&isNumber);
			if (!isNumber)
				throw MLException("Wavemesh: '" + word + "' in the list of levels is no level.");
			chosen.insert(clamped(level));
		}
	}
	else {
		const int step = integerOf(list, "step", 1);
		if (step < 1)
			throw MLException("Wavemesh: 'step' has to be 1 or more.");
		const int from = clamped(std::max(0, integerOf(list, "from", 0)));
		const int to   = clamped(integerOf(list, "to", kFinestLevel));
		if (from > to)
			throw MLException("Wavemesh: 'from' is above 'to': no level is chosen.");
		for (int level = from; level <= to; level += step)
			chosen.insert(level);
	}
	return {chosen.begin(), chosen.end()};
}

} // namespace wavemesh
