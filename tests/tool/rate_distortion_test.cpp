// SPDX-License-Identifier: GPL-3.0-or-later
// How close to the original the levels of a file are, for what they cost: the three aims of
// --optimize, on the samples. Distances are sampled at the same points every time.
#include "mesh_files.h"

#include <metrics/surface_distance.h>
#include <wavemesh/codec.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace wavemesh::test {
namespace {

struct Curve
{
	double bitsPerVertex = 0; ///< of the whole file
	std::array<double, 3> rms {};
};

constexpr std::array<double, 3> kRates {2, 4, 8}; ///< bits per vertex

/// RMS over the diagonal at each of kRates, on the line between the levels on either side: a
/// staircase alone would be at the mercy of its steps.
Curve curveOf(const std::string& sample, Optimize optimize)
{
	const MeshData mesh = tool::loadMesh(std::string(SAMPLES_FOLDER) + "/" + sample + ".ply");
	const metrics::DistanceMeter meter(mesh, 10000);
	EncodeOptions o;
	o.bits          = 10;
	o.optimize      = optimize;
	const auto file = encode(mesh, o).value();
	auto decoder    = Decoder::open(file.bytes.data(), file.bytes.size());
	std::vector<std::array<double, 2>> points; // rate, log of the error
	for (const LevelInfo& level : file.info.levels) {
		EXPECT_TRUE(decoder->advance().ok());
		points.push_back(
		    {8 * double(level.prefix) / double(file.info.vertices),
		     std::log(meter.measure(decoder->mesh()).rms / meter.diagonal())});
	}
	Curve curve;
	curve.bitsPerVertex = points.back()[0];
	for (std::size_t i = 0; i < kRates.size(); ++i) {
		const auto after = std::find_if(
		    points.begin(), points.end() - 1, [&](const auto& p) { return p[0] > kRates[i]; });
		const auto before = after == points.begin() ? after : after - 1;
		const double t =
		    after == before
		        ? 0
		        : std::min(1.0, (kRates[i] - (*before)[0]) / ((*after)[0] - (*before)[0]));
		curve.rms[i] = std::exp((1 - t) * (*before)[1] + t * (*after)[1]);
	}
	return curve;
}

struct Ceiling
{
	const char* sample;
	std::array<double, 3> balanced, levels; ///< RMS in % of the diagonal at kRates
};

class RateDistortion : public testing::TestWithParam<Ceiling>
{
};

TEST_P(RateDistortion, StaysBelowItsCeilingsAndLevelsBelowSize)
{
	const Ceiling& ceiling = GetParam();
	const Curve size       = curveOf(ceiling.sample, Optimize::Size);
	const Curve balanced   = curveOf(ceiling.sample, Optimize::Balanced);
	const Curve levels     = curveOf(ceiling.sample, Optimize::Levels);
	for (std::size_t i = 0; i < kRates.size(); ++i) {
		EXPECT_LE(100 * balanced.rms[i], ceiling.balanced[i]) << kRates[i] << " bpv";
		EXPECT_LE(100 * levels.rms[i], ceiling.levels[i]) << kRates[i] << " bpv";
	}
	// Where the best levels make the smallest file, both aims take them.
	const double better = levels.bitsPerVertex > 1.03 * size.bitsPerVertex ? 0.8 : 1;
	EXPECT_LE(levels.rms[0], better * size.rms[0]);
	EXPECT_LE(levels.rms[1], better * size.rms[1]);
	EXPECT_LE(balanced.bitsPerVertex, 1.03 * size.bitsPerVertex);
}

INSTANTIATE_TEST_SUITE_P(
    Samples,
    RateDistortion,
    testing::Values(
        Ceiling {"blob", {0.290, 0.138, 0.048}, {0.163, 0.081, 0.042}},
        Ceiling {"bracket", {0.410, 0.095, 0.020}, {0.410, 0.095, 0.020}},
        Ceiling {"vase", {0.295, 0.177, 0.074}, {0.169, 0.081, 0.041}}),
    [](const auto& parameter) { return std::string(parameter.param.sample); });

TEST(Samples, BalancedTakesAtMost3PercentMoreThanSize)
{
	for (const char* sample :
	     {"blob", "bracket", "die", "island", "pebble", "pieces", "pretzel", "vase"}) {
		const MeshData mesh = tool::loadMesh(std::string(SAMPLES_FOLDER) + "/" + sample + ".ply");
		for (const int bits : {8, 10, 12}) {
			EncodeOptions o;
			o.bits              = bits;
			const auto balanced = double(encode(mesh, o)->bytes.size());
			o.optimize          = Optimize::Size;
			EXPECT_LE(balanced, 1.03 * double(encode(mesh, o)->bytes.size()))
			    << sample << ", " << bits << " bits";
		}
	}
}

} // namespace
} // namespace wavemesh::test
