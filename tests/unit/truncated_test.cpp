// SPDX-License-Identifier: GPL-3.0-or-later
// Every prefix of small files: a prefix is a mesh.
#include "codec_check.h"
#include "wmc_files.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace wavemesh::test {
namespace {

class EveryPrefix : public testing::TestWithParam<SmallFile>
{
protected:
	const Bytes& file() const { return GetParam().encoded.bytes; }
	const std::vector<LevelInfo>& table() const { return GetParam().encoded.info.levels; }
	/// Does anything follow the levels?
	bool finishes() const
	{
		const StreamFeatures& f = GetParam().encoded.info.features;
		return f.restored || f.orderKept || f.exact || f.attributes;
	}
	static std::uint32_t largestIndex(const MeshData& mesh)
	{
		std::uint32_t largest = 0;
		for (const auto& t : mesh.triangles)
			largest = std::max({largest, t[0], t[1], t[2]});
		return largest;
	}

	/// Finest level that a prefix of n bytes holds whole, -1 if none.
	int wholeLevels(std::size_t n) const
	{
		int level = -1;
		for (const LevelInfo& l : table())
			level += l.prefix <= n;
		return level;
	}
};

TEST_P(EveryPrefix, Decode_GivesTheLevelThatIsWholeOrThePartOfTheNext)
{
	const auto levels = levelsOf(file());
	ASSERT_EQ(levels.size(), table().size());
	for (std::size_t n = 0; n < file().size(); ++n) {
		const ExactBuffer cut(file().data(), n);
		const auto back = decode(cut.data(), cut.size());
		ASSERT_EQ(back.status().code, n == 0 ? StatusCode::NotWmc : StatusCode::Truncated) << n;
		ASSERT_FALSE(back.status().what.empty());
		const int whole = wholeLevels(n);
		if (!back.hasValue()) {
			ASSERT_EQ(whole, -1) << n << ": " << back.status().what;
			continue;
		}
		ASSERT_EQ(back.status().byteOffset, n);
		ASSERT_GE(back->level, whole) << n;
		ASSERT_LE(back->level, whole + 1) << n;
		if (finishes() && back->level + 1 == int(levels.size())) {
			ASSERT_LT(largestIndex(back->mesh), back->mesh.positions.size()) << n;
			continue; // the finest level, with what came of what follows it
		}
		const MeshData& full = levels[static_cast<std::size_t>(back->level)].mesh;
		ASSERT_EQ(back->mesh.triangles, full.triangles) << n;
		if (back->level == whole) {
			ASSERT_EQ(back->mesh.positions, full.positions) << n;
		}
		else {
			ASSERT_EQ(back->mesh.positions.size(), full.positions.size()) << n;
		}
	}
}

TEST_P(EveryPrefix, PrefixInTheLevelTable_IsTheShortestThatHoldsTheLevel)
{
	const auto levels = levelsOf(file());
	ASSERT_EQ(levels.size(), table().size());
	for (std::size_t j = 0; j < table().size(); ++j) {
		DecodeOptions o;
		o.level      = static_cast<int>(j);
		const auto n = static_cast<std::size_t>(table()[j].prefix);
		const ExactBuffer enough(file().data(), n), tooFew(file().data(), n - 1);
		const auto back = decode(enough.data(), enough.size(), o);
		ASSERT_TRUE(back.ok()) << j << ": " << back.status().what;
		EXPECT_EQ(back->mesh.triangles, levels[j].mesh.triangles);
		EXPECT_EQ(back->mesh.positions, levels[j].mesh.positions);
		EXPECT_EQ(decode(tooFew.data(), tooFew.size(), o).status().code, StatusCode::Truncated)
		    << j;
	}
}

TEST_P(EveryPrefix, Levels_NeverGetFewerAsBytesArrive)
{
	int before = -1;
	for (std::size_t n = 0; n <= file().size(); ++n) {
		const ExactBuffer cut(file().data(), n);
		const auto back = decode(cut.data(), cut.size());
		const int level = back.hasValue() ? back->level : -1;
		ASSERT_GE(level, before) << n;
		before = level;
	}
	EXPECT_EQ(before, GetParam().encoded.info.finestLevel());
}

TEST_P(EveryPrefix, CutCompactLevel_LeavesEveryVertexInsideItsCell)
{
	const StreamInfo& info = GetParam().encoded.info;
	if (info.mode != Mode::Compact)
		GTEST_SKIP() << "classic";
	if (finishes())
		GTEST_SKIP() << "the finest mesh is numbered anew";
	const auto levels = levelsOf(file());
	const auto truth  = latticeOf(levels.back().mesh, info);
	for (std::size_t n = 0; n < file().size(); ++n) {
		const ExactBuffer cut(file().data(), n);
		const auto back = decode(cut.data(), cut.size());
		if (!back.hasValue() || table()[std::size_t(back->level)].kind == LevelKind::Split)
			continue; // new vertices that did not arrive may be anywhere between their parents
		const int bits    = table()[std::size_t(std::max(back->level - 1, 0))].bits;
		const double cell = double(std::int64_t {1} << (info.bits - bits));
		for (std::size_t v = 0; v < back->mesh.positions.size(); ++v)
			for (std::size_t k = 0; k < 3; ++k) {
				const double x = (back->mesh.positions[v][k] - info.origin[k]) / info.step;
				ASSERT_LT(std::abs(x - double(truth[v][k])), cell) << n << ' ' << v;
			}
	}
}

TEST_P(EveryPrefix, ExactVertices_NeverGetFewerWithinTheCompactLevelOfFullPrecision)
{
	const StreamInfo& info = GetParam().encoded.info;
	if (info.mode != Mode::Compact)
		GTEST_SKIP() << "classic";
	if (finishes())
		GTEST_SKIP() << "the finest mesh is numbered anew";
	const auto levels = levelsOf(file());
	std::vector<std::size_t> before(levels.size(), 0);
	for (std::size_t n = 0; n <= file().size(); ++n) {
		const ExactBuffer cut(file().data(), n);
		const auto back = decode(cut.data(), cut.size());
		if (!back.hasValue() || table()[std::size_t(back->level)].bits < info.bits)
			continue;
		const auto& full  = levels[std::size_t(back->level)].mesh.positions;
		std::size_t exact = 0;
		for (std::size_t v = 0; v < full.size(); ++v)
			exact += back->mesh.positions[v] == full[v];
		ASSERT_GE(exact, before[std::size_t(back->level)]) << n;
		before[std::size_t(back->level)] = exact;
	}
	EXPECT_EQ(before.back(), levels.back().mesh.positions.size());
}

TEST_P(EveryPrefix, VerticesThatArrived_AreExactWithoutLifting)
{
	if (GetParam().encoded.info.lifting != kLiftingOff)
		GTEST_SKIP() << "lifting moves the parents as details arrive";
	if (GetParam().encoded.info.mode == Mode::Compact)
		GTEST_SKIP() << "vertices arrive along a walk, and levels differ in precision";
	if (finishes())
		GTEST_SKIP() << "the finest mesh is numbered anew";
	const auto levels  = levelsOf(file());
	std::size_t before = 0;
	for (std::size_t n = 0; n <= file().size(); ++n) {
		const ExactBuffer cut(file().data(), n);
		const auto back = decode(cut.data(), cut.size());
		if (!back.hasValue())
			continue;
		const auto& full  = levels[static_cast<std::size_t>(back->level)].mesh.positions;
		std::size_t exact = 0;
		while (exact < full.size() && back->mesh.positions[exact] == full[exact])
			++exact;
		ASSERT_GE(exact, before) << n;
		before = exact;
	}
	EXPECT_EQ(before, levels.back().mesh.positions.size());
}

TEST_P(EveryPrefix, MaxBytes_IsTheSameAsACut)
{
	for (std::size_t n = 0; n <= file().size(); n += 7) {
		DecodeOptions o;
		o.maxBytes = n;
		const ExactBuffer cut(file().data(), n);
		const auto a = decode(cut.data(), cut.size()), b = decode(file().data(), file().size(), o);
		ASSERT_EQ(a.status().code, b.status().code) << n;
		ASSERT_EQ(a.status().what, b.status().what) << n;
		ASSERT_EQ(a.hasValue(), b.hasValue());
		if (a.hasValue()) {
			ASSERT_EQ(a->level, b->level);
			ASSERT_EQ(a->mesh.positions, b->mesh.positions);
			ASSERT_EQ(a->mesh.triangles, b->mesh.triangles);
		}
	}
}

TEST_P(EveryPrefix, ReadInfo_NeedsTheHeadAlone)
{
	const std::size_t head = chunksOf(file()).front().end;
	for (std::size_t n = 0; n <= head; ++n) {
		const ExactBuffer cut(file().data(), n);
		const auto info = readInfo(cut.data(), cut.size());
		ASSERT_EQ(
		    info.status().code, n == head ? StatusCode::Ok
		                        : n == 0  ? StatusCode::NotWmc
		                                  : StatusCode::Truncated);
	}
	EXPECT_LT(head, 300u);
}

TEST_P(EveryPrefix, DecoderAfterTruncated_StaysAndSaysTheSameAgain)
{
	for (std::size_t n = chunksOf(file()).front().end; n < file().size(); n += 5) {
		const ExactBuffer cut(file().data(), n);
		auto decoder = Decoder::open(cut.data(), cut.size());
		ASSERT_TRUE(decoder.ok());
		Status s;
		while (s.ok() && decoder->level() < decoder->info().finestLevel())
			s = decoder->advance();
		ASSERT_EQ(s.code, StatusCode::Truncated);
		const int level = decoder->level();
		if (level == decoder->info().finestLevel())
			continue;
		EXPECT_EQ(decoder->advance().code, StatusCode::Truncated);
		EXPECT_EQ(decoder->level(), level);
	}
}

TEST_P(EveryPrefix, LevelTable_AddsUpToTheFile)
{
	std::uint64_t sum = 0;
	for (const LevelInfo& l : table()) {
		sum += l.bytes;
		EXPECT_EQ(l.prefix, sum);
		EXPECT_LE(l.prefix, file().size());
	}
	EXPECT_EQ(sum, file().size());
	const StreamInfo& info = GetParam().encoded.info;
	EXPECT_LE(info.connectivityBytes + info.geometryBytes, file().size());
	EXPECT_EQ(table().back().error, 0);
	EXPECT_EQ(table().back().bits, info.bits);
	for (std::size_t j = 1; j < table().size(); ++j) {
		EXPECT_GE(table()[j].error, 0);
		if (info.mode == Mode::Classic) {
			EXPECT_LE(table()[j].error, table()[j - 1].error);
		}
		EXPECT_EQ(table()[j].bits > table()[j - 1].bits, table()[j].kind == LevelKind::Precise);
	}
}

TEST_P(EveryPrefix, ReadInfo_SaysWhatEncodeSaid)
{
	const auto info = readInfo(file().data(), file().size());
	ASSERT_TRUE(info.ok());
	const StreamInfo& said = GetParam().encoded.info;
	EXPECT_EQ(info->bytes, file().size());
	EXPECT_EQ(info->mode, said.mode);
	EXPECT_EQ(info->lifting, said.lifting);
	EXPECT_EQ(info->wgc, said.wgc);
	EXPECT_EQ(info->bits, said.bits);
	EXPECT_EQ(info->origin, said.origin);
	EXPECT_EQ(info->step, said.step);
	EXPECT_EQ(info->vertices, GetParam().original.positions.size());
	EXPECT_EQ(info->faces, GetParam().original.triangles.size());
	EXPECT_EQ(info->connectivityBytes, said.connectivityBytes);
	EXPECT_EQ(info->geometryBytes, said.geometryBytes);
	ASSERT_EQ(info->levels.size(), said.levels.size());
	for (std::size_t j = 0; j < said.levels.size(); ++j) {
		EXPECT_EQ(info->levels[j].kind, said.levels[j].kind);
		EXPECT_EQ(info->levels[j].vertices, said.levels[j].vertices);
		EXPECT_EQ(info->levels[j].faces, said.levels[j].faces);
		EXPECT_EQ(info->levels[j].bytes, said.levels[j].bytes);
		EXPECT_EQ(info->levels[j].prefix, said.levels[j].prefix);
		EXPECT_EQ(info->levels[j].error, said.levels[j].error);
		EXPECT_EQ(info->levels[j].bits, said.levels[j].bits);
	}
}

TEST(SmallFiles, AreOfEveryKindOfSchedule)
{
	int alternating = 0, wholeAtTheEnd = 0, classic = 0;
	for (const SmallFile& small : smallFiles()) {
		const auto& levels = small.encoded.info.levels;
		int turns          = 0; // from precise to split
		for (std::size_t j = 1; j < levels.size(); ++j)
			turns += levels[j].kind == LevelKind::Split && levels[j - 1].kind == LevelKind::Precise;
		const std::size_t last = levels.size() - 1;
		alternating += turns >= 1;
		wholeAtTheEnd += last >= 2 && levels[last].bits - levels[last - 1].bits > 2;
		classic += small.encoded.info.mode == Mode::Classic;
	}
	EXPECT_GE(alternating, 2);
	EXPECT_GE(wholeAtTheEnd, 2);
	EXPECT_GE(classic, 2);
}

INSTANTIATE_TEST_SUITE_P(
    Truncated, EveryPrefix, testing::ValuesIn(smallFiles()), [](const auto& small) {
	    return small.param.name;
    });

} // namespace
} // namespace wavemesh::test
