// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes, chunks, head and level table.
#include "codec_check.h"
#include "container/byte_io.h"
#include "container/container.h"
#include "mesh_families.h"
#include "rng.h"
#include "wmc_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace wavemesh::test {
namespace {

TEST(Head, RefusesALevelOf4GiBAndNamesIt)
{
	std::vector<LevelRow> rows(3);
	rows[1].bytes = 0xffffffff;
	EXPECT_TRUE(checkSizes(rows).ok());
	++rows[1].bytes;
	const Status s = checkSizes(rows);
	EXPECT_EQ(s.code, StatusCode::LimitExceeded);
	EXPECT_EQ(s.what, "level 1 takes 4294967296 bytes, more than the format can hold (4294967295)");
}

TEST(ByteIo, WhatIsWrittenIsRead)
{
	ByteWriter out;
	const std::uint64_t numbers[] = {0,     1,           127,         128,        16383,
	                                 16384, 0xffffffffu, 0x100000000, 1ull << 56, (1ull << 63) - 1};
	const double reals[]          = {
	             0, -0.0, 1, -1e300, 1e-310, 0.1, std::numeric_limits<double>::infinity()};
	for (const std::uint64_t x : numbers)
		out.varint(x);
	for (const std::uint64_t x : numbers)
		out.fixed(x);
	for (const double x : reals) {
		out.real64(x);
		out.real32(x);
	}
	out.fixed(std::uint8_t {200});
	ByteReader in(out.bytes.data(), out.bytes.size());
	for (const std::uint64_t x : numbers) {
		std::uint64_t read = 1;
		in.varint(read);
		EXPECT_EQ(read, x);
	}
	for (const std::uint64_t x : numbers) {
		std::uint64_t read = 1;
		in.fixed(read);
		EXPECT_EQ(read, x);
	}
	for (const double x : reals) {
		double wide = 2, narrow = 2;
		in.real64(wide);
		in.real32(narrow);
		EXPECT_EQ(wide, x);
		EXPECT_EQ(narrow, double(float(x)));
	}
	EXPECT_EQ(in.byte(), 200);
	EXPECT_FALSE(in.failed());
	EXPECT_EQ(in.position(), out.bytes.size());
	EXPECT_EQ(in.byte(), 0);
	EXPECT_TRUE(in.failed());
}

TEST(ByteIo, Varint_FailsForWhatDoesNotFitOrDoesNotEnd)
{
	const auto fails = [](const Bytes& bytes, auto value) {
		ByteReader in(bytes.data(), bytes.size());
		in.varint(value);
		return in.failed();
	};
	EXPECT_FALSE(fails({0xff, 0x01}, std::uint8_t {}));
	EXPECT_TRUE(fails({0x80, 0x02}, std::uint8_t {})) << "256";
	EXPECT_FALSE(fails({0xff, 0xff, 0xff, 0xff, 0x0f}, std::uint32_t {}));
	EXPECT_TRUE(fails({0xff, 0xff, 0xff, 0xff, 0x1f}, std::uint32_t {}));
	EXPECT_TRUE(fails({0x80}, std::uint64_t {})) << "cut";
	EXPECT_TRUE(fails({}, std::uint64_t {}));
	EXPECT_TRUE(fails(Bytes(20, 0xff), std::uint64_t {})) << "endless";
	EXPECT_TRUE(fails(Bytes(20, 0x80), std::uint64_t {})) << "endless zeros";
}

TEST(Checksum, IsXxh32)
{
	// From the specification of XXH32, seed 0.
	const Bytes abc {'a', 'b', 'c'};
	EXPECT_EQ(checksum(abc.data(), 0), 0x02cc5d05u);
	EXPECT_EQ(checksum(abc.data(), 1), 0x550d7456u);
	EXPECT_EQ(checksum(abc.data(), 3), 0x32d153ffu);
}

TEST(Chunk, OfAnyLengthComesBackAndEveryCutIsSeen)
{
	Rng rng(111);
	for (const std::size_t size : {0u, 1u, 127u, 128u, 300u, 20000u}) {
		Bytes payload(size), file {1, 2, 3};
		for (auto& b : payload)
			b = static_cast<std::uint8_t>(rng.next());
		writeChunk('x', payload, file);
		EXPECT_EQ(Bytes(file.begin() + 3, file.end()), makeChunk('x', payload));
		const auto whole = readChunk(file.data(), file.size(), 3);
		ASSERT_TRUE(whole.ok());
		EXPECT_TRUE(whole->whole);
		EXPECT_EQ(whole->type, 'x');
		EXPECT_EQ(Bytes(whole->payload, whole->payload + whole->size), payload);
		EXPECT_EQ(whole->end, file.size());
		for (std::size_t n = 3; n < file.size(); n += 1 + n / 50) {
			const ExactBuffer cut(file.data(), n);
			const auto part = readChunk(cut.data(), n, 3);
			if (!part.ok()) {
				ASSERT_EQ(part.status().code, StatusCode::Truncated) << n;
				continue;
			}
			ASSERT_FALSE(part->whole);
			ASSERT_EQ(part->end, n);
			ASSERT_LE(part->size, size);
			ASSERT_LE(part->payload + part->size, cut.data() + n);
		}
	}
}

TEST(Chunk, OfAbsurdLength_IsCutNotRead)
{
	Bytes file {'L'};
	ByteWriter out;
	out.varint(~std::uint64_t {0} >> 1);
	file.insert(file.end(), out.bytes.begin(), out.bytes.end());
	file.push_back(7);
	const ExactBuffer exact(file.data(), file.size());
	const auto chunk = readChunk(exact.data(), exact.size(), 0);
	if (chunk.ok()) {
		EXPECT_FALSE(chunk->whole);
		EXPECT_EQ(chunk->size, 1u);
	}
}

/// Every second one is of a compact file.
Head someHead(std::uint64_t seed)
{
	Rng rng(seed);
	Head h;
	h.mode         = seed % 2 == 0 ? Mode::Classic : Mode::Compact;
	h.lifting      = h.mode == Mode::Classic ? static_cast<int>(rng.below(4)) - 1 : kLiftingOff;
	h.wgc          = rng.below(2) == 1;
	h.rich         = rng.below(2) == 1;
	h.lattice.bits = 1 + static_cast<int>(rng.below(24));
	h.lattice.step = rng.below(2) ? 0.25 : rng.unit() * 1e-5;
	for (double& x : h.lattice.origin)
		x = rng.below(2) ? -3.5 : rng.between(-1e9, 1e9);
	h.digest = static_cast<std::uint32_t>(rng.next());
	LevelRow row;
	row.vertices               = 3 + rng.below(10);
	row.faces                  = 1 + rng.below(2 * row.vertices);
	row.faces                  = std::max(row.faces, row.vertices / 3 + 1);
	const std::uint32_t levels = 1 + rng.below(20);
	for (std::uint32_t i = 0; i < levels; ++i) {
		const bool precise = h.mode == Mode::Compact && i > 0 && rng.below(2) == 1;
		row.kind  = i == 0 ? LevelKind::Base : precise ? LevelKind::Precise : LevelKind::Split;
		row.bytes = rng.below(1000);
		row.connectivityBytes = rng.below(std::uint32_t(row.bytes) + 1);
		row.errorCode         = static_cast<std::uint8_t>(i + 1 == levels ? 0 : rng.below(256));
		row.endsChunk         = i + 1 == levels || rng.below(2) == 1;
		if (i > 0 && !precise && row.faces < 1000000) {
			const std::uint32_t more = 1 + rng.below(row.faces);
			row.vertices += more;
			row.faces += std::min(2 * more, 3 * row.faces);
		}
		h.rows.push_back(row);
	}
	// From full precision down, as far as the bits go.
	for (std::size_t i = h.rows.size() - 1; i > 0; --i) {
		LevelRow &finer = h.rows[i], &coarser = h.rows[i - 1];
		const int left = h.lattice.bits - 1 - finer.shift;
		if (finer.kind == LevelKind::Precise && left == 0)
			finer.kind = LevelKind::Split;
		coarser.shift = finer.shift;
		if (finer.kind == LevelKind::Precise)
			coarser.shift += 1 + static_cast<int>(rng.below(static_cast<std::uint32_t>(left)));
	}
	return h;
}

TEST(Head, EveryFieldComesBack)
{
	for (std::uint64_t seed = 0; seed < 300; ++seed) {
		const Head h = someHead(seed);
		Bytes file;
		writeHead(h, file);
		std::size_t end = 0;
		const auto read = readHead(file.data(), file.size(), end);
		ASSERT_TRUE(read.ok()) << seed << ": " << read.status().what;
		EXPECT_EQ(end, file.size());
		EXPECT_EQ(read->major, kVersionMajor);
		EXPECT_EQ(read->minor, kVersionMinor);
		EXPECT_EQ(read->mode, h.mode);
		EXPECT_EQ(read->lifting, h.lifting);
		EXPECT_EQ(read->wgc, h.wgc);
		EXPECT_EQ(read->rich, h.rich);
		EXPECT_EQ(read->lattice.bits, h.lattice.bits);
		EXPECT_EQ(read->lattice.step, h.lattice.step);
		EXPECT_EQ(read->lattice.origin, h.lattice.origin);
		EXPECT_EQ(read->digest, h.digest);
		ASSERT_EQ(read->rows.size(), h.rows.size());
		for (std::size_t i = 0; i < h.rows.size(); ++i) {
			const LevelRow &a = h.rows[i], &b = read->rows[i];
			EXPECT_EQ(b.kind, a.kind);
			EXPECT_EQ(b.shift, a.shift) << seed << ' ' << i;
			EXPECT_EQ(b.vertices, a.vertices);
			EXPECT_EQ(b.faces, a.faces);
			EXPECT_EQ(b.bytes, a.bytes);
			EXPECT_EQ(b.connectivityBytes, a.connectivityBytes);
			EXPECT_EQ(b.errorCode, a.errorCode) << seed << ' ' << i;
			EXPECT_EQ(b.endsChunk, a.endsChunk);
		}
	}
}

StatusCode codeOf(const Head& h)
{
	Bytes file;
	writeHead(h, file);
	std::size_t end = 0;
	return readHead(file.data(), file.size(), end).status().code;
}

TEST(Head, WithALevelThatASplitCannotGive_IsCorrupt)
{
	Head good = someHead(2);
	while (good.rows.size() < 2)
		good = someHead(good.digest / 2 * 2);
	ASSERT_EQ(codeOf(good), StatusCode::Ok);
	Head h              = good;
	h.rows.back().faces = 4 * h.rows[h.rows.size() - 2].faces + 1;
	EXPECT_EQ(codeOf(h), StatusCode::Corrupt) << "more than four descendants a face";
	h                  = good;
	h.rows[0].vertices = 3 * h.rows[0].faces + 1;
	EXPECT_EQ(codeOf(h), StatusCode::Corrupt) << "more vertices than corners in the base";
	h                  = good;
	h.rows.front()     = {};
	h.rows[1].vertices = h.rows[1].faces = 0;
	h.rows.resize(2);
	h.rows.back().endsChunk = true;
	EXPECT_EQ(codeOf(h), StatusCode::Corrupt) << "a split of nothing";
	h                       = good;
	h.rows.back().endsChunk = false;
	EXPECT_EQ(codeOf(h), StatusCode::Corrupt) << "the last chunk is open";
	h                               = good;
	h.rows.back().connectivityBytes = h.rows.back().bytes + 1;
	EXPECT_EQ(codeOf(h), StatusCode::Corrupt) << "a part larger than the whole";
}

/// Base, split, precise, precise.
Head compactHead(int bits, int firstBits, int lastBits)
{
	Head h;
	h.mode         = Mode::Compact;
	h.lattice.bits = bits;
	h.rows.resize(4);
	h.rows[0] = {LevelKind::Base, 4, 4, 20, 5, 0, 40, firstBits + lastBits, false};
	h.rows[1] = {LevelKind::Split, 6, 8, 20, 5, 0, 30, firstBits + lastBits, false};
	h.rows[2] = {LevelKind::Precise, 6, 8, 20, 0, 0, 20, lastBits, true};
	h.rows[3] = {LevelKind::Precise, 6, 8, 20, 0, 0, 0, 0, true};
	return h;
}

TEST(Head, WhoseBaseHasNoBitsLeft_IsCorrupt)
{
	for (const int bits : {3, 12, 24}) {
		EXPECT_EQ(codeOf(compactHead(bits, 1, bits - 2)), StatusCode::Ok) << bits;
		EXPECT_EQ(codeOf(compactHead(bits, 1, bits - 1)), StatusCode::Corrupt) << bits;
		EXPECT_EQ(codeOf(compactHead(bits, bits - 1, bits)), StatusCode::Corrupt) << bits;
	}
}

TEST(Head, WithTheLargestShiftsThatItCanSay_IsCorruptNotMore)
{
	EXPECT_EQ(codeOf(compactHead(24, 32, 32)), StatusCode::Corrupt);
	// Every row a precise one with the most bits: no sum may overflow.
	Head h = compactHead(24, 1, 1);
	h.rows.insert(h.rows.end() - 1, 4000, h.rows[2]);
	int shift = 0;
	for (std::size_t i = h.rows.size() - 1; i > 1; --i)
		h.rows[i - 1].shift = shift += 32;
	h.rows[0].shift = shift;
	EXPECT_EQ(codeOf(h), StatusCode::Corrupt);
}

TEST(Head, OfACompactFileSaysItsPredictors)
{
	for (const int set : {0, 1, 2}) {
		Head h       = compactHead(12, 1, 2);
		h.predictors = PredictorSet(set);
		std::vector<std::uint8_t> file;
		writeHead(h, file);
		std::size_t end = 0;
		EXPECT_EQ(readHead(file.data(), file.size(), end)->predictors, PredictorSet(set));
	}
}

TEST(Head, OfACompactFileWithUnknownPredictors_IsCorrupt)
{
	Head h       = compactHead(12, 1, 2);
	h.predictors = PredictorSet(3);
	EXPECT_EQ(codeOf(h), StatusCode::Corrupt);
}

TEST(Head, WithAFrameThatIsNotALattice_IsCorrupt)
{
	const double bad[] = {
	    std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()};
	for (const double x : bad) {
		Head h         = someHead(2);
		h.lattice.step = x;
		EXPECT_EQ(codeOf(h), StatusCode::Corrupt);
		h                = someHead(2);
		h.lattice.origin = {0, x, 0};
		EXPECT_EQ(codeOf(h), StatusCode::Corrupt);
	}
	for (const double x : {0.0, -1.0}) {
		Head h         = someHead(2);
		h.lattice.step = x;
		EXPECT_EQ(codeOf(h), StatusCode::Corrupt) << x;
	}
}

} // namespace
} // namespace wavemesh::test
