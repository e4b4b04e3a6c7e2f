// SPDX-License-Identifier: GPL-3.0-or-later
#include "level_list.h"

#include <shared/plugin_support.h>

#include <QStringList>

#include <algorithm>
#include <set>

namespace wavemesh {

void addLevelListParameters(RichParameterList& list)
{
	// Not "from": Python has a keyword of that name.
	list.addParam(RichInt("first", 0, "From level", "0 is the base mesh, the coarsest."));
	list.addParam(RichInt(
	    "last", kFinestLevel, "To level",
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
		const int first = clamped(std::max(0, integerOf(list, "first", 0)));
		const int last  = clamped(integerOf(list, "last", kFinestLevel));
		if (first > last)
			throw MLException("Wavemesh: 'first' is above 'last': no level is chosen.");
		for (int level = first; level <= last; level += step)
			chosen.insert(level);
	}
	return {chosen.begin(), chosen.end()};
}

} // namespace wavemesh
