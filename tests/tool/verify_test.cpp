// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_edit.h"
#include "mesh_families.h"
#include "mesh_files.h"
#include "run_wmc.h"

#include <limits>

namespace wavemesh::test {

namespace {

class Verify : public WmcTest
{
protected:
	/// Exit code of verifying a.wmc, which is `mesh`, against `other`.
	RunResult against(const MeshData& other)
	{
		writeObj(path("other.obj"), other);
		const RunResult r = runWmc({"verify", path("other.obj"), path("a.wmc"), "--json"});
		EXPECT_EQ(r.errorLines(), r.code == 0 ? 0u : 1u) << r.err;
		EXPECT_EQ(r.json()["ok"], r.code == 0);
		return r;
	}
};

std::string promiseBroken(const RunResult& r)
{
	const auto json = r.json();
	for (const auto& p : json["promises"])
		if (!p["ok"])
			return p["name"];
	return {};
}

} // namespace

TEST_F(Verify, HoldsForEveryKindOfMesh)
{
	for (const NamedMesh& m : allFamilies()) {
		if (m.mesh.positions.size() > 700)
			continue;
		encoded("a", m.mesh);
		const RunResult r = against(m.mesh);
		EXPECT_EQ(r.code, 0) << m.name << ": " << r.err;
	}
}

TEST_F(Verify, HoldsForAFaceAndItsReverse)
{
	MeshData mesh = makeTriangle();
	const auto t  = mesh.triangles[0];
	mesh.triangles.push_back({t[0], t[2], t[1]});
	encoded("a", mesh);
	EXPECT_EQ(against(mesh).code, 0);
}

TEST_F(Verify, HoldsForEveryConfiguration)
{
	const MeshData mesh = punch(makeFlippedSphere(500, 3), 5, 1);
	for (const std::string lifting : {"off", "0", "1", "2"})
		for (const std::string wgc : {"off", "on"})
			for (const std::string bits : {"1", "6", "12", "20", "24"}) {
				encoded(
				    "a", mesh,
				    {"--mode", "classic", "--lifting", lifting, "--wgc", wgc, "--bits", bits});
				const RunResult r = against(mesh);
				EXPECT_EQ(r.code, 0) << lifting << wgc << bits << r.err;
			}
	for (const std::string effort : {"1", "2", "3"})
		for (const std::string optimize : {"size", "balanced", "levels"})
			for (const std::string bits : {"1", "12", "24"}) {
				encoded("a", mesh, {"--effort", effort, "--optimize", optimize, "--bits", bits});
				const RunResult r = against(mesh);
				EXPECT_EQ(r.code, 0) << effort << optimize << bits << r.err;
			}
}

TEST_F(Verify, HoldsInAnyOrderOfVerticesAndFaces)
{
	const MeshData mesh = makeBumpySphere(500, 1);
	encoded("a", mesh);
	EXPECT_EQ(against(shuffled(mesh, 5)).code, 0);
}

TEST_F(Verify, HoldsForVeryManyComponents)
{
	// Places repeat: many components look alike.
	std::vector<MeshData> parts;
	for (int i = 0; i < 12'000; ++i)
		parts.push_back(
		    moved(i % 3 > 0 ? makeTriangle() : makeTetrahedron(), i % 20, i / 20 % 20, i % 7));
	const MeshData mesh = joined(parts);
	encoded("a", mesh);
	const RunResult r = against(shuffled(mesh, 3));
	EXPECT_EQ(r.code, 0) << r.err;
	MeshData other = mesh;
	std::swap(other.triangles[9'000][0], other.triangles[9'000][1]);
	EXPECT_EQ(against(other).code, 1);
}

TEST_F(Verify, HoldsForCoordinatesThatAreNoNumbers)
{
	MeshData mesh         = makeBumpySphere(100, 1);
	mesh.positions[5][1]  = std::numeric_limits<double>::quiet_NaN();
	mesh.positions[20][0] = std::numeric_limits<double>::infinity();
	mesh.positions[40][2] = -0.0;
	tool::saveMesh(mesh, path("a.ply"));
	ASSERT_EQ(runWmc({"encode", path("a.ply"), path("a.wmc"), "--exact"}).code, 0);
	const RunResult r = runWmc({"verify", path("a.ply"), path("a.wmc")});
	EXPECT_EQ(r.code, 0) << r.err;
}

TEST_F(Verify, FailsForOneMovedVertex)
{
	MeshData mesh = makeBumpySphere(500, 1);
	encoded("a", mesh);
	mesh.positions[77][1] += 0.01;
	const RunResult r = against(mesh);
	EXPECT_EQ(r.code, 1);
	EXPECT_EQ(promiseBroken(r), "lattice-lossless");
}

TEST_F(Verify, FailsForTwoVerticesThatChangedPlaces)
{
	MeshData mesh = makeBumpySphere(500, 1);
	encoded("a", mesh);
	std::swap(mesh.positions[10], mesh.positions[200]);
	EXPECT_EQ(against(mesh).code, 1);
}

TEST_F(Verify, FailsForOneTurnedFace)
{
	MeshData mesh = makeBumpySphere(500, 1);
	encoded("a", mesh);
	std::swap(mesh.triangles[50][0], mesh.triangles[50][1]);
	EXPECT_EQ(against(mesh).code, 1);
}

TEST_F(Verify, FailsForTheMeshInsideOut)
{
	MeshData mesh = makeBumpySphere(500, 1);
	encoded("a", mesh);
	for (auto& t : mesh.triangles)
		std::swap(t[0], t[1]);
	EXPECT_EQ(against(mesh).code, 1);
}

TEST_F(Verify, FailsForOneFlippedEdge)
{
	const MeshData mesh = makeBumpySphere(500, 1);
	encoded("a", mesh);
	MeshEdit edit(mesh);
	std::uint32_t h = 300;
	while (!edit.flip(h))
		++h;
	EXPECT_EQ(against(edit.result()).code, 1);
}

TEST_F(Verify, FailsForOneFaceMore)
{
	const MeshData mesh = makeBumpySphere(500, 1);
	encoded("a", punch(mesh, 1, 1));
	EXPECT_EQ(against(mesh).code, 1);
}

TEST_F(Verify, FailsForACutFile)
{
	const MeshData mesh = makeBumpySphere(500, 1);
	FileBytes wmc       = readAll(encoded("a", mesh));
	wmc.pop_back();
	writeAll(path("a.wmc"), wmc);
	const RunResult r = runWmc({"verify", path("a.obj"), path("a.wmc")});
	EXPECT_EQ(r.code, 1);
	EXPECT_EQ(r.errorLines(), 1u);
}

TEST_F(Verify, NamesAttributesOfTheOriginalThatAreNotInTheFile)
{
	writeAll(
	    path("a.ply"), "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
	                   "property float y\nproperty float z\nproperty float quality\n"
	                   "property float heat\nelement face 1\n"
	                   "property list uchar int vertex_indices\nend_header\n"
	                   "0 0 0 1 2\n1 0 0 3 4\n0 1 0 5 6\n3 0 1 2\n");
	ASSERT_EQ(runWmc({"encode", path("a.ply"), path("a.wmc"), "--attributes", "quality"}).code, 0);
	const RunResult r = runWmc({"verify", path("a.ply"), path("a.wmc"), "--json"});
	EXPECT_EQ(r.code, 0) << r.err;
	EXPECT_EQ(r.json()["not_in_file"], nlohmann::json {"vertex custom 'heat'"});
	EXPECT_NE(
	    runWmc({"verify", path("a.ply"), path("a.wmc")}).out.find("absent  vertex custom 'heat'"),
	    std::string::npos);
	ASSERT_EQ(runWmc({"encode", path("a.ply"), path("a.wmc")}).code, 0);
	EXPECT_TRUE(
	    runWmc({"verify", path("a.ply"), path("a.wmc"), "--json"}).json()["not_in_file"].empty());
}

TEST_F(Verify, FailsForBytesAfterTheEnd)
{
	FileBytes wmc = readAll(encoded("a", makeBumpySphere(500, 1)));
	wmc.push_back(0);
	writeAll(path("a.wmc"), wmc);
	EXPECT_EQ(runWmc({"verify", path("a.obj"), path("a.wmc")}).code, 1);
}

} // namespace wavemesh::test
