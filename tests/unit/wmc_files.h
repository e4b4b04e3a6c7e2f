// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Small files to damage, and the layout of a file as far as damaging needs it
/// (docs/wmc_format.md).
#pragma once

#include <wavemesh/codec.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace wavemesh::test {

using Bytes = std::vector<std::uint8_t>;

/// Bytes in a heap block of exactly their number: a sanitizer sees the first one read behind.
class ExactBuffer
{
public:
	ExactBuffer(const std::uint8_t* data, std::size_t size);
	const std::uint8_t* data() const { return block_.get(); }
	std::size_t size() const { return size_; }

private:
	std::unique_ptr<std::uint8_t[]> block_;
	std::size_t size_;
};

/// Where a chunk lies in a file.
struct ChunkPlace
{
	std::uint8_t type    = 0;
	std::size_t begin    = 0; ///< of its type
	std::size_t payload  = 0;
	std::size_t checksum = 0;
	std::size_t end      = 0;
};
/// The chunks of a whole file, head first; reads types and lengths only.
std::vector<ChunkPlace> chunksOf(const Bytes& file);
/// Makes the chunk's checksum right again.
void mendChecksum(Bytes& file, const ChunkPlace& chunk);
/// A chunk as bytes.
Bytes makeChunk(std::uint8_t type, const Bytes& payload);

struct SmallFile
{
	std::string name;
	MeshData original;
	EncodedMesh encoded;
};
/// Files of a few hundred bytes in both modes: closed, open, several components, lifting off and
/// on, schedules of all types, one level and several, one chunk and several.
std::vector<SmallFile> smallFiles();

} // namespace wavemesh::test
