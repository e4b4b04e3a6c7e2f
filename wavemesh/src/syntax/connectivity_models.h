// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What is learnt about D1, D2 and D3, with fast contexts or with rich ones.
#pragma once

#include "entropy/models.h"
#include "syntax/split_contexts.h"

namespace wavemesh {

/// Which contexts connectivity is coded with.
enum class Contexts : std::uint8_t {
	Fast, ///< what the faces next to an edge tell
	Rich, ///< lengths known around, valences to come; half as fast
};

/// Learned state of the connectivity; lives through all levels of a file.
class ConnectivityModels
{
public:
	explicit ConnectivityModels(Contexts c) : contexts(c) {}
	Contexts contexts;

	static constexpr int kSplitInputs = 5;
	static constexpr int kLengths     = 12; ///< classes of a ratio of lengths

	std::vector<AdaptiveBit> splitByFaces {7 * 7 * 5 * 5};
	std::vector<AdaptiveBit> splitByLength {kLengths * 7 * 7};
	std::vector<AdaptiveBit> splitByValences {6 * 6 * 6 * 6};
	std::vector<AdaptiveBit> splitByEnds {4 * 4 * 4 * 4 * 3};
	std::vector<AdaptiveBit> splitByShape {kLengths * kLengths * 9};
	Mixer<kSplitInputs> splitMixer {7 * 7};

	static constexpr int kRichInputs = 8;
	std::vector<AdaptiveBit> splitByGlobal {SplitContexts::kGlobal * 7 * 7};
	std::vector<AdaptiveBit> splitByLocal {SplitContexts::kLocal * 7 * 7};
	std::vector<AdaptiveBit> splitByBoth {SplitContexts::kGlobal * SplitContexts::kLocal};
	std::vector<AdaptiveBit> splitByExcess {SplitContexts::kExcess * kLengths};
	std::vector<AdaptiveBit> splitByOuter {SplitContexts::kOuter * SplitContexts::kExcess};
	PairMixer<kRichInputs> splitPairMixer {7 * 7};
	SplitLengths splitLengths;

	static constexpr int kDiagonalInputs = 2;
	std::vector<AdaptiveBit> diagonalByValences {5 * 5 * 3};
	std::vector<AdaptiveBit> diagonalByLength {kLengths};
	Mixer<kDiagonalInputs> diagonalMixer {1};

	static constexpr int kFlipInputs = 2;
	std::vector<AdaptiveBit> flipByLength {kLengths * kLengths};
	std::vector<AdaptiveBit> flipByNeighbours {3 * 3 * 5};
	Mixer<kFlipInputs> flipMixer {1};
	std::vector<AdaptiveBit> flipSide {kLengths * 3};

	static constexpr int kRichFlipInputs = 4;
	static constexpr int kFlipGains      = 13; ///< classes of ValenceForecast::flipGain()
	std::vector<AdaptiveBit> flipByValences {8 * 13};
	std::vector<AdaptiveBit> flipByGain {kLengths * kFlipGains};
	Mixer<kRichFlipInputs> richFlipMixer {1, kAgileRates};

	AdaptiveBit hasCentres;
	AdaptiveBit centre;
};

} // namespace wavemesh
