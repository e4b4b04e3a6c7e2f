// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_check.h"
#include "mesh_families.h"
#include "mesh_files.h"
#include "run_wmc.h"

namespace wavemesh::test {

namespace {

void expectCommonFields(const nlohmann::json& j)
{
	for (const char* key : {"vertices", "faces", "bytes", "encode_seconds", "decode_seconds"})
		EXPECT_TRUE(j.contains(key)) << key;
	for (const char* key : {"total", "connectivity", "geometry", "other"})
		EXPECT_TRUE(j.at("bits_per_vertex").at(key).is_number()) << key;
	ASSERT_TRUE(j.at("levels").is_array());
	for (std::size_t i = 0; i < j["levels"].size(); ++i) {
		const auto& level = j["levels"][i];
		EXPECT_EQ(level.at("level"), i);
		EXPECT_EQ(level.at("kind") == "base", i == 0);
		EXPECT_TRUE(i == 0 || level.at("kind") == "split" || level.at("kind") == "precise");
		for (const char* key : {"vertices", "faces", "bytes", "error"})
			EXPECT_TRUE(level.at(key).is_number()) << key;
	}
}

} // namespace

TEST_F(WmcTest, HelpAndVersionAreFine)
{
	for (const std::string command : {"encode", "decode", "info", "verify", "report", "bench"}) {
		const RunResult r = runWmc({command, "--help"});
		EXPECT_EQ(r.code, 0) << command;
		EXPECT_NE(r.out.find("--json"), std::string::npos) << command;
	}
	EXPECT_EQ(runWmc({"--help"}).code, 0);
	EXPECT_EQ(runWmc({"--version"}).out.rfind("wmc ", 0), 0u);
}

TEST_F(WmcTest, WrongCommandLinesExitWithTwoAndOneLine)
{
	writeObj(path("a.obj"), makeTorus(8, 8));
	const std::string in = path("a.obj"), out = path("a.wmc");
	const std::vector<std::vector<std::string>> wrong = {
	    {},
	    {"frobnicate"},
	    {"encode"},
	    {"encode", in},
	    {"encode", in, out, "--bits", "0"},
	    {"encode", in, out, "--bits", "25"},
	    {"encode", in, out, "--bits", "many"},
	    {"encode", in, out, "--step", "-1"},
	    {"encode", in, out, "--bits", "10", "--step", "0.1"},
	    {"encode", in, out, "--mode", "magic"},
	    {"encode", in, out, "--mode", "classic", "--lifting", "3"},
	    {"encode", in, out, "--lifting", "2"},
	    {"encode", in, out, "--mode", "compact", "--lifting", "0"},
	    {"report", in, "--lifting", "1"},
	    {"encode", in, out, "--mode", "modern"},
	    {"encode", in, out, "--effort", "0"},
	    {"encode", in, out, "--effort", "4"},
	    {"encode", in, out, "--optimize", "speed"},
	    {"encode", in, out, "--wgc", "maybe"},
	    {"encode", in, path("a.ply")},
	    {"encode", in, out, "--step", "0"},
	    {"encode", in, out, "--effort", "2.5"},
	    {"report", in, "--configs", "--mode", "classic"},
	    {"encode", in, out, "--unknown"},
	    {"encode", in, out, "extra"},
	    {"decode", in, path("a.xyz")},
	    {"decode", in, path("a.ply"), "--level", "-2"},
	    {"decode", in, path("a.ply"), "--max-bytes", "-5"},
	    {"verify", in},
	    {"report", in, "--samples", "0"},
	    {"bench", in, "--runs", "0"},
	};
	for (const auto& arguments : wrong) {
		const RunResult r = runWmc(arguments);
		EXPECT_EQ(r.code, 2) << ::testing::PrintToString(arguments);
		EXPECT_EQ(r.errorLines(), 1u) << r.err;
		EXPECT_EQ(r.out, "");
	}
	EXPECT_EQ(files(), std::vector<std::string> {"a.obj"});
}

TEST_F(WmcTest, AMeshOfNothingIsAMeshWhereTheFileSaysSo)
{
	tool::saveMesh({}, path("a.ply"));
	tool::saveMesh({}, path("a.off"));
	for (const std::string in : {"a.ply", "a.off"}) {
		EXPECT_EQ(runWmc({"encode", path(in), path("a.wmc")}).code, 0) << in;
		EXPECT_EQ(runWmc({"info", path("a.wmc"), "--json"}).json()["vertices"], 0);
		const RunResult r = runWmc({"verify", path(in), path("a.wmc")});
		EXPECT_EQ(r.code, 0) << r.err;
		EXPECT_EQ(runWmc({"decode", path("a.wmc"), path("b.off")}).code, 0);
		EXPECT_EQ(readAll(path("b.off")), readAll(path("a.off")));
	}
	writeAll(path("a.obj"), std::string("# nothing\n"));
	EXPECT_EQ(runWmc({"encode", path("a.obj"), path("a.wmc")}).code, 1);
}

TEST_F(WmcTest, JsonHasTheFieldsScriptsRelyOnAndNothingElseIsPrinted)
{
	writeObj(path("a.obj"), makeBumpySphere(800, 1));
	const RunResult e = runWmc({"encode", path("a.obj"), path("a.wmc"), "--json"});
	ASSERT_EQ(e.code, 0) << e.err;
	const auto encoded = e.json();
	expectCommonFields(encoded);
	EXPECT_EQ(encoded["vertices"], 812);
	EXPECT_EQ(encoded["faces"], 1620);
	EXPECT_EQ(encoded["bytes"], readAll(path("a.wmc")).size());
	EXPECT_DOUBLE_EQ(
	    encoded["bits_per_vertex"]["total"].get<double>(),
	    8.0 * encoded["bytes"].get<double>() / 812);
	EXPECT_GT(encoded["encode_seconds"], 0);
	EXPECT_GT(encoded["decode_seconds"], 0);
	std::uint64_t sum = 0;
	for (const auto& level : encoded["levels"])
		sum += level["bytes"].get<std::uint64_t>();
	EXPECT_EQ(sum, encoded["bytes"]);

	const RunResult i = runWmc({"info", path("a.wmc"), "--json"});
	ASSERT_EQ(i.code, 0) << i.err;
	expectCommonFields(i.json());
	EXPECT_EQ(i.json()["levels"], encoded["levels"]);

	const RunResult d = runWmc({"decode", path("a.wmc"), path("b.ply"), "--json"});
	ASSERT_EQ(d.code, 0) << d.err;
	expectCommonFields(d.json());
	EXPECT_EQ(d.json()["truncated"], false);
	EXPECT_EQ(d.json()["written"]["vertices"], 812);
	EXPECT_GT(d.json()["decode_seconds"], 0);
	EXPECT_EQ(e.err + i.err + d.err, "");
}

TEST_F(WmcTest, EveryFormatGivesTheSameFile)
{
	const MeshData mesh = makeBumpySphere(300, 5);
	const auto wmc      = readAll(encoded("a", mesh));
	for (const std::string format : {"ply", "obj", "off"}) {
		tool::saveMesh(mesh, path("copy." + format));
		const RunResult r = runWmc({"encode", path("copy." + format), path("copy.wmc")});
		EXPECT_EQ(r.code, 0) << r.err;
		EXPECT_EQ(readAll(path("copy.wmc")), wmc) << format;
	}
}

TEST_F(WmcTest, StlCornersAtOnePlaceBecomeOneVertex)
{
	const MeshData mesh = makeTorus(12, 9);
	tool::saveMesh(mesh, path("a.stl"));
	const RunResult r = runWmc({"encode", path("a.stl"), path("a.wmc"), "--json"});
	ASSERT_EQ(r.code, 0) << r.err;
	EXPECT_EQ(r.json()["vertices"], mesh.positions.size());
	EXPECT_EQ(runWmc({"verify", path("a.stl"), path("a.wmc")}).code, 0);
}

TEST_F(WmcTest, StlFacetsWithoutAreaStay)
{
	MeshData mesh = makeTorus(12, 9);
	mesh.triangles.push_back({3, 3, 7});
	tool::saveMesh(mesh, path("a.stl"));
	const RunResult r = runWmc({"encode", path("a.stl"), path("a.wmc"), "--json"});
	ASSERT_EQ(r.code, 0) << r.err;
	EXPECT_EQ(r.json()["faces"], mesh.triangles.size());
}

TEST_F(WmcTest, UnknownCommandsAreNamed)
{
	const RunResult r = runWmc({"frob"});
	EXPECT_EQ(r.code, 2);
	EXPECT_NE(r.err.find("'frob'"), std::string::npos) << r.err;
}

TEST_F(WmcTest, ReadsTextStlAndMixedCaseNames)
{
	std::string text    = "solid a\n";
	const MeshData mesh = makeTetrahedron();
	for (const auto& t : mesh.triangles) {
		text += "facet normal 0 0 0\nouter loop\n";
		for (auto v : t) {
			text += "vertex";
			for (double x : mesh.positions[v])
				text += " " + std::to_string(x);
			text += "\n";
		}
		text += "endloop\nendfacet\n";
	}
	writeAll(path("a.STL"), text + "endsolid a\n");
	const RunResult r = runWmc({"encode", path("a.STL"), path("a.wmc"), "--json"});
	ASSERT_EQ(r.code, 0) << r.err;
	EXPECT_EQ(r.json()["vertices"], 4);
}

TEST_F(WmcTest, DecimalsOfTextFilesAreKeptInDouble)
{
	// One part in 2^40 apart: the same float, not the same double.
	MeshData mesh        = makeTetrahedron();
	mesh.positions[0][0] = 1 + 1.0 / (std::uint64_t {1} << 40);
	writeObj(path("a.obj"), mesh);
	tool::saveMesh(tool::loadMesh(path("a.obj")), path("b.ply"));
	for (const std::string format : {"obj", "off", "ply"}) {
		tool::saveMesh(tool::loadMesh(path("b.ply")), path("c." + format));
		EXPECT_EQ(tool::loadMesh(path("c." + format)).positions, mesh.positions) << format;
	}
}

TEST_F(WmcTest, DecodesToTheLevelAskedFor)
{
	const std::string wmc = encoded("a", makeBumpySphere(900, 3));
	const auto levels     = runWmc({"info", wmc, "--json"}).json()["levels"];
	ASSERT_GE(levels.size(), 3u);
	for (std::size_t i = 0; i < levels.size(); ++i) {
		const RunResult r =
		    runWmc({"decode", wmc, path("l.ply"), "--level", std::to_string(i), "--json"});
		ASSERT_EQ(r.code, 0) << r.err;
		EXPECT_EQ(r.json()["level"], i);
		const MeshData mesh = tool::loadMesh(path("l.ply"));
		EXPECT_EQ(mesh.positions.size(), levels[i]["vertices"]);
		EXPECT_EQ(mesh.triangles.size(), levels[i]["faces"]);
		EXPECT_EQ(whatIsNotManifold(mesh), "");
	}
	for (const std::string level : {"-1", "999"}) {
		const RunResult r = runWmc({"decode", wmc, path("l.ply"), "--level", level, "--json"});
		EXPECT_EQ(r.json()["level"], levels.size() - 1);
	}
}

TEST_F(WmcTest, MaxBytesDecodesAsIfTheFileEndedThere)
{
	const std::string wmc = encoded("a", makeBumpySphere(900, 3), {"--mode", "classic"});
	const FileBytes bytes = readAll(wmc);
	const auto levels     = runWmc({"info", wmc, "--json"}).json()["levels"];
	const auto n          = levels[levels.size() - 2]["prefix"].get<std::size_t>();

	const RunResult r =
	    runWmc({"decode", wmc, path("a.ply"), "--max-bytes", std::to_string(n), "--json"});
	EXPECT_EQ(r.code, 0);
	EXPECT_EQ(r.errorLines(), 1u) << r.err;
	EXPECT_NE(r.err.find("warning"), std::string::npos) << r.err;
	EXPECT_EQ(r.json()["truncated"], true);
	EXPECT_EQ(r.json()["level"], levels.size() - 2);

	writeAll(
	    path("cut.wmc"), FileBytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(n)));
	const RunResult cut = runWmc({"decode", path("cut.wmc"), path("b.ply"), "--json"});
	EXPECT_EQ(cut.code, 0);
	EXPECT_EQ(cut.json()["truncated"], true);
	EXPECT_EQ(readAll(path("a.ply")), readAll(path("b.ply")));
}

TEST_F(WmcTest, LimitsRefuseWhatIsLarger)
{
	const std::string wmc = encoded("a", makeTorus(20, 20));
	EXPECT_EQ(runWmc({"decode", wmc, path("a.ply"), "--max-vertices", "399"}).code, 1);
	EXPECT_EQ(runWmc({"decode", wmc, path("a.ply"), "--max-faces", "799"}).code, 1);
	EXPECT_EQ(
	    runWmc({"decode", wmc, path("a.ply"), "--max-vertices", "400", "--max-faces", "800"}).code,
	    0);
}

TEST_F(WmcTest, NegativeLimitsAreRefused)
{
	const std::string wmc = encoded("a", makeOctahedron());
	for (const char* option :
	     {"--max-vertices", "--max-faces", "--max-attribute-values", "--max-level-share",
	      "--max-bytes"}) {
		const RunResult r = runWmc({"decode", wmc, path("b.ply"), option, "-1"});
		EXPECT_EQ(r.code, 2) << option;
		EXPECT_NE(r.err.find("-1 is less than 0"), std::string::npos) << r.err;
	}
	for (const char* samples : {"-1", "-18446744073709551615", "0"})
		EXPECT_EQ(runWmc({"report", path("a.obj"), "--samples", samples}).code, 2) << samples;
}

TEST_F(WmcTest, OptionsReachTheFile)
{
	const MeshData mesh = makeStarPrism(16, 20);
	auto info           = [&](const std::vector<std::string>& options) {
        return runWmc({"info", encoded("a", mesh, options), "--json"}).json();
	};
	EXPECT_EQ(info({"--bits", "9"})["bits"], 9);
	EXPECT_DOUBLE_EQ(info({"--step", "0.125"})["step"].get<double>(), 0.125);
	for (const std::string lifting : {"off", "0", "1", "2"})
		EXPECT_EQ(info({"--mode", "classic", "--lifting", lifting})["lifting"], lifting);
	for (const std::string mode : {"classic", "compact"}) {
		EXPECT_EQ(info({"--mode", mode})["mode"], mode);
		EXPECT_EQ(info({"--mode", mode, "--wgc", "off"})["wgc"], "off");
		EXPECT_EQ(info({"--mode", mode, "--wgc", "on"})["wgc"], "on");
	}
	EXPECT_EQ(info({})["mode"], "compact");
	EXPECT_EQ(info({"--effort", "1"})["mode"], "classic");
}

TEST_F(WmcTest, WgcAutoIsAsSmallAsTheSmallerWhereBothAreTried)
{
	const MeshData mesh                    = makeStarPrism(16, 20);
	const std::vector<std::string> tried[] = {
	    {"--mode", "classic"}, {"--mode", "compact", "--effort", "3"}};
	for (const auto& options : tried) {
		const auto bytes = [&](const std::string& wgc) -> int {
			auto all = options;
			all.insert(all.end(), {"--optimize", "size", "--wgc", wgc});
			return runWmc({"info", encoded("a", mesh, all), "--json"}).json()["bytes"];
		};
		EXPECT_LE(bytes("auto"), std::min(bytes("off"), bytes("on"))) << options[1];
	}
}

TEST_F(WmcTest, EffortAndAimReachTheFile)
{
	const MeshData mesh = makeBumpySphere(900, 1);
	const auto file     = [&](const std::vector<std::string>& options) {
        return readAll(encoded("a", mesh, options));
	};
	EXPECT_LE(
	    file({"--optimize", "size", "--effort", "3"}).size(), file({"--optimize", "size"}).size());
	EXPECT_LT(file({"--effort", "2"}).size(), file({"--effort", "1"}).size());
	EXPECT_EQ(file({"--optimize", "balanced"}), file({}));
	EXPECT_NE(file({"--optimize", "size"}), file({}));
	EXPECT_NE(file({"--optimize", "levels"}), file({"--optimize", "size"}));
}

TEST_F(WmcTest, InfoShowsThePrecisionOfEveryLevel)
{
	const auto j       = runWmc({"info", encoded("a", makeBumpySphere(900, 1)), "--json"}).json();
	const auto& levels = j["levels"];
	int before         = 0;
	for (const auto& level : levels) {
		EXPECT_EQ(level["bits"].get<int>() > before, level["kind"] != "split");
		before = level["bits"].get<int>();
	}
	EXPECT_EQ(before, 12);
}

TEST_F(WmcTest, InfoReadsTheHeadOnly)
{
	const std::string wmc = encoded("a", makeBumpySphere(2000, 3));
	const FileBytes bytes = readAll(wmc);
	ASSERT_GT(bytes.size(), 1500u);
	writeAll(path("head.wmc"), FileBytes(bytes.begin(), bytes.begin() + 1000));
	const RunResult whole = runWmc({"info", wmc, "--json"});
	const RunResult head  = runWmc({"info", path("head.wmc"), "--json"});
	EXPECT_EQ(head.code, 0) << head.err;
	EXPECT_EQ(head.json()["truncated"], true);
	EXPECT_EQ(head.json()["levels"], whole.json()["levels"]);
	EXPECT_EQ(head.errorLines(), 1u);
}

} // namespace wavemesh::test
