// SPDX-License-Identifier: GPL-3.0-or-later
#include "mended_file.h"

#include "container/byte_io.h"
#include "container/container.h"
#include "wmc_files.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace wavemesh::test {
namespace {

struct LooseChunk
{
	std::uint8_t type;
	Bytes payload;
};

constexpr std::size_t kMagicSize = 8;

/// Chunks from `at` on, checksums ignored; `at` gets to behind the last.
std::vector<LooseChunk> chunksFrom(const Bytes& file, std::size_t& at)
{
	std::vector<LooseChunk> chunks;
	while (at < file.size()) {
		const auto frame        = readChunkFrame(file.data(), file.size(), at);
		const std::uint8_t type = file[at];
		if (!frame.ok() || std::strchr("HLROXAz", type) == nullptr || type == 0)
			break;
		chunks.push_back({type, Bytes(frame->payload, frame->payload + frame->size)});
		at = frame->end;
	}
	return chunks;
}

Bytes fileOf(const Head& head, const std::vector<LooseChunk>& chunks)
{
	Bytes file;
	writeHead(head, file);
	for (const LooseChunk& c : chunks)
		writeChunk(c.type, c.payload, file);
	return file;
}

/// The last level of each chunk takes what the others leave.
void mendLengths(Head& head, const std::vector<LooseChunk>& chunks)
{
	auto chunk = chunks.begin();
	for (std::size_t i = 0, first = 0; i < head.rows.size(); ++i) {
		if (!head.rows[i].endsChunk)
			continue;
		chunk =
		    std::find_if(chunk, chunks.end(), [](const LooseChunk& c) { return c.type == 'L'; });
		std::size_t left = chunk == chunks.end() ? 0 : (chunk++)->payload.size();
		for (std::size_t k = first; k <= i; ++k) {
			LevelRow& row = head.rows[k];
			row.bytes     = std::uint32_t(k == i ? left : std::min<std::size_t>(left, row.bytes));
			left -= row.bytes;
			row.connectivityBytes = std::min(row.connectivityBytes, row.bytes);
		}
		first = i + 1;
	}
	for (int f = 0; f < kFeatures; ++f) {
		const auto at = std::find_if(chunks.begin(), chunks.end(), [&](const LooseChunk& c) {
			return c.type == kFeatureChunk[f];
		});
		if (at == chunks.end())
			head.features &= std::uint8_t(~(1 << f));
		else
			head.featureBytes[std::size_t(f)] = at->payload.size();
	}
}

/// Moves the sizes of level `level` and of all finer ones.
void moveSizes(Head& head, std::size_t level, std::int64_t vertices, std::int64_t faces)
{
	const auto moved = [](std::uint32_t& x, std::int64_t by) {
		x = std::uint32_t(std::max<std::int64_t>(0, std::int64_t(x) + by));
	};
	for (std::size_t i = level; i < head.rows.size(); ++i) {
		moved(head.rows[i].vertices, vertices);
		moved(head.rows[i].faces, faces);
	}
	moved(head.vertices, vertices);
	moved(head.faces, faces);
}

/// What the decoder says a level has and should have, put right. False if that is not its
/// complaint.
bool mendSizes(Head& head, const std::string& complaint)
{
	unsigned level = 0, found = 0, declared = 0;
	char what[16] = {};
	if (std::sscanf(
	        complaint.c_str(), "level %u has %u %15s but the head declares %u", &level, &found,
	        what, &declared) != 4 ||
	    level >= head.rows.size())
		return false;
	const std::int64_t by = std::int64_t(found) - declared;
	const bool faces      = what[0] == 'f';
	moveSizes(head, level, faces ? 0 : by, faces ? by : 0);
	return true;
}

/// Sizes and digest, by decoding the levels alone on the lattice of integers.
void mendLevels(Head& head, const std::vector<LooseChunk>& chunks)
{
	DecodeLimits limits;
	limits.maxVertices = limits.maxFaces = 40'000;
	const bool restored                  = head.has(kRestoration);
	for (int tries = 0; tries < 40; ++tries) {
		Head plain     = head;
		plain.features = std::uint8_t(restored ? 1 << kRestoration : 0); // the base depends on it
		plain.lattice.origin = {0, 0, 0};
		plain.lattice.step   = 1;
		const Bytes file     = fileOf(plain, chunks);
		auto decoder         = Decoder::open(file.data(), file.size(), limits);
		if (!decoder.ok())
			return;
		Status s;
		while (s.ok() && decoder->level() < decoder->info().finestLevel())
			s = decoder->advance();
		if (s.code == StatusCode::Corrupt && mendSizes(head, s.what))
			continue;
		if (s.code != StatusCode::ChecksumMismatch ||
		    decoder->level() < decoder->info().finestLevel())
			return;
		const MeshData mesh = decoder->mesh();
		CornerTable table;
		for (const auto& t : mesh.triangles)
			table.vertex.insert(table.vertex.end(), t.begin(), t.end());
		std::vector<LatticePoint> points;
		for (const auto& p : mesh.positions)
			points.push_back({std::int32_t(p[0]), std::int32_t(p[1]), std::int32_t(p[2])});
		head.digest = digestOf(table, points);
		return;
	}
}

} // namespace

std::vector<std::uint8_t> mendedFile(const std::uint8_t* bytes, std::size_t size)
{
	Bytes file(bytes, bytes + size);
	std::size_t at = kMagicSize;
	if (size <= at)
		return file;
	auto chunks = chunksFrom(file, at);
	if (chunks.empty() || chunks[0].type != kHeadChunk || chunks[0].payload.size() < 2)
		return file;
	chunks[0].payload[0] = kVersionMajor;
	chunks[0].payload[1] = kVersionMinor;
	Bytes begin;
	writeHead({}, begin);
	begin.resize(kMagicSize);
	writeChunk(kHeadChunk, chunks[0].payload, begin);
	std::size_t end = 0;
	auto head       = readHead(begin.data(), begin.size(), end);
	if (!head.ok())
		return begin;
	chunks.erase(chunks.begin());
	if (at < file.size())
		head->features &= std::uint8_t(~file[at]);
	mendLengths(*head, chunks);
	mendLevels(*head, chunks);
	return fileOf(*head, chunks);
}

} // namespace wavemesh::test
