// SPDX-License-Identifier: GPL-3.0-or-later
// Mesh files that are not what they should be: refused in one line, never a crash or a hang.
#include "mesh_families.h"
#include "mesh_files.h"
#include "rng.h"
#include "run_wmc.h"

#include <wavemesh/vcg_attributes.h>

#include <cmath>
#include <cstdlib>

namespace wavemesh::test {

TEST_F(WmcTest, DamagedMeshFilesAreRefusedInOneLine)
{
	const std::string plyHead = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
	                            "property float y\nproperty float z\nelement face 1\n"
	                            "property list uchar int vertex_indices\nend_header\n";
	const auto withElement    = [&](const std::string& element, const std::string& list) {
        std::string head = plyHead;
        head.replace(head.find("face 1"), 6, element);
        head.replace(head.find("uchar int"), 9, list);
        head.replace(head.find("element"), 0, "comment num_cols 2\ncomment num_rows 2\n");
        return head;
	};
	const std::string points                                   = "0 0 0\n1 0 0\n0 1 0\n";
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
	    {"texture.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/2 3/1\n"},
	    {"texture2.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/0 3/1\n"},
	    {"normal.obj",
	     "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\nf 1//1 2//2 3//4\n"},
	    {"hidden.obj", "v 0 0 0\nv 1 0 0\n# \\\nv 0 1 0\nf 1 2 3\n"},
	    {"coordinate.obj", "v 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
	    {"nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
	    {"index.off", "OFF\n3 1 0\n" + points + "3 0 1 3\n"},
	    {"short.off", "OFF\n3 1 0\n" + points},
	    {"huge.off", "OFF\n2000000000 1 0\n" + points},
	    {"wrapping.off", "OFF\n6148914691236517206 1 0\n" + points},
	    {"palette.off", "OFF\n3 1 0\n" + points + "3 0 1 2 148\n"},
	    {"palette2.off", "COFF\n3 0 0\n0 0 0 -1\n1 0 0\n0 1 0\n"},
	    {"polygon.off", "OFF\n3 1 0\n" + points + "5 0 1 2 0 3\n"},
	    {"normal.off", "NOFF\n3 1 0\n" + points + "3 0 1 2\n"},
	    {"index.ply", plyHead + points + "3 0 1 7\n"},
	    {"short.ply", plyHead + points},
	    {"corners.ply", plyHead + points + "2 0 1\n"},
	    {"count.ply", plyHead + points + "nan 0 1 2\n"},
	    {"count2.ply", plyHead + points + "1e300 0 1 2\n"},
	    {"count3.ply", plyHead + points + "-1 0 1 2\n"},
	    {"fraction.ply", plyHead + points + "3 0 1 1.5\n"},
	    {"strip.ply", withElement("tristrips 1", "int int") + points + "4 0 1 2 3\n"},
	    {"strip2.ply", withElement("tristrips 1", "int int") + points + "5 0 -1 1 2 0\n"},
	    {"grid.ply", withElement("range_grid 4", "uchar int") + points + "1 0\n1 1\n1 2\n1 3\n"},
	    {"twice.ply", withElement("vertex 1", "int int") + points + "3 0 1 2\n"},
	    {"format.ply", "ply\nformat binary 1.0\nelement vertex 0\nproperty float x\n"
	                   "property float y\nproperty float z\nend_header\n"},
	    {"nowhere.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
	                    "end_header\n0\n"},
	    {"head.ply", "ply\nformat ascii 1.0\nelement vertex three\n"},
	    {"endless.ply", "ply\nformat ascii 1.0\n"},
	    {"line.stl", "solid without an end"},
	    {"two.stl",
	     "solid a\nfacet normal 0 0 1\nvertex 0 0 0\nvertex 1 0 0\nendfacet\nendsolid\n"},
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

TEST_F(WmcTest, AReportOfCoordinatesThatAreNotFiniteIsRefused)
{
	writeAll(path("a.obj"), std::string("v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n"));
	for (const char* option : {"--json", "--exact"}) {
		const RunResult r = runWmc({"report", path("a.obj"), option});
		EXPECT_EQ(r.code, 1);
		EXPECT_EQ(r.out, "");
		EXPECT_NE(r.err.find("vertex 1 has a coordinate that is not finite"), std::string::npos)
		    << r.err;
	}
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

TEST_F(WmcTest, PolygonsOfManyCornersAreCutIntoTrianglesWithTheirTexture)
{
	constexpr int kCorners = 1000;
	std::string places, indices, textured;
	for (int i = 0; i < kCorners; ++i) {
		const double u = std::cos(2 * M_PI * i / kCorners), v = std::sin(2 * M_PI * i / kCorners);
		places += std::to_string(u) + " " + std::to_string(v) + " 0\n";
		indices += " " + std::to_string(i);
		textured += " " + std::to_string(u) + " " + std::to_string(v);
	}
	const std::string n = std::to_string(kCorners);
	writeAll(path("a.off"), "OFF\n" + n + " 1 0\n" + places + n + indices + "\n");
	writeAll(
	    path("a.ply"), "ply\nformat ascii 1.0\nelement vertex " + n +
	                       "\nproperty float x\nproperty float y\nproperty float z\n"
	                       "element face 1\nproperty list ushort int vertex_indices\n"
	                       "property list ushort float texcoord\nend_header\n" +
	                       places + n + indices + " " + std::to_string(2 * kCorners) + textured +
	                       "\n");
	for (const std::string name : {"a.off", "a.ply"}) {
		ASSERT_EQ(runWmc({"encode", path(name), path("a.wmc")}).code, 0) << name;
		EXPECT_EQ(runWmc({"verify", path(name), path("a.wmc")}).code, 0) << name;
		ASSERT_EQ(runWmc({"decode", path("a.wmc"), path("b.off")}).code, 0);
		const FileBytes off = readAll(path("b.off"));
		EXPECT_EQ(std::string(off.begin(), off.end()).find("OFF\n" + n + " 1 0\n"), 0u) << name;
	}
	const MeshData mesh = tool::loadMesh(path("a.ply"), kWedgeTexCoord);
	ASSERT_EQ(mesh.triangles.size(), kCorners - 2u);
	ASSERT_EQ(mesh.attributes.size(), 1u);
	for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k)
			EXPECT_EQ(
			    mesh.attributes[0].values[9 * f + 3 * k], mesh.positions[mesh.triangles[f][k]][0]);
}

TEST_F(WmcTest, AnOddPlyIsReadWhateverLiesInTheTemporaryFolder)
{
	// The temporary folder itself is of no interest to a reader.
	writeAll(
	    path("a.ply"), "ply\nformat ascii 1.0\nelement vertex 3\nproperty short x\n"
	                   "property int y\nproperty double z\nproperty short quality\n"
	                   "element face 1\nproperty list int short vertex_index\nend_header\n"
	                   "0 0 0.1 5\n100 0 0 6\n0 100 0 -7\n3 0 1 2\n");
	ASSERT_EQ(::setenv("TMPDIR", path("nowhere").c_str(), 1), 0);
	const RunResult r = runWmc({"encode", path("a.ply"), path("a.wmc"), "--exact", "--json"});
	::unsetenv("TMPDIR");
	ASSERT_EQ(r.code, 0) << r.err;
	const MeshData mesh = tool::loadMesh(path("a.ply"), kVertexQuality);
	EXPECT_EQ(mesh.positions[0][2], 0.1);
	ASSERT_EQ(mesh.attributes.size(), 1u);
	EXPECT_EQ(mesh.attributes[0].kind, AttributeKind::Quality);
	EXPECT_EQ(mesh.attributes[0].values, (std::vector<double> {5, 6, -7}));
}

} // namespace wavemesh::test
