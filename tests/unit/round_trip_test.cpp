// SPDX-License-Identifier: GPL-3.0-or-later
// The whole codec: mesh family x options.
#include "codec_check.h"
#include "mesh_families.h"

#include <gtest/gtest.h>

#include <cmath>

namespace wavemesh::test {
namespace {

constexpr int kBits[]          = {1, 2, 8, 12, 16, 20, 24};
constexpr Mode kModes[]        = {Mode::Classic, Mode::Compact};
constexpr int kLifting[]       = {kLiftingOff, 0, 1, 2};
constexpr Wgc kWgc[]           = {Wgc::Off, Wgc::On, Wgc::Auto};
constexpr Optimize kOptimize[] = {Optimize::Size, Optimize::Balanced, Optimize::Levels};

/// Every bits, mode, effort and aim; classic with every lifting, the criterion in turn.
std::vector<EncodeOptions> everyOption()
{
	std::vector<EncodeOptions> all;
	for (int bits : kBits)
		for (Optimize optimize : kOptimize)
			for (int effort : {1, 2, 3})
				for (Mode mode : kModes) {
					EncodeOptions o;
					o.bits     = bits;
					o.optimize = optimize;
					o.effort   = effort;
					o.mode     = mode;
					o.lifting  = kLifting[all.size() / 2 % 4];
					o.wgc      = kWgc[(all.size() / 2 + all.size() / 6) % 3];
					all.push_back(o);
				}
	return all;
}

std::string whatFails(const MeshData& mesh, const EncodeOptions& options, bool levels)
{
	const auto file = encode(mesh, options);
	if (!file.ok())
		return "encode: " + file.status().what;
	if (file->info.bytes != file->bytes.size())
		return "the info has another file size";
	const auto back = decode(file->bytes.data(), file->bytes.size());
	if (!back.ok())
		return "decode: " + back.status().what;
	if (back->level != back->info.finestLevel())
		return "decode stopped early";
	if (std::string s = whatIsLost(mesh, back->mesh, back->info); !s.empty())
		return s;
	return levels ? whatIsWrongWithLevels(mesh, file->bytes) : std::string();
}

class EveryFamily : public testing::TestWithParam<NamedMesh>
{
};

TEST_P(EveryFamily, RoundTrip_IsLatticeLosslessAndEveryLevelManifold)
{
	const MeshData& mesh = GetParam().mesh;
	const auto all       = everyOption();
	// Small meshes with all options, others with some, each with other ones.
	const std::size_t stride = mesh.positions.size() <= 60    ? 1
	                           : mesh.positions.size() <= 450 ? 11
	                                                          : 29;
	for (std::size_t i = mesh.triangles.size() % stride; i < all.size(); i += stride)
		ASSERT_EQ(whatFails(mesh, all[i], true), "") << nameOf(all[i]);
}

INSTANTIATE_TEST_SUITE_P(
    RoundTrip, EveryFamily, testing::ValuesIn(allFamilies()), [](const auto& family) {
	    return family.param.name;
    });

TEST(RoundTrip, EveryCombinationOfClassicOptionsIsLossless)
{
	const MeshData mesh = joined({makeFlippedSphere(150, 71), makeTerrain(100, 72)});
	for (int bits : kBits)
		for (int lifting : kLifting)
			for (Wgc wgc : kWgc)
				for (Optimize optimize : kOptimize) {
					EncodeOptions o;
					o.mode     = Mode::Classic;
					o.bits     = bits;
					o.lifting  = lifting;
					o.wgc      = wgc;
					o.optimize = optimize;
					ASSERT_EQ(whatFails(mesh, o, false), "") << nameOf(o);
				}
}

TEST(RoundTrip, StepInModelUnitsIsKept)
{
	for (Mode mode : kModes)
		for (double step : {1e-6, 0.001, 0.01, 0.1, 1.0, 3.0, 1000.0}) {
			EncodeOptions o;
			o.mode              = mode;
			o.step              = step;
			const MeshData mesh = makeBumpySphere(300, 73);
			ASSERT_EQ(whatFails(mesh, o, true), "") << step;
			ASSERT_EQ(encode(mesh, o)->info.step, step);
		}
}

TEST(RoundTrip, NoVertexMovesFartherThanHalfAStep)
{
	for (int bits : kBits) {
		EncodeOptions o;
		o.bits              = bits;
		o.lifting           = kLiftingOff;
		const MeshData mesh = makeTriangle(); // three vertices: told apart without a search
		const auto file     = encode(mesh, o);
		ASSERT_TRUE(file.ok());
		const auto back = decode(file->bytes.data(), file->bytes.size());
		ASSERT_TRUE(back.ok());
		ASSERT_EQ(back->mesh.positions.size(), mesh.positions.size());
		for (const auto& p : mesh.positions) {
			double nearest = 1e300;
			for (const auto& q : back->mesh.positions) {
				double farthest = 0;
				for (std::size_t k = 0; k < 3; ++k)
					farthest = std::max(farthest, std::abs(p[k] - q[k]));
				nearest = std::min(nearest, farthest);
			}
			EXPECT_LE(nearest, 0.5 * back->info.step * (1 + 1e-9)) << bits;
		}
	}
}

TEST(RoundTrip, ConnectivityOfEveryLevelIsTheSameWhateverTheLifting)
{
	for (const MeshData& mesh :
	     {makeBumpySphere(400, 74), makeTerrain(300, 75), makeHoledPlate(2, 3)}) {
		EncodeOptions o;
		o.mode          = Mode::Classic;
		o.wgc           = Wgc::Off;
		o.lifting       = kLiftingOff;
		const auto lazy = levelsOf(encode(mesh, o)->bytes);
		for (int lifting : {0, 1, 2}) {
			o.lifting         = lifting;
			const auto lifted = levelsOf(encode(mesh, o)->bytes);
			ASSERT_EQ(lifted.size(), lazy.size());
			for (std::size_t j = 0; j < lazy.size(); ++j)
				ASSERT_EQ(lifted[j].mesh.triangles, lazy[j].mesh.triangles) << j;
		}
	}
}

TEST(RoundTrip, DecoderAndDecodeAgreeOnEveryLevel)
{
	for (Mode mode : kModes) {
		EncodeOptions options;
		options.mode      = mode;
		const auto file   = encode(makeCollapsedSphere(300, 76), options);
		const auto levels = levelsOf(file->bytes);
		ASSERT_EQ(levels.size(), file->info.levels.size());
		for (std::size_t j = 0; j < levels.size(); ++j) {
			DecodeOptions o;
			o.level         = static_cast<int>(j);
			const auto back = decode(file->bytes.data(), file->bytes.size(), o);
			ASSERT_TRUE(back.ok());
			EXPECT_EQ(back->level, o.level);
			EXPECT_EQ(back->mesh.triangles, levels[j].mesh.triangles);
			EXPECT_EQ(back->mesh.positions, levels[j].mesh.positions);
		}
	}
}

TEST(RoundTrip, LevelPastTheFinestIsTheFinest)
{
	const auto file = encode(makeIcosphere(3));
	DecodeOptions o;
	o.level         = 1000;
	const auto back = decode(file->bytes.data(), file->bytes.size(), o);
	ASSERT_TRUE(back.ok());
	EXPECT_EQ(back->level, back->info.finestLevel());
}

TEST(RoundTrip, EncodingWhatWasDecodedLosesNothingMore)
{
	const MeshData mesh = makeFlippedSphere(200, 77);
	const auto once     = encode(mesh);
	const auto back     = decode(once->bytes.data(), once->bytes.size());
	EncodeOptions o;
	o.step           = back->info.step;
	const auto twice = encode(back->mesh, o);
	ASSERT_TRUE(twice.ok()) << twice.status().what;
	const auto again = decode(twice->bytes.data(), twice->bytes.size());
	ASSERT_TRUE(again.ok());
	EXPECT_EQ(whatIsLost(back->mesh, again->mesh, again->info), "");
}

} // namespace
} // namespace wavemesh::test
