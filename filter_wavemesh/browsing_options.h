// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How a layer that came from no .wmc is encoded to make its levels.
#pragma once

#include <wavemesh/codec.h>

namespace wavemesh {

/// Coordinates of coarse levels are to look as good as the original's; size matters less here.
inline EncodeOptions browsingOptions()
{
	EncodeOptions options;
	options.mode     = Mode::Classic;
	options.bits     = 16;
	options.optimize = Optimize::Levels;
	options.effort   = 1;
	return options;
}

} // namespace wavemesh
