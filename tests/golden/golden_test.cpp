// SPDX-License-Identifier: GPL-3.0-or-later
// Goldens decode to what they always did, or are refused as they always were; sizes on the samples
// stay near what is recorded, in both directions.
#include "codec_check.h"
#include "golden_files.h"
#include "sample_sizes.h"
#include "sanitized.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace wavemesh::test {
namespace {

constexpr char kHowTo[] =
    "\nIf the format or the encoder changed on purpose: "
    "cmake --build <build> --target regenerate_goldens, and commit tests/golden.";

std::vector<std::string> linesOf(const std::string& name)
{
	std::ifstream in(std::string(WAVEMESH_GOLDEN_DIR) + "/" + name);
	std::vector<std::string> lines;
	for (std::string line; std::getline(in, line);)
		if (!line.empty() && line[0] != '#')
			lines.push_back(line);
	return lines;
}

TEST(Golden, Files_GiveTheStatusLevelAndMeshInTheIndex)
{
	const auto lines = linesOf("index.txt");
	ASSERT_GT(lines.size(), 20u) << kHowTo;
	for (const std::string& line : lines) {
		Golden g;
		g.name  = line.substr(0, line.find(' '));
		g.bytes = readFile(std::string(WAVEMESH_GOLDEN_DIR) + "/" + g.name);
		EXPECT_EQ(indexLine(outcomeOf(g)), line) << kHowTo;
		EXPECT_EQ(g.name.substr(0, 4) == "good", outcomeOf(g).status == 0) << g.name;
	}
}

TEST(Golden, GoodFiles_HaveManifoldLevelsOfOneTopology)
{
	for (const std::string& line : linesOf("index.txt")) {
		const std::string name = line.substr(0, line.find(' '));
		if (name.substr(0, 4) != "good")
			continue;
		const Bytes file  = readFile(std::string(WAVEMESH_GOLDEN_DIR) + "/" + name);
		const auto finest = decode(file.data(), file.size());
		ASSERT_TRUE(finest.ok()) << name << kHowTo;
		const StreamFeatures& f = finest->info.features;
		if (f.restored || f.orderKept || f.exact)
			continue; // the finest mesh is not the finest level
		EXPECT_EQ(whatIsWrongWithLevels(finest->mesh, file), "") << name;
	}
}

std::string samplePath(const std::string& name, const char* suffix)
{
	return std::string(WAVEMESH_SAMPLES_DIR) + "/" + name + suffix;
}

TEST(Samples, InEveryConfigurationRoundTripAndKeepTheirSize)
{
	const auto lines = linesOf("sample_sizes.txt");
	EXPECT_EQ(lines.size(), kSamples.size() * kConfigurations.size()) << kHowTo;
	for (const std::string& line : lines) {
		std::istringstream words(line);
		std::string sample, configuration;
		double recorded = 0;
		words >> sample >> configuration >> recorded;
		SCOPED_TRACE(sample + ' ' + configuration);
		const auto c = std::find_if(
		    kConfigurations.begin(), kConfigurations.end(),
		    [&](const Configuration& each) { return each.name == configuration; });
		ASSERT_NE(c, kConfigurations.end()) << kHowTo;
		if (kSanitized && c->effort == 3)
			continue; // minutes, for code that effort 2 runs too
		const MeshData mesh    = readSamplePly(samplePath(sample, ".ply"));
		const EncodedMesh file = encodeSample(mesh, *c);
		const auto bytes       = static_cast<double>(file.bytes.size());
		EXPECT_LE(bytes, 1.01 * recorded) << "a loss" << kHowTo;
		EXPECT_GE(bytes, 0.97 * recorded) << "a gain!" << kHowTo;
		const auto back = decode(file.bytes.data(), file.bytes.size());
		ASSERT_TRUE(back.ok()) << back.status().what;
		EXPECT_EQ(whatIsLost(mesh, back->mesh, back->info), "");
		EXPECT_EQ(whatIsWrongWithLevels(mesh, file.bytes), "");
	}
}

TEST(Samples, TheirWmcFilesAreTheirMeshes)
{
	for (const std::string& name : kSamples) {
		const Bytes file = readFile(samplePath(name, ".wmc"));
		const auto back  = decode(file.data(), file.size());
		ASSERT_TRUE(back.ok()) << name << ": " << back.status().what
		                       << "\nsamples/generate writes the samples and their .wmc anew.";
		const MeshData mesh = readSamplePly(samplePath(name, ".ply"));
		EXPECT_EQ(whatIsLost(mesh, back->mesh, back->info), "") << name;
	}
}

} // namespace
} // namespace wavemesh::test
