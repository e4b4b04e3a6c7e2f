// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The file around the levels: magic, chunks, and the head with the level table
/// (docs/wmc_format.md, sections 2 and 3).
#pragma once

#include "attributes/channel.h"
#include "mesh/quantization.h"
#include "predict/predictor_set.h"

#include <wavemesh/codec.h>

namespace wavemesh {

constexpr std::uint8_t kVersionMajor = 0;
constexpr std::uint8_t kVersionMinor = 5;

/// Chunk types are letters; lower case means that a decoder may skip the chunk.
constexpr std::uint8_t kHeadChunk  = 'H';
constexpr std::uint8_t kLevelChunk = 'L';

/// What comes behind the last level, one chunk each, in this order: bits of the head's features.
enum Feature : std::uint8_t {
	kRestoration = 0, ///< how the original's faces and vertices follow from the finest level's
	kOrder       = 1, ///< the original's numbering
	kExact       = 2, ///< the original's floating point numbers
	kAttributes  = 3, ///< those of what is on no level; the others are in the levels
};
constexpr int kFeatures                         = 4;
constexpr std::uint8_t kFeatureChunk[kFeatures] = {'R', 'O', 'X', 'A'};

/// A level within the level chunks. A chunk holds one or more levels.
struct LevelRow
{
	LevelKind kind                  = LevelKind::Base;
	std::uint32_t vertices          = 0;
	std::uint32_t faces             = 0;
	std::uint64_t bytes             = 0; ///< of the chunk's payload, below 2^32: checkSizes()
	std::uint64_t connectivityBytes = 0; ///< of these
	std::uint64_t attributeBytes    = 0; ///< of these
	std::uint8_t errorCode          = 0; ///< see errorFromCode()
	int shift = 0; ///< positions are known to cells 2^shift lattice units wide; 0 in classic files
	bool endsChunk = false;
};

struct Head
{
	std::uint8_t major      = kVersionMajor;
	std::uint8_t minor      = kVersionMinor;
	Mode mode               = Mode::Classic;
	int lifting             = kLiftingOff;       ///< classic
	PredictorSet predictors = PredictorSet::Few; ///< compact
	bool wgc                = false;
	bool rich               = false; ///< are connectivity's contexts the rich ones?
	Lattice lattice;
	std::uint32_t digest   = 0; ///< digestOf() the finest level
	std::uint8_t features  = 0; ///< bit i: the file has feature i
	std::uint32_t vertices = 0; ///< of the original; with kRestoration, else the finest level's
	std::uint32_t faces    = 0;
	std::array<std::uint64_t, kFeatures> featureBytes {}; ///< payloads of the features' chunks
	std::vector<Channel> channels;                        ///< with kAttributes
	std::vector<std::string> textures;                    ///< names; with kAttributes
	std::vector<LevelRow> rows;                           ///< coarsest first

	bool has(Feature f) const { return (features >> f) & 1; }
};

/// The mean squared error `sum / count` as 6 bits of exponent and 2 of mantissa, in 1/256 square
/// steps.
std::uint8_t errorCode(std::uint64_t sum, std::uint64_t count);
/// Root of what errorCode() stored, in steps.
double errorFromCode(std::uint8_t code);

/// Checksum over lattice positions and vertex indices, 32-bit little-endian words in that order.
std::uint32_t digestOf(const CornerTable& table, const std::vector<LatticePoint>& positions);

/// Before a head is written. @return LimitExceeded for a level that the table cannot hold
Status checkSizes(const std::vector<LevelRow>& rows);
/// Appends magic and head chunk. @pre checkSizes()
void writeHead(const Head& head, std::vector<std::uint8_t>& file);
/// @param end  [out] offset behind the head chunk
Result<Head> readHead(const std::uint8_t* data, std::size_t size, std::size_t& end);

/// Appends a chunk: type, length, payload, checksum.
void writeChunk(
    std::uint8_t type, const std::vector<std::uint8_t>& payload, std::vector<std::uint8_t>& file);

struct Chunk
{
	std::uint8_t type           = 0;
	const std::uint8_t* payload = nullptr;
	std::uint64_t declared      = 0;     ///< bytes of the payload
	std::size_t size            = 0;     ///< those that are there
	bool whole                  = false; ///< false: the data end inside, nothing was checked
	std::size_t end             = 0;     ///< offset behind the chunk
};
/// As readChunk(), but the checksum is not looked at.
Result<Chunk> readChunkFrame(const std::uint8_t* data, std::size_t size, std::size_t offset);
/// Reads the chunk at `offset`; skips none. A cut chunk comes back with what there is of it.
/// @return Truncated if not even its length is there, ChecksumMismatch
Result<Chunk> readChunk(const std::uint8_t* data, std::size_t size, std::size_t offset);

/// Numbers in all attributes of a mesh of so many vertices and faces.
std::uint64_t attributeValues(const Head& head, std::uint64_t vertices, std::uint64_t faces);

/// What the head tells, with file offsets worked out. @param headEnd  see readHead()
StreamInfo describe(const Head& head, std::size_t headEnd);

} // namespace wavemesh
