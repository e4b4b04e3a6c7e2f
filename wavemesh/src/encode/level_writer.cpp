// SPDX-License-Identifier: GPL-3.0-or-later
#include "encode/level_writer.h"

namespace wavemesh {
namespace {

/// A chunk is closed after the level that takes it past this many bytes: small levels share one.
constexpr std::size_t kChunkSize = 4000;

} // namespace

void LevelWriter::endLevel(const LevelRow& row, bool last)
{
	levels_.push_back({row, connectivityEnd_, attributesBegin_, coder_.mark()});
	connectivityEnd_ = coder_.mark();
	if (last || coder_.mark().size >= kChunkSize)
		endChunk();
}

void LevelWriter::endChunk()
{
	const auto payload = coder_.finish();
	writeChunk(kLevelChunk, payload, chunks_);
	std::size_t begin = 0;
	for (Level& level : levels_) {
		const std::size_t middle     = RangeEncoder::prefix(payload, level.connectivityEnd);
		const std::size_t attributes = RangeEncoder::prefix(payload, level.attributesBegin);
		const std::size_t end        = RangeEncoder::prefix(payload, level.end);
		level.row.bytes              = end - begin;
		level.row.connectivityBytes  = middle - begin;
		level.row.attributeBytes     = end - attributes;
		level.row.endsChunk          = &level == &levels_.back();
		begin                        = end;
		head_.rows.push_back(level.row);
	}
	levels_.clear();
	connectivityEnd_ = {};
}

} // namespace wavemesh
