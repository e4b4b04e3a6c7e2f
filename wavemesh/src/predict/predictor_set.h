// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace wavemesh {

/// Which predictors the positions of a compact file ask (position_models.h); the values are those
/// in its head.
enum class PredictorSet : std::uint8_t {
	Few,     ///< the first kFewPredictors: the fastest
	All,     ///< all of enum Predictor
	Repeats, ///< repeats too: for coordinates that repeat, as on CAD and scan lattices
};

} // namespace wavemesh
