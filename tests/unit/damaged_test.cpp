// SPDX-License-Identifier: GPL-3.0-or-later
// Every changed byte and bit of small files: an error, never a wrong finest mesh, never a crash.
#include "codec_check.h"
#include "rng.h"
#include "sanitized.h"
#include "wmc_files.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace wavemesh::test {
namespace {

bool isRefusal(StatusCode code)
{
	switch (code) {
	case StatusCode::NotWmc:
	case StatusCode::VersionTooNew:
	case StatusCode::VersionTooOld:
	case StatusCode::Truncated:
	case StatusCode::Corrupt:
	case StatusCode::ChecksumMismatch:
	case StatusCode::LimitExceeded:
		return true;
	default:
		return false;
	}
}

/// No index may point outside, whatever the file says.
bool indicesExist(const MeshData& mesh)
{
	for (const auto& t : mesh.triangles)
		for (std::uint32_t v : t)
			if (v >= mesh.positions.size())
				return false;
	return true;
}

class EveryChange : public testing::TestWithParam<SmallFile>
{
protected:
	void SetUp() override
	{
		file_   = GetParam().encoded.bytes;
		whole_  = decode(file_.data(), file_.size()).value().mesh;
		levels_ = levelsOf(file_);
		chunks_ = chunksOf(file_);
	}

	/// What decoding the changed file did wrong; empty if nothing.
	std::string judge(const Bytes& changed, bool mayBeTruncated) const
	{
		const ExactBuffer data(changed.data(), changed.size());
		const auto back = decode(data.data(), data.size());
		if (back.ok())
			return "decoded without a complaint";
		const StatusCode code = back.status().code;
		if (!isRefusal(code))
			return "status " + std::to_string(static_cast<int>(code)) + ": " + back.status().what;
		if (back.status().what.empty())
			return "no message";
		if (back.hasValue() && (code != StatusCode::Truncated || !mayBeTruncated))
			return "a mesh, and status " + std::to_string(static_cast<int>(code));
		return back.hasValue() ? whatIsNoLevel(*back) : std::string();
	}

	/// Empty if a mesh is one of the file's levels, or one of them in part predicted: then its
	/// connectivity is right.
	std::string whatIsNoLevel(const DecodedMesh& back) const
	{
		if (!indicesExist(back.mesh))
			return "indices out of range";
		const auto level = static_cast<std::size_t>(back.level);
		if (level + 1 == levels_.size())
			return back.mesh.triangles.size() <= whole_.triangles.size() ? "" : "too many faces";
		return back.mesh.triangles == levels_[level].mesh.triangles ? "" : "no level's faces";
	}

	/// The length field of a chunk may well say that the file is cut.
	bool inLength(std::size_t at) const
	{
		for (const ChunkPlace& c : chunks_)
			if (at > c.begin && at < c.payload)
				return true;
		return false;
	}

	/// With the checksum made right again the stages behind it must defend themselves.
	void judgeMended(const ChunkPlace& chunk, std::size_t at, std::uint8_t value)
	{
		Bytes changed = file_;
		changed[at]   = value;
		mendChecksum(changed, chunk);
		const ExactBuffer data(changed.data(), changed.size());
		const auto back = decode(data.data(), data.size());
		if (back.hasValue()) {
			ASSERT_TRUE(indicesExist(back->mesh)) << at;
		}
		if (!back.ok()) {
			ASSERT_TRUE(isRefusal(back.status().code)) << at << ": " << back.status().what;
			return;
		}
		// Nothing was found: then it is the finest mesh, but for the frame of the lattice.
		ASSERT_EQ(back->mesh.triangles, whole_.triangles) << at;
		if (chunk.type != 'H') {
			ASSERT_EQ(back->mesh.positions, whole_.positions) << at;
		}
	}

	/// Where each change costs a whole decoding: every byte of the small files; of the larger ones
	/// every fourth; every third and every 29th under the address sanitizer.
	std::size_t stride() const
	{
		const bool small = file_.size() <= 400;
		return kSanitized ? (small ? 3 : 29) : small ? 1 : 4;
	}

	Bytes file_;
	MeshData whole_;
	std::vector<Level> levels_;
	std::vector<ChunkPlace> chunks_;
};

TEST_P(EveryChange, OfABit_IsNoticed)
{
	for (std::size_t at = 0; at < file_.size(); at += kSanitized ? stride() : 1)
		for (int bit = 0; bit < 8; ++bit) {
			Bytes changed = file_;
			changed[at] ^= static_cast<std::uint8_t>(1 << bit);
			ASSERT_EQ(judge(changed, inLength(at)), "") << "byte " << at << " bit " << bit;
		}
}

TEST_P(EveryChange, OfAByte_IsNoticed)
{
	Rng rng(81);
	for (std::size_t at = 0; at < file_.size(); at += stride()) {
		std::vector<std::uint8_t> values {0, 255, static_cast<std::uint8_t>(~file_[at])};
		values.push_back(static_cast<std::uint8_t>(rng.below(256)));
		for (std::uint8_t value : values) {
			Bytes changed = file_;
			changed[at]   = value;
			if (value != file_[at]) {
				ASSERT_EQ(judge(changed, inLength(at)), "")
				    << "byte " << at << " is " << int(value);
			}
		}
	}
}

TEST_P(EveryChange, ToAnyValueAtSomePlaces_IsNoticed)
{
	std::vector<std::size_t> places;
	for (const ChunkPlace& c : chunks_) {
		for (std::size_t at = c.begin; at < std::min(c.payload + 2, c.end); ++at)
			places.push_back(at);
		places.push_back((c.payload + c.checksum) / 2);
		places.push_back(c.end - 1);
	}
	for (std::size_t at : places)
		for (int value = 0; value < 256; ++value) {
			Bytes changed = file_;
			changed[at]   = static_cast<std::uint8_t>(value);
			if (value != file_[at]) {
				ASSERT_EQ(judge(changed, inLength(at)), "") << "byte " << at << " is " << value;
			}
		}
}

TEST_P(EveryChange, OfABitWithItsChecksumMended_NeverGivesAWrongFinestMesh)
{
	for (const ChunkPlace& c : chunks_)
		for (std::size_t at = c.payload; at < c.checksum; at += stride())
			for (int bit = 0; bit < 8; ++bit)
				ASSERT_NO_FATAL_FAILURE(
				    judgeMended(c, at, static_cast<std::uint8_t>(file_[at] ^ (1 << bit))));
}

TEST_P(EveryChange, OfAByteWithItsChecksumMended_NeverGivesAWrongFinestMesh)
{
	Rng rng(83);
	for (const ChunkPlace& c : chunks_)
		for (std::size_t at = c.payload; at < c.checksum; at += stride())
			for (int i = 0; i < 2; ++i)
				ASSERT_NO_FATAL_FAILURE(
				    judgeMended(c, at, static_cast<std::uint8_t>(rng.below(256))));
}

TEST_P(EveryChange, GarbageFromSomewhereOn_IsNoticed)
{
	Rng rng(82);
	for (int round = 0; round < 60; ++round) {
		Bytes changed          = file_;
		const std::size_t from = rng.below(static_cast<std::uint32_t>(file_.size() - 1));
		for (std::size_t at = from; at < changed.size(); ++at)
			changed[at] = static_cast<std::uint8_t>(rng.next());
		if (changed != file_) {
			ASSERT_EQ(judge(changed, true), "") << "from " << from;
		}
	}
}

TEST_P(EveryChange, OneByteMissingOrTwice_IsNoticed)
{
	for (std::size_t at = 0; at + 1 < file_.size(); at += stride()) {
		Bytes less = file_, more = file_;
		less.erase(less.begin() + static_cast<std::ptrdiff_t>(at));
		more.insert(more.begin() + static_cast<std::ptrdiff_t>(at), file_[at]);
		ASSERT_EQ(judge(less, true), "") << at;
		// Where the rest of the file is this byte again, it is the file with a byte behind its end.
		if (!std::equal(file_.begin(), file_.end(), more.begin())) {
			ASSERT_EQ(judge(more, true), "") << at;
		}
	}
}

INSTANTIATE_TEST_SUITE_P(
    Damaged, EveryChange, testing::ValuesIn(smallFiles()), [](const auto& small) {
	    return small.param.name;
    });

} // namespace
} // namespace wavemesh::test
