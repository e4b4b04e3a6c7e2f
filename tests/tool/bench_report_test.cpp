// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_families.h"
#include "run_wmc.h"

#include <filesystem>
#include <sstream>

namespace wavemesh::test {

TEST_F(WmcTest, ReportGivesRateAndDistortionOfEveryLevel)
{
	writeObj(path("a.obj"), makeBumpySphere(900, 1));
	const RunResult r = runWmc({"report", path("a.obj"), "--samples", "20000", "--json"});
	ASSERT_EQ(r.code, 0) << r.err;
	const auto j = r.json();
	for (const char* key :
	     {"vertices", "faces", "bytes", "bits_per_vertex", "encode_seconds", "decode_seconds"})
		EXPECT_TRUE(j.contains(key)) << key;
	EXPECT_EQ(j["samples"], 20000);
	const auto& levels = j["levels"];
	ASSERT_GE(levels.size(), 3u);
	for (std::size_t i = 0; i < levels.size(); ++i) {
		EXPECT_LE(levels[i]["rms"], levels[i]["max"]);
		if (i > 0) {
			EXPECT_GT(levels[i]["bits_per_vertex"], levels[i - 1]["bits_per_vertex"]);
		}
	}
	// The finest is off by the lattice alone: half a step in each coordinate, 12 bits.
	EXPECT_GT(levels.back()["rms"], 0);
	EXPECT_LT(levels.back()["max"], 0.87 / 4095);
	EXPECT_GT(levels.front()["rms"].get<double>(), 10 * levels.back()["rms"].get<double>());
}

TEST_F(WmcTest, ReportWritesTheSameNumbersAsCsv)
{
	writeObj(path("a.obj"), makeTorus(30, 20));
	const RunResult r =
	    runWmc({"report", path("a.obj"), "--samples", "5000", "--json", "--csv", path("a.csv")});
	ASSERT_EQ(r.code, 0) << r.err;
	const FileBytes bytes = readAll(path("a.csv"));
	std::istringstream lines(std::string(bytes.begin(), bytes.end()));
	std::string line;
	ASSERT_TRUE(std::getline(lines, line));
	EXPECT_EQ(
	    line, "configuration,level,kind,vertices,faces,bytes,prefix,bits_per_vertex,rms,max,error,"
	          "connectivity_bytes,geometry_bytes,rms_units,max_units");
	std::size_t rows  = 0;
	const auto levels = r.json()["levels"];
	for (; std::getline(lines, line); ++rows) {
		const auto& level = levels[rows];
		EXPECT_NE(
		    line.find("," + std::to_string(level["prefix"].get<std::uint64_t>()) + ","), line.npos);
	}
	EXPECT_EQ(rows, levels.size());
}

TEST_F(WmcTest, ReportComparesTheThreeConfigurationsAndTheCompactMode)
{
	writeObj(path("a.obj"), makeStarPrism(16, 20));
	const RunResult r =
	    runWmc({"report", path("a.obj"), "--samples", "2000", "--configs", "--json"});
	ASSERT_EQ(r.code, 0) << r.err;
	const auto all = r.json()["configurations"];
	ASSERT_EQ(all.size(), 4u);
	EXPECT_EQ(all[0]["configuration"], "I");
	EXPECT_EQ(all[0]["lifting"], "off");
	EXPECT_EQ(all[0]["wgc"], "off");
	EXPECT_EQ(all[1]["lifting"], "0");
	EXPECT_EQ(all[1]["wgc"], "off");
	EXPECT_EQ(all[2]["lifting"], "0");
	EXPECT_EQ(all[2]["wgc"], "on");
	for (std::size_t i = 0; i < 3; ++i)
		EXPECT_EQ(all[i]["mode"], "classic");
	EXPECT_EQ(all[3]["configuration"], "compact");
	EXPECT_EQ(all[3]["mode"], "compact");
	const RunResult text =
	    runWmc({"report", path("a.obj"), "--samples", "2000", "--configs", "--lifting", "1"});
	EXPECT_EQ(text.code, 0);
	EXPECT_NE(text.out.find("III"), std::string::npos);
	EXPECT_NE(text.out.find("compact"), std::string::npos);
}

TEST_F(WmcTest, ReportIsTheSameEveryTime)
{
	writeObj(path("a.obj"), makeTerrain(400, 1));
	const std::vector<std::string> command {"report", path("a.obj"), "--samples", "3000"};
	EXPECT_EQ(runWmc(command).out, runWmc(command).out);
}

TEST_F(WmcTest, BenchTakesFilesAndFolders)
{
	writeObj(path("a.obj"), makeBumpySphere(900, 1));
	std::filesystem::create_directory(path("folder"));
	writeObj(path("folder/c.obj"), makeTorus(20, 10));
	writeObj(path("folder/b.obj"), makeTorus(10, 10));
	writeAll(path("folder/notes.txt"), std::string("not a mesh"));
	const RunResult r = runWmc({"bench", path("a.obj"), path("folder"), "--runs", "1", "--json"});
	ASSERT_EQ(r.code, 0) << r.err;
	const auto j = r.json();
	ASSERT_EQ(j["files"].size(), 3u);
	EXPECT_EQ(j["files"][1]["file"], path("folder/b.obj"));
	EXPECT_EQ(j["vertices"], 1002 + 100 + 200);
	for (const auto& f : j["files"])
		for (const char* key :
		     {"encode_seconds", "decode_seconds", "encode_vertices_per_second",
		      "decode_vertices_per_second", "encode_peak_bytes_per_vertex", "bits_per_vertex"})
			EXPECT_TRUE(f.contains(key)) << key;
	EXPECT_EQ(runWmc({"bench", path("folder"), "--runs", "1"}).code, 0);
	std::filesystem::create_directory(path("none"));
	EXPECT_EQ(runWmc({"bench", path("none")}).code, 1);
}

} // namespace wavemesh::test
