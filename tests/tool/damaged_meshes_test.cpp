// SPDX-License-Identifier: GPL-3.0-or-later
// Mesh files that are not what they should be: refused in one line, never a crash or a hang.
#include "mesh_families.h"
#include "mesh_files.h"
#include "rng.h"
#include "run_wmc.h"

namespace wavemesh::test {

TEST_F(WmcTest, DamagedMeshFilesAreRefusedInOneLine)
{
	const std::string plyHead = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
	                            "property float y\nproperty float z\nelement face 1\n"
	                            "property list uchar int vertex_indices\nend_header\n";
	const std::string points  = "0 0 0\n1 0 0\n0 1 0\n";
	const std::vector<std::pair<std::string, std::string>> bad = {
	    {"empty.ply", ""},
	    {"empty.obj", ""},
	    {"empty.off", ""},
	    {"empty.stl", ""},
	    {"foreign.ply", "this is no mesh"},
	    {"foreign.obj", "this is no mesh"},
	    {"foreign.off", "this is no mesh"},
	    {"foreign.stl", "this is no mesh"},
	    {"unknown.xyz", "0 0 0\n"},
	    {"noformat", "0 0 0\n"},
	    {"index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"},
	    {"zero.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n"},
	    {"negative.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n"},
	    {"twice.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 2\n"},
	    {"two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n"},
	    {"indented.obj", "v 0 0 0\n v 1 0 0\n v 0 1 0\nf 1 2 3\n"},
	    {"joined.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 \\\n"},
	    {"hidden.obj", "v 0 0 0\nv 1 0 0\n# \\\nv 0 1 0\nf 1 2 3\n"},
	    {"coordinate.obj", "v 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
	    {"nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
	    {"index.off", "OFF\n3 1 0\n" + points + "3 0 1 3\n"},
	    {"short.off", "OFF\n3 1 0\n" + points},
	    {"huge.off", "OFF\n2000000000 1 0\n" + points},
	    {"pentagon.off", "OFF\n5 1 0\n" + points + "1 1 0\n2 1 0\n5 0 1 2 3 4\n"},
	    {"index.ply", plyHead + points + "3 0 1 7\n"},
	    {"short.ply", plyHead + points},
	    {"corners.ply", plyHead + points + "2 0 1\n"},
	    {"head.ply", "ply\nformat ascii 1.0\nelement vertex three\n"},
	    {"endless.ply", "ply\nformat ascii 1.0\n"},
	    {"line.stl", "solid without an end"},
	    {"half.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendsolid\n"},
	};
	for (const auto& [name, text] : bad) {
		writeAll(path(name), text);
		const RunResult r = runWmc({"encode", path(name), path("out.wmc")});
		EXPECT_EQ(r.code, 1) << name << ": " << r.err;
		EXPECT_EQ(r.errorLines(), 1u) << name << ": " << r.err;
		EXPECT_NE(r.err.find(name), std::string::npos) << r.err;
	}
}

TEST_F(WmcTest, ACoordinateThatIsNotFiniteIsRefusedWithTheOptionThatKeepsIt)
{
	writeAll(
	    path("a.ply"),
	    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
	    "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
	    "end_header\n0 0 0\n1 inf 0\n0 1 0\n3 0 1 2\n");
	const RunResult refused = runWmc({"encode", path("a.ply"), path("a.wmc")});
	EXPECT_EQ(refused.code, 1);
	EXPECT_NE(refused.err.find("vertex 1 has a coordinate that is not finite"), std::string::npos)
	    << refused.err;
	EXPECT_NE(refused.err.find("--exact"), std::string::npos) << refused.err;
	EXPECT_EQ(runWmc({"encode", path("a.ply"), path("a.wmc"), "--exact"}).code, 0);
}

TEST_F(WmcTest, BinaryPlyAndStlCutAnywhereAreRefused)
{
	for (const std::string format : {"ply", "stl"}) {
		tool::saveMesh(makeTetrahedron(), path("a." + format));
		const FileBytes bytes = readAll(path("a." + format));
		for (std::size_t n = 0; n < bytes.size(); n += 7) {
			writeAll(
			    path("b." + format), FileBytes(bytes.begin(), bytes.begin() + std::ptrdiff_t(n)));
			const RunResult r = runWmc({"encode", path("b." + format), path("out.wmc")});
			EXPECT_EQ(r.code, 1) << format << " cut after " << n;
			EXPECT_EQ(r.errorLines(), 1u) << r.err;
		}
	}
}

TEST_F(WmcTest, RandomDamageNeverCrashesAReader)
{
	Rng rng(7);
	for (const std::string format : {"ply", "obj", "off", "stl"}) {
		tool::saveMesh(makeOctahedron(), path("a." + format));
		const FileBytes bytes = readAll(path("a." + format));
		for (int round = 0; round < 60; ++round) {
			FileBytes changed = bytes;
			for (std::uint32_t k = 0; k <= rng.below(3); ++k)
				changed[rng.below(std::uint32_t(changed.size()))] = std::uint8_t(rng.next());
			writeAll(path("b." + format), changed);
			const RunResult r = runWmc({"encode", path("b." + format), path("out.wmc")});
			EXPECT_TRUE(r.code == 0 || r.code == 1)
			    << format << " round " << round << ": " << r.err;
			const bool warns = r.code == 0 && r.err.find("not kept: ") != std::string::npos;
			EXPECT_EQ(r.errorLines(), r.code == 0 && !warns ? 0u : 1u) << r.err;
		}
	}
}

TEST_F(WmcTest, QuadsAreCutIntoTriangles)
{
	const std::string points = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
	writeAll(path("a.off"), "OFF\n4 1 0\n" + points + "4 0 1 2 3\n");
	writeAll(path("a.obj"), std::string("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"));
	for (const std::string name : {"a.off", "a.obj"}) {
		const RunResult r = runWmc({"encode", path(name), path("out.wmc"), "--json"});
		ASSERT_EQ(r.code, 0) << r.err;
		EXPECT_EQ(r.json()["faces"], 2);
	}
}

} // namespace wavemesh::test
