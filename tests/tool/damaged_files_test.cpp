// SPDX-License-Identifier: GPL-3.0-or-later
// .wmc files that are not what they should be.
#include "mesh_families.h"
#include "run_wmc.h"

namespace wavemesh::test {

namespace {

void expectRefused(const RunResult& r, const std::string& what)
{
	EXPECT_EQ(r.code, 1) << what;
	EXPECT_EQ(r.errorLines(), 1u) << what << ": " << r.err;
	EXPECT_EQ(r.err.rfind("wmc: ", 0), 0u) << r.err;
	EXPECT_EQ(r.out, "") << what;
}

} // namespace

TEST_F(WmcTest, MissingEmptyAndForeignFilesAreRefused)
{
	writeAll(path("empty.wmc"), std::string());
	writeAll(path("text.wmc"), std::string("solid teapot\nendsolid\n"));
	writeAll(path("zero.wmc"), FileBytes(5000, 0));
	writeObj(path("a.obj"), makeTorus(8, 8));
	for (const std::string name : {"none.wmc", "empty.wmc", "text.wmc", "zero.wmc", "a.obj"}) {
		expectRefused(runWmc({"info", path(name)}), "info " + name);
		expectRefused(runWmc({"info", path(name), "--json"}), "info --json " + name);
		expectRefused(runWmc({"decode", path(name), path("out.ply")}), "decode " + name);
		expectRefused(runWmc({"verify", path("a.obj"), path(name)}), "verify " + name);
	}
}

TEST_F(WmcTest, AFileCutBeforeTheBaseMeshIsRefused)
{
	const std::string wmc = encoded("a", makeBumpySphere(500, 1));
	for (const std::string n : {"0", "1", "7", "8", "20"})
		expectRefused(runWmc({"decode", wmc, path("out.ply"), "--max-bytes", n}), n);
	EXPECT_EQ(files(), (std::vector<std::string> {"a.obj", "a.wmc"}));
}

TEST_F(WmcTest, NoChangedByteGivesAMeshSilently)
{
	const std::string wmc = encoded("a", makeBumpySphere(120, 1));
	const FileBytes bytes = readAll(wmc);
	for (std::size_t i = 0; i < bytes.size(); i += 1 + bytes.size() / 60) {
		FileBytes changed = bytes;
		changed[i] ^= 0x10;
		writeAll(path("b.wmc"), changed);
		const RunResult r = runWmc({"decode", path("b.wmc"), path("out.ply")});
		EXPECT_EQ(r.errorLines(), 1u) << "byte " << i << ": " << r.err;
		// A damaged length may look like a file cut off; then it is said so.
		if (r.code == 0)
			EXPECT_NE(r.err.find("warning"), std::string::npos) << "byte " << i;
		else
			expectRefused(r, "byte " + std::to_string(i));
		expectRefused({runWmc({"verify", path("a.obj"), path("b.wmc")}).code, "", r.err}, "verify");
	}
}

TEST_F(WmcTest, PointCloudsComeBack)
{
	MeshData points = makeTwoTriangles();
	points.triangles.clear();
	writeObj(path("points.obj"), points);
	EXPECT_EQ(runWmc({"encode", path("points.obj"), path("points.wmc"), "--exact"}).code, 0);
	EXPECT_EQ(runWmc({"verify", path("points.obj"), path("points.wmc")}).code, 0);
	EXPECT_EQ(runWmc({"decode", path("points.wmc"), path("back.ply")}).code, 0);
	expectRefused(runWmc({"report", path("points.obj")}), "no distance to points");
}

TEST_F(WmcTest, VerifyChecksOrderAndExactNumbersWhereTheyArePromised)
{
	const MeshData mesh = makeBumpySphere(60, 3);
	writeObj(path("a.obj"), mesh);
	const std::string wmc = path("a.wmc");
	ASSERT_EQ(runWmc({"encode", path("a.obj"), wmc, "--keep-order", "--exact"}).code, 0);
	const RunResult good = runWmc({"verify", path("a.obj"), wmc});
	EXPECT_EQ(good.code, 0) << good.err;
	EXPECT_NE(good.out.find("float-lossless"), std::string::npos);
	EXPECT_NE(good.out.find("order-preserving"), std::string::npos);
	writeObj(path("b.obj"), shuffled(mesh, 4));
	EXPECT_EQ(runWmc({"verify", path("b.obj"), wmc}).code, 1) << "another order";
	MeshData moved = mesh;
	moved.positions[7][1] += 1e-9;
	writeObj(path("c.obj"), moved);
	EXPECT_EQ(runWmc({"verify", path("c.obj"), wmc}).code, 1) << "another number";
}

TEST_F(WmcTest, MeshesThatAreNoManifoldComeBack)
{
	const MeshData two = makeTwoTriangles();
	MeshData bad       = two;
	bad.triangles[1]   = {two.triangles[1][0], two.triangles[1][2], two.triangles[1][1]};
	writeObj(path("orientation.obj"), bad);
	bad = two;
	bad.positions.push_back({9, 9, 9});
	writeObj(path("isolated.obj"), bad);
	bad = two;
	bad.triangles.push_back(two.triangles[0]);
	writeObj(path("duplicate.obj"), bad);
	bad = two;
	bad.positions.push_back({0.5, 0.5, 3});
	bad.triangles.push_back({two.triangles[0][0], two.triangles[0][1], 4});
	bad.triangles.push_back({two.triangles[0][1], two.triangles[0][2], 4});
	bad.triangles.push_back({two.triangles[0][2], two.triangles[0][0], 4});
	writeObj(path("nonmanifold.obj"), bad);
	for (const std::string name : {"orientation", "isolated", "duplicate", "nonmanifold"}) {
		EXPECT_EQ(runWmc({"encode", path(name + ".obj"), path("out.wmc")}).code, 0) << name;
		const RunResult r = runWmc({"verify", path(name + ".obj"), path("out.wmc")});
		EXPECT_EQ(r.code, 0) << name << r.err;
		EXPECT_EQ(runWmc({"bench", path(name + ".obj")}).code, 0) << name;
		EXPECT_EQ(runWmc({"report", path(name + ".obj")}).code, 0) << name;
	}
}

} // namespace wavemesh::test
