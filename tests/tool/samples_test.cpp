// SPDX-License-Identifier: GPL-3.0-or-later
// The meshes of samples/ are what they are said to be.
#include "mesh_check.h"
#include "mesh_files.h"
#include "run_wmc.h"

#include <filesystem>

namespace wavemesh::test {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> sampleMeshes()
{
	std::vector<std::string> names;
	for (const auto& entry : fs::directory_iterator(SAMPLES_FOLDER))
		if (entry.path().extension() == ".ply")
			names.push_back(entry.path().stem().string());
	return names;
}

std::string sample(const std::string& name)
{
	return std::string(SAMPLES_FOLDER) + "/" + name;
}

} // namespace

TEST_F(WmcTest, SamplesAreManifoldAndAsVariedAsPromised)
{
	bool open = false, handles = false, several = false, closed = false;
	ASSERT_GE(sampleMeshes().size(), 6u);
	for (const std::string& name : sampleMeshes()) {
		Topology t;
		EXPECT_EQ(whatIsNotManifold(tool::loadMesh(sample(name + ".ply")), &t), "") << name;
		open    = open || t.boundaryLoops > 0;
		closed  = closed || t.boundaryLoops == 0;
		handles = handles || t.genus > 1;
		several = several || t.components > 1;
	}
	EXPECT_TRUE(open && closed && handles && several);
}

TEST_F(WmcTest, SamplesAreSmall)
{
	std::uintmax_t bytes = 0;
	for (const auto& entry : fs::recursive_directory_iterator(SAMPLES_FOLDER))
		if (entry.is_regular_file())
			bytes += entry.file_size();
	EXPECT_LE(bytes, 3000000u);
}

TEST_F(WmcTest, SamplesAreWhatTheGeneratorWrites)
{
	ASSERT_EQ(runProgram({GENERATE_SAMPLES_PROGRAM, folder_}).code, 0);
	for (const std::string& name : sampleMeshes())
		EXPECT_EQ(readAll(path(name + ".ply")), readAll(sample(name + ".ply"))) << name;
	EXPECT_EQ(readAll(path("die.png")), readAll(sample("die.png")));
}

TEST_F(WmcTest, EverySampleHasItsWmcAndItHolds)
{
	for (const std::string& name : sampleMeshes()) {
		const RunResult r = runWmc({"verify", sample(name + ".ply"), sample(name + ".wmc")});
		EXPECT_EQ(r.code, 0) << name << ": " << r.err;
	}
}

} // namespace wavemesh::test
