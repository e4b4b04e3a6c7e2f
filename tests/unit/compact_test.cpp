// SPDX-License-Identifier: GPL-3.0-or-later
// Files of the compact mode as a whole: schedules, precision, errors, sizes.
#include "codec_check.h"
#include "mesh_families.h"

#include <gtest/gtest.h>

#include <cmath>

namespace wavemesh::test {
namespace {

EncodedMesh
compact(const MeshData& mesh, int bits = 12, int effort = 2, Optimize optimize = Optimize::Balanced)
{
	EncodeOptions o;
	o.mode     = Mode::Compact;
	o.bits     = bits;
	o.effort   = effort;
	o.optimize = optimize;
	return encode(mesh, o).value();
}

std::size_t preciseLevels(const StreamInfo& info)
{
	std::size_t n = 0;
	for (const LevelInfo& l : info.levels)
		n += l.kind == LevelKind::Precise;
	return n;
}

TEST(Compact, IsTheDefaultAndAtEffort1AClassicFileWithoutLifting)
{
	const MeshData mesh = makeBumpySphere(300, 1);
	EXPECT_EQ(encode(mesh)->info.mode, Mode::Compact);
	EXPECT_EQ(encode(mesh)->bytes, compact(mesh).bytes);
	const EncodedMesh fast = compact(mesh, 12, 1);
	EXPECT_EQ(fast.info.mode, Mode::Classic);
	EXPECT_EQ(fast.info.lifting, kLiftingOff);
}

TEST(Compact, IsSmallerThanClassicWhereSurfacesAreSmoothOrRepeat)
{
	for (const MeshData& mesh : {makeBumpySphere(900, 1), makeIcosphere(12), makeGrid(30, 30)}) {
		EncodeOptions o;
		o.mode    = Mode::Classic;
		o.lifting = kLiftingOff;
		EXPECT_LT(compact(mesh).bytes.size(), encode(mesh, o)->bytes.size());
	}
}

// Large enough to be encoded in one way; a smooth surface is predicted from exact coarse levels,
// and another choice of vertices than 4:1 would not pay.
TEST(Compact, RegularMeshes_AreSmallForEveryAim)
{
	const MeshData torus = makeTorus(160, 104), sphere = makeIcosphere(48);
	const auto bitsPerVertex = [](const MeshData& mesh, Optimize aim) {
		return 8.0 * double(compact(mesh, 12, 2, aim).bytes.size()) / double(mesh.positions.size());
	};
	for (const Optimize aim : {Optimize::Size, Optimize::Balanced, Optimize::Levels}) {
		EXPECT_LE(bitsPerVertex(torus, aim), 1.9) << int(aim);
		EXPECT_LE(bitsPerVertex(sphere, aim), 2.75) << int(aim);
	}
}

TEST(Compact, Effort3_IsNeverLargerThanEffort2)
{
	for (const auto& family : smallFamilies(200)) {
		EncodeOptions o;
		o.optimize         = Optimize::Size;
		const auto sizeFor = [&](int effort) {
			o.effort = effort;
			return encode(family.mesh, o)->bytes.size();
		};
		EXPECT_LE(sizeFor(3), sizeFor(2) + 1) << family.name;
	}
}

TEST(Compact, LevelsOfASmoothSurface_GetPreciseBitAfterBit)
{
	EncodeOptions o;
	o.wgc                 = Wgc::Off; // one way
	const StreamInfo info = encode(makeBumpySphere(900, 1), o).value().info;
	EXPECT_GE(preciseLevels(info), 3u);
	for (std::size_t j = 1; j < info.levels.size(); ++j)
		EXPECT_LE(info.levels[j].bits - info.levels[j - 1].bits, 2) << j;
}

TEST(Compact, LevelsOfAMeshThatRepeats_GetAllLastBitsAtOnceWhereSizeIsAllThatCounts)
{
	EncodeOptions o;
	o.optimize            = Optimize::Size;
	o.wgc                 = Wgc::Off; // one way
	const StreamInfo info = encode(makeFlatGrid(20, 20), o).value().info;
	ASSERT_GE(info.levels.size(), 3u);
	EXPECT_EQ(info.levels.back().kind, LevelKind::Precise);
	EXPECT_GT(info.levels.back().bits - info.levels[info.levels.size() - 2].bits, 2);
	EXPECT_EQ(info.levels[info.levels.size() - 2].kind, LevelKind::Split);
}

TEST(Compact, PreciseLevels_HaveTheFacesOfTheLevelBeforeAndNoConnectivity)
{
	const auto file   = compact(makeBumpySphere(900, 1));
	const auto levels = levelsOf(file.bytes);
	for (std::size_t j = 1; j < levels.size(); ++j)
		if (file.info.levels[j].kind == LevelKind::Precise) {
			EXPECT_EQ(levels[j].mesh.triangles, levels[j - 1].mesh.triangles);
			EXPECT_EQ(file.info.levels[j].connectivityBytes, 0u);
		}
}

TEST(Compact, LevelTable_SaysThePrecisionOfEveryLevel)
{
	for (const auto& family : smallFamilies(450))
		for (const int bits : {1, 2, 12, 24}) {
			const StreamInfo info = compact(family.mesh, bits).info;
			EXPECT_EQ(info.levels.back().bits, bits) << family.name;
			EXPECT_GE(info.levels.front().bits, 1) << family.name;
			for (std::size_t j = 1; j < info.levels.size(); ++j) {
				const bool precise = info.levels[j].kind == LevelKind::Precise;
				EXPECT_EQ(info.levels[j].bits > info.levels[j - 1].bits, precise) << family.name;
			}
		}
}

TEST(Compact, Errors_FallToZeroAtTheFinestLevel)
{
	for (const Optimize optimize : {Optimize::Size, Optimize::Balanced, Optimize::Levels})
		for (const int effort : {1, 2, 3}) {
			const StreamInfo info = compact(makeBumpySphere(900, 1), 12, effort, optimize).info;
			for (std::size_t j = 0; j + 1 < info.levels.size(); ++j)
				EXPECT_GT(info.levels[j].error, 0) << j;
			EXPECT_EQ(info.levels.back().error, 0);
			EXPECT_LT(info.levels[info.levels.size() - 2].error, info.levels[0].error / 2);
		}
}

TEST(Compact, Error_OfALevelWithAllVerticesIsTheirRmsDistance)
{
	const auto file   = compact(makeBumpySphere(900, 1), 14);
	const auto levels = levelsOf(file.bytes);
	const auto& truth = levels.back().mesh.positions;
	std::size_t seen  = 0;
	for (std::size_t j = 0; j + 1 < levels.size(); ++j) {
		const auto& p = levels[j].mesh.positions;
		if (p.size() != truth.size())
			continue;
		++seen;
		double squares = 0;
		for (std::size_t v = 0; v < p.size(); ++v)
			for (std::size_t k = 0; k < 3; ++k)
				squares += std::pow(p[v][k] - truth[v][k], 2);
		const double rms = std::sqrt(squares / double(p.size()));
		// The code keeps two bits of the mantissa of the square.
		EXPECT_LE(file.info.levels[j].error, rms * 1.001) << j;
		EXPECT_GE(file.info.levels[j].error, rms * 0.89) << j;
	}
	EXPECT_GE(seen, 1u);
}

TEST(Compact, TheSameMeshGivesTheSameBytes)
{
	for (const int effort : {2, 3})
		EXPECT_EQ(
		    compact(makeTerrain(200, 1), 12, effort).bytes,
		    compact(makeTerrain(200, 1), 12, effort).bytes);
}

TEST(Compact, EncodingCancelsAtAnyCallOfProgress)
{
	const MeshData mesh = makeBumpySphere(100, 1);
	EncodeOptions o;
	o.effort    = 3;
	int calls   = 0;
	double last = -1;
	o.progress  = [&](double fraction) {
        ++calls;
        EXPECT_GE(fraction, last);
        last = fraction;
        return true;
	};
	ASSERT_TRUE(encode(mesh, o).ok());
	EXPECT_GT(calls, 20);
	EXPECT_LE(last, 1);
	for (int stop = 1; stop <= calls; stop += 1 + stop / 4) {
		int call   = 0;
		o.progress = [&](double) { return ++call < stop; };
		EXPECT_EQ(encode(mesh, o).status().code, StatusCode::Cancelled) << stop;
	}
}

TEST(Compact, OptionsOutOfRangeAreRefused)
{
	const MeshData mesh = makeTriangle();
	for (const int effort : {-1, 0, 4}) {
		EncodeOptions o;
		o.effort = effort;
		EXPECT_EQ(encode(mesh, o).status().code, StatusCode::InvalidArgument);
	}
	EncodeOptions o;
	o.mode = Mode(2);
	EXPECT_EQ(encode(mesh, o).status().code, StatusCode::InvalidArgument);
	o.mode     = Mode::Compact;
	o.optimize = Optimize(3);
	EXPECT_EQ(encode(mesh, o).status().code, StatusCode::InvalidArgument);
}

} // namespace
} // namespace wavemesh::test
