// SPDX-License-Identifier: GPL-3.0-or-later
#include "encode_presets.h"

namespace wavemesh {

QStringList presetNames()
{
	return {"as set below", "smallest", "balanced", "best coarse levels", "exact"};
}

QString presetHelp()
{
	return "<b>as set below</b>: the options below count. The others set all of them but the "
	       "precision, the order and the bits of attributes:<br>"
	       "<b>smallest</b>: the fewest bytes for the whole mesh; tries many ways, which takes "
	       "four to twenty times as long as balanced.<br>"
	       "<b>balanced</b>: coarse levels close to the original, for up to 5 % more bytes than "
	       "smallest.<br>"
	       "<b>best coarse levels</b>: the closest coarse levels at any low rate, for up to "
	       "40 % more bytes than smallest.<br>"
	       "<b>exact</b>: balanced, and every coordinate and every number of attributes bit for "
	       "bit: two to six times as large.";
}

EncodeOptions optionsOf(Preset preset, EncodeOptions options)
{
	if (preset == Preset::Custom)
		return options;
	EncodeOptions chosen;
	chosen.bits      = options.bits;
	chosen.step      = options.step;
	chosen.keepOrder = options.keepOrder;
	switch (preset) {
	case Preset::Custom:
	case Preset::Balanced:
		break;
	case Preset::Smallest:
		chosen.optimize = Optimize::Size;
		chosen.effort   = 3;
		break;
	case Preset::BestCoarseLevels:
		chosen.optimize = Optimize::Levels;
		break;
	case Preset::Exact:
		chosen.exact = true;
		break;
	}
	return chosen;
}

} // namespace wavemesh
