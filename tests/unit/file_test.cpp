// SPDX-License-Identifier: GPL-3.0-or-later
// Versions, unknown chunks and foreign data; the error figure of a level.
#include "codec_check.h"
#include "container/container.h"
#include "rng.h"
#include "stage_meshes.h"
#include "wavelet/lifting.h"
#include "wmc_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace wavemesh::test {
namespace {

class WholeFile : public testing::Test
{
protected:
	void SetUp() override
	{
		mesh_   = makeFlippedSphere(110, 15);
		file_   = encode(mesh_)->bytes;
		chunks_ = chunksOf(file_);
		ASSERT_GE(chunks_.size(), 2u);
	}
	Bytes withChunkAt(std::size_t at, std::uint8_t type, const Bytes& payload) const
	{
		Bytes changed     = file_;
		const Bytes chunk = makeChunk(type, payload);
		changed.insert(
		    changed.begin() + static_cast<std::ptrdiff_t>(at), chunk.begin(), chunk.end());
		return changed;
	}
	static Result<DecodedMesh> decoded(const Bytes& file)
	{
		const ExactBuffer exact(file.data(), file.size());
		return decode(exact.data(), exact.size());
	}

	MeshData mesh_;
	Bytes file_;
	std::vector<ChunkPlace> chunks_;
};

TEST_F(WholeFile, UnknownAncillaryChunk_IsSkippedWhereverItStands)
{
	for (const ChunkPlace& c : chunks_)
		for (const Bytes& payload : {Bytes {}, Bytes {1, 2, 3}, Bytes(1000, 7)}) {
			const auto back = decoded(withChunkAt(c.end, 'q', payload));
			ASSERT_TRUE(back.ok()) << back.status().what;
			EXPECT_EQ(back->mesh.triangles, decoded(file_)->mesh.triangles);
		}
}

TEST_F(WholeFile, UnknownCriticalChunk_IsRefused)
{
	for (const std::uint8_t type : {'Q', 'A', 'Z', 'H', '@', '\0', '\xff'}) {
		const auto back =
		    decoded(withChunkAt(chunks_[0].end, static_cast<std::uint8_t>(type), {1, 2}));
		EXPECT_EQ(back.status().code, StatusCode::Corrupt) << int(type);
		EXPECT_FALSE(back.hasValue());
	}
}

TEST_F(WholeFile, DamagedAncillaryChunk_IsNotSkipped)
{
	Bytes changed = withChunkAt(chunks_[0].end, 'q', {1, 2, 3});
	changed[chunks_[0].end + 3] ^= 1;
	EXPECT_EQ(decoded(changed).status().code, StatusCode::ChecksumMismatch);
}

TEST_F(WholeFile, NewerMajorVersion_IsRefusedWhateverTheHeadLooksLike)
{
	Bytes changed               = file_;
	changed[chunks_[0].payload] = 1;
	mendChecksum(changed, chunks_[0]);
	EXPECT_EQ(decoded(changed).status().code, StatusCode::VersionTooNew);
	EXPECT_EQ(readInfo(changed.data(), changed.size()).status().code, StatusCode::VersionTooNew);
	Bytes other(file_.begin(), file_.begin() + 8);
	const Bytes head = makeChunk('H', {9, 0, 1, 2, 3});
	other.insert(other.end(), head.begin(), head.end());
	EXPECT_EQ(decoded(other).status().code, StatusCode::VersionTooNew);
}

TEST_F(WholeFile, OlderMinorVersion_IsRefusedAsTooOld)
{
	Bytes changed                  = file_;
	std::uint8_t& minor            = changed[chunks_[0].payload + 1];
	const std::uint8_t thisVersion = minor;
	for (int version = 0; version < 8; ++version) {
		minor = std::uint8_t(version);
		mendChecksum(changed, chunks_[0]);
		const StatusCode expected = version == thisVersion  ? StatusCode::Ok
		                            : version < thisVersion ? StatusCode::VersionTooOld
		                                                    : StatusCode::VersionTooNew;
		EXPECT_EQ(decoded(changed).status().code, expected) << version;
		EXPECT_EQ(readInfo(changed.data(), changed.size()).status().code, expected) << version;
	}
	minor = 4;
	mendChecksum(changed, chunks_[0]);
	EXPECT_EQ(
	    decoded(changed).status().what,
	    "the file has format version 0.4, older than 0.5, the only one that this program reads");
}

TEST_F(WholeFile, ForeignData_IsNotWmc)
{
	EXPECT_EQ(decode(nullptr, 0).status().code, StatusCode::NotWmc);
	for (const std::string text : {"ply\nformat ascii 1.0\n", "x", "\x89PNG\r\n\x1a\n", "OFF"}) {
		const Bytes bytes(text.begin(), text.end());
		EXPECT_EQ(decoded(bytes).status().code, StatusCode::NotWmc) << text;
	}
}

TEST_F(WholeFile, TextModeTransfer_IsCorruptNotForeign)
{
	Bytes unixed, stripped = file_;
	for (std::size_t i = 0; i < file_.size(); ++i)
		if (!(file_[i] == '\r' && file_[i + 1] == '\n'))
			unixed.push_back(file_[i]);
	for (auto& b : stripped)
		b &= 0x7f;
	for (const Bytes& bytes : {unixed, stripped}) {
		const Status s = decoded(bytes).status();
		EXPECT_EQ(s.code, StatusCode::Corrupt);
		EXPECT_NE(s.what.find("text mode"), std::string::npos) << s.what;
	}
}

TEST_F(WholeFile, BytesBehindTheEnd_AreIgnored)
{
	Bytes longer = file_;
	longer.insert(longer.end(), 100, 0xaa);
	const auto back = decoded(longer);
	ASSERT_TRUE(back.ok()) << back.status().what;
	EXPECT_EQ(back->mesh.positions, decoded(file_)->mesh.positions);
}

// ---- the error figure ----

TEST(ErrorCode, IsMonotone)
{
	int before = 0;
	for (std::uint64_t sum = 0; sum < (std::uint64_t {1} << 63); sum += 1 + sum / 40) {
		const int code = errorCode(sum, 1000);
		ASSERT_GE(code, before) << sum;
		before = code;
	}
	for (int code = 1; code < 256; ++code)
		ASSERT_GT(errorFromCode(std::uint8_t(code)), errorFromCode(std::uint8_t(code - 1)));
	EXPECT_EQ(errorCode(0, 1000), 0);
	EXPECT_EQ(errorFromCode(0), 0);
	EXPECT_GT(errorCode(1, 1u << 31), 0) << "not exactly none is not none";
}

TEST(ErrorCode, IsTheRootMeanSquareWithinAnEighth)
{
	// Two bits of mantissa, cut: the mean square is low by less than 1/4, its root by less than
	// 1/8.
	Rng rng(112);
	for (int i = 0; i < 20000; ++i) {
		const std::uint64_t count = 1 + rng.below(1000000);
		const std::uint64_t sum   = count / 8 + (rng.next() >> (8 + rng.below(42)));
		const double truth        = std::sqrt(double(sum) / double(count));
		if (truth < 0.3 || double(sum) > 7e16) // above, 256 times the sum does not fit into 64 bits
			continue;
		const double said = errorFromCode(errorCode(sum, count));
		ASSERT_LE(said, truth * (1 + 1e-12)) << sum << ' ' << count;
		ASSERT_GE(said, truth * (1 - 1.0 / 8 - 0.02)) << sum << ' ' << count;
	}
}

TEST(ErrorCode, OfSumsThatDoNotFit_IsTheLargest)
{
	EXPECT_EQ(errorCode(~std::uint64_t {0}, 1), 251);
	EXPECT_EQ(errorCode(~std::uint64_t {0} >> 8, 1), 251);
	EXPECT_TRUE(std::isfinite(errorFromCode(255)));
}

TEST(ErrorFigure, OfALevel_IsTheRootMeanSquareOfTheDetailsItLacks)
{
	const MeshData mesh = makeBumpySphere(400, 113);
	EncodeOptions o;
	o.mode          = Mode::Classic;
	o.optimize      = Optimize::Size;
	o.lifting       = kLiftingOff;
	o.wgc           = Wgc::Off;
	const auto file = encode(mesh, o);
	const Levels l  = makeLevels(mesh, {}, o.bits);
	ASSERT_EQ(file->info.levels.size(), l.replay.levels.size() + 1);
	double sum = 0; // of the details of all splits down to this one
	for (std::size_t j = l.replay.levels.size(); j-- > 0;) {
		const ReplayedLevel& level = l.replay.levels[j];
		const Parents parents      = parentsOf(level.parent, level.refinement);
		for (std::size_t i = 0; i < parents.size(); ++i) {
			const LatticePoint m = middle(l.positions, parents[i]);
			const LatticePoint p = l.positions[level.refinement.parentVertices + i];
			for (std::size_t k = 0; k < 3; ++k)
				sum += double(p[k] - m[k]) * double(p[k] - m[k]);
		}
		const double truth =
		    file->info.step * std::sqrt(sum / static_cast<double>(mesh.positions.size()));
		EXPECT_LE(file->info.levels[j].error, truth * (1 + 1e-9)) << j;
		EXPECT_GE(file->info.levels[j].error, truth * (1 - 1.0 / 8)) << j;
	}
	EXPECT_EQ(file->info.levels.back().error, 0);
}

} // namespace
} // namespace wavemesh::test
