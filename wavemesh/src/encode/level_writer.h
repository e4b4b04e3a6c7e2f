// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Writes the levels into chunks, and their rows into the head.
#pragma once

#include "container/container.h"
#include "entropy/range_coder.h"

namespace wavemesh {

class LevelWriter
{
public:
	LevelWriter(Head& head, std::vector<std::uint8_t>& chunks) : head_(head), chunks_(chunks) {}

	RangeEncoder& coder() { return coder_; }
	void connectivityEnds() { connectivityEnd_ = coder_.mark(); }
	void attributesBegin() { attributesBegin_ = coder_.mark(); }

	/// The level is written, attributes last; its bytes and the end of its chunk are filled in
	/// here.
	void endLevel(const LevelRow& row, bool last);

private:
	struct Level
	{
		LevelRow row;
		RangeEncoder::Mark connectivityEnd, attributesBegin, end;
	};

	void endChunk();

	Head& head_;
	std::vector<std::uint8_t>& chunks_;
	RangeEncoder coder_;
	std::vector<Level> levels_; ///< of the chunk being written
	RangeEncoder::Mark connectivityEnd_, attributesBegin_;
};

} // namespace wavemesh
