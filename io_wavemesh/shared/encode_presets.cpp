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
	       "precision:<br>"
	       "<b>smallest</b>: the fewest bytes for the whole mesh, whatever the coarse levels are "
	       "like; "
	       "encodes in several ways, which takes three times as long.<br>"
	       "<b>balanced</b>: smooth coarse levels, and within about 2 % of the smallest size.<br>"
	       "<b>best coarse levels</b>: coarse levels are closest to the original and keep sharp "
	       "edges; "
	       "on smooth shapes up to 3 % larger.<br>"
	       "<b>exact</b>: the finest lattice there is, 24 bits per coordinate: no coordinate moves "
	       "by "
	       "more than 1/33 000 000 of the extent; about three times as large as 12 bits.";
}

std::vector<EncodeOptions> optionsOf(Preset preset, EncodeOptions options)
{
	if (preset == Preset::Custom)
		return {options};
	const EncodeOptions defaults;
	options.mode         = defaults.mode;
	options.wgcSharpness = defaults.wgcSharpness;
	options.wgcDeviation = defaults.wgcDeviation;
	std::vector<EncodeOptions> all;
	switch (preset) {
	case Preset::Custom:
		break;
	case Preset::Smallest:
		options.wgc = Wgc::Auto;
		for (const int lifting : {kLiftingOff, 0, 2}) {
			options.lifting = lifting;
			all.push_back(options);
		}
		return all;
	case Preset::Balanced:
		options.lifting = 0;
		options.wgc     = Wgc::Auto;
		break;
	case Preset::BestCoarseLevels:
		options.lifting = 0;
		options.wgc     = Wgc::On;
		break;
	case Preset::Exact:
		options.lifting = kLiftingOff;
		options.wgc     = Wgc::Auto;
		options.step    = 0;
		options.bits    = 24;
		break;
	}
	return {options};
}

} // namespace wavemesh
