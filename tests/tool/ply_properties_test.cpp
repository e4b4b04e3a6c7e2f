// SPDX-License-Identifier: GPL-3.0-or-later
// Properties of a PLY that are its own: into .wmc and back.
#include "mesh_families.h"
#include "mesh_files.h"
#include "ply_reader.h"
#include "run_wmc.h"

#include <wavemesh/vcg_attributes.h>

#include <cmath>
#include <map>

namespace wavemesh::test {

namespace {

class PlyProperties : public WmcTest
{
protected:
	void write(const std::string& name, const std::string& text)
	{
		writeAll(path(name), FileBytes(text.begin(), text.end()));
	}
	/// Encodes, verifies, decodes to b.ply and reads that.
	MeshData throughWmc(const std::string& name, std::vector<std::string> options = {})
	{
		options.insert(options.begin(), {"encode", path(name), path("a.wmc")});
		const RunResult encoded = runWmc(options);
		EXPECT_EQ(encoded.code, 0) << encoded.err;
		whenEncoded_             = encoded.err;
		const RunResult verified = runWmc({"verify", path(name), path("a.wmc")});
		EXPECT_EQ(verified.code, 0) << verified.err;
		const RunResult decoded = runWmc({"decode", path("a.wmc"), path("b.ply")});
		EXPECT_EQ(decoded.code, 0) << decoded.err;
		whenDecoded_ = decoded.err;
		return tool::loadMesh(path("b.ply"), kAllChannels);
	}

	std::string whenEncoded_, whenDecoded_;
};

std::map<std::string, Attribute> byName(const MeshData& mesh)
{
	std::map<std::string, Attribute> out;
	for (const Attribute& a : mesh.attributes)
		out[(a.of == AttributeOf::Face ? "face " : "vertex ") + a.name] = a;
	return out;
}

const std::string kTwoTriangles = "ply\nformat ascii 1.0\nelement vertex 4\n"
                                  "property float x\nproperty float y\nproperty float z\n"
                                  "property double heat\nproperty int label\n"
                                  "property float weight\nproperty list uchar float pull\n"
                                  "element face 2\nproperty list uchar int vertex_indices\n"
                                  "property uchar part\nproperty float age\nend_header\n"
                                  "0 0 0 0.1 -7 0.1 3 1 2 3\n1 0 0 1e300 2000000000 nan 3 0.1 0 0\n"
                                  "0 1 0 -0 3 inf 3 0 0 -1\n1 1 0.5 4 4 -2.5 3 7 8 9\n"
                                  "3 0 1 2 200 0.3\n3 2 1 3 17 -1\n";

} // namespace

TEST_F(PlyProperties, OfVerticesAndFacesComeBackBitForBit)
{
	write("a.ply", kTwoTriangles);
	const MeshData back = throughWmc("a.ply", {"--keep-order"});
	EXPECT_EQ(whenEncoded_, "");
	EXPECT_EQ(whenDecoded_, "");
	auto of = byName(back);
	ASSERT_EQ(of.size(), 6u);
	EXPECT_EQ(of["vertex heat"].values, (std::vector<double> {0.1, 1e300, -0.0, 4}));
	EXPECT_TRUE(std::signbit(of["vertex heat"].values[2]));
	EXPECT_EQ(of["vertex label"].values, (std::vector<double> {-7, 2000000000, 3, 4}));
	EXPECT_EQ(of["vertex label"].type, NumberType::Integer);
	EXPECT_EQ(of["vertex weight"].values[0], double(0.1f));
	EXPECT_TRUE(std::isnan(of["vertex weight"].values[1]));
	EXPECT_TRUE(std::isinf(of["vertex weight"].values[2]));
	EXPECT_EQ(
	    of["vertex pull"].values,
	    (std::vector<double> {1, 2, 3, double(0.1f), 0, 0, 0, 0, -1, 7, 8, 9}));
	EXPECT_EQ(of["face part"].values, (std::vector<double> {200, 17}));
	EXPECT_EQ(of["face age"].values, (std::vector<double> {double(0.3f), -1}));
}

TEST_F(PlyProperties, AreLeftOutOrRoundedWhenAsked)
{
	write("a.ply", kTwoTriangles);
	ASSERT_EQ(runWmc({"encode", path("a.ply"), path("a.wmc"), "--attributes", "colour"}).code, 0);
	EXPECT_TRUE(tool::loadMesh(path("a.ply"), kVertexColour).attributes.empty());
	EXPECT_TRUE(runWmc({"info", path("a.wmc"), "--json"}).json()["attributes"].empty());
	ASSERT_EQ(
	    runWmc({"encode", path("a.ply"), path("a.wmc"), "--attribute-bits", "custom=8"}).code, 0);
	EXPECT_EQ(runWmc({"verify", path("a.ply"), path("a.wmc")}).code, 0);
}

TEST_F(PlyProperties, OfAPolygonAreThoseOfItsTriangles)
{
	write(
	    "a.ply", "ply\nformat ascii 1.0\nelement vertex 6\n"
	             "property float x\nproperty float y\nproperty float z\n"
	             "element face 2\nproperty float before\nproperty list uchar int vertex_indices\n"
	             "property float after\nproperty uchar red\nproperty uchar green\n"
	             "property uchar blue\nproperty uchar alpha\nend_header\n"
	             "0 0 0\n1 0 0\n2 1 0\n1 2 0\n0 1 0\n3 0 0\n"
	             "0.5 5 0 1 2 3 4 1.5 1 2 3 4\n0.25 3 1 5 2 1.25 5 6 7 8\n");
	auto of = byName(throughWmc("a.ply", {"--keep-order"}));
	EXPECT_EQ(of["face before"].values, (std::vector<double> {0.5, 0.5, 0.5, 0.25}));
	EXPECT_EQ(of["face after"].values, (std::vector<double> {1.5, 1.5, 1.5, 1.25}));
	EXPECT_EQ(
	    of["face "].values, (std::vector<double> {1, 2, 3, 4, 1, 2, 3, 4, 1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST_F(PlyProperties, ThatAreAPartOfAColourOrANormalAreKeptAsNumbersOfTheirOwn)
{
	write(
	    "a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"
	             "property float x\nproperty float y\nproperty float z\nproperty float nx\n"
	             "property uchar red\nproperty uchar green\nproperty float s\n"
	             "element face 1\nproperty list uchar int vertex_indices\n"
	             "property uchar red\nproperty uchar green\nproperty uchar blue\n"
	             "property uchar alpha\nproperty int texnumber\nend_header\n"
	             "0 0 0 0.5 1 2 7\n1 0 0 1.5 3 4 8\n0 1 0 2.5 5 6 9\n3 0 1 2 9 8 7 6 5\n");
	const MeshData back = throughWmc("a.ply", {"--keep-order", "--attributes", "all"});
	EXPECT_EQ(whenEncoded_ + whenDecoded_, "");
	auto of = byName(back);
	EXPECT_EQ(of.size(), 6u);
	EXPECT_EQ(of["vertex nx"].values, (std::vector<double> {0.5, 1.5, 2.5}));
	EXPECT_EQ(of["vertex red"].values, (std::vector<double> {1, 3, 5}));
	EXPECT_EQ(of["vertex green"].values, (std::vector<double> {2, 4, 6}));
	EXPECT_EQ(of["vertex s"].values, (std::vector<double> {7, 8, 9}));
	EXPECT_EQ(of["face texnumber"].values, (std::vector<double> {5}));
	EXPECT_EQ(of["face "].values, (std::vector<double> {9, 8, 7, 6})); // a whole colour
	// No colour is made up where other numbers are not wanted.
	EXPECT_TRUE(tool::loadMesh(path("a.ply"), kVertexColour).attributes.empty());
}

TEST_F(PlyProperties, ThatCannotBeKeptAreNamed)
{
	write(
	    "a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"
	             "property float x\nproperty float y\nproperty float z\n"
	             "property list uchar int neighbours\n"
	             "element face 1\nproperty list uchar int vertex_indices\n"
	             "element spring 1\nproperty int from\nproperty int to\nend_header\n"
	             "0 0 0 2 1 2\n1 0 0 1 0\n0 1 0 3 1 2 0\n3 0 1 2\n1 2\n");
	EXPECT_TRUE(throughWmc("a.ply").attributes.empty());
	EXPECT_NE(
	    whenEncoded_.find("not kept: vertex list 'neighbours', element 'spring'"),
	    std::string::npos)
	    << whenEncoded_;
	EXPECT_EQ(runWmc({"encode", path("a.ply"), path("b.wmc"), "--attributes", "none"}).err, "");
}

TEST_F(PlyProperties, WithNamesOfAnyBytesAreNoTroubleForJsonAndTerminals)
{
	std::string text = kTwoTriangles;
	text.replace(text.find("heat"), 4, "h\xff\x1b[31m");
	write("a.ply", text);
	(void)throughWmc("a.ply");
	EXPECT_EQ(whenDecoded_.find('\x1b'), std::string::npos);
	EXPECT_EQ(runWmc({"info", path("a.wmc")}).out.find('\x1b'), std::string::npos);
	EXPECT_EQ(runWmc({"info", path("a.wmc"), "--json"}).json()["attributes"].size(), 6u);
}

TEST_F(PlyProperties, WithNamesThatOthersHaveAreNotWritten)
{
	MeshData mesh = makeTetrahedron();
	Attribute a;
	a.kind   = AttributeKind::Custom;
	a.values = {1, 2, 3, 4};
	for (const std::string name : {"quality", "two words", "", "fine", "fine"}) {
		a.name = name;
		mesh.attributes.push_back(a);
	}
	EXPECT_EQ(
	    tool::saveMesh(mesh, path("a.ply")),
	    (std::vector<std::string> {
	        "vertex custom 'quality'", "vertex custom 'two words'", "vertex custom",
	        "vertex custom 'fine'"}));
	const auto back = tool::loadMesh(path("a.ply"), kAllChannels).attributes;
	ASSERT_EQ(back.size(), 1u);
	EXPECT_EQ(back[0].name, "fine");
	EXPECT_EQ(back[0].values, a.values);
	EXPECT_EQ(tool::saveMesh(mesh, path("a.obj")).size(), 5u);
}

TEST(PlyReader, OfAHeadWithoutALastNewlineStaysInTheFile)
{
	const std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex 1\n"
	                         "property float x\nend_header";
	const tool::Bytes file(text.begin(), text.end());
	tool::ply::Head head;
	ASSERT_EQ(tool::ply::parseHead(file, head), "");
	EXPECT_EQ(head.size, file.size());
}

} // namespace wavemesh::test
