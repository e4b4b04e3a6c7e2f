// SPDX-License-Identifier: GPL-3.0-or-later
// Properties of a PLY that are its own: into .wmc and back.
#include "mesh_families.h"
#include "mesh_files.h"
#include "ply_reader.h"
#include "run_wmc.h"

#include <wavemesh/vcg_attributes.h>

#include <cmath>
#include <map>
#include <sstream>

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

/// Three vertices, one face, with properties of the vertices.
std::string triangleWith(const std::string& properties, const std::string& values)
{
	std::istringstream lines(values);
	std::string text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
	                   "property float y\nproperty float z\n" +
	                   properties +
	                   "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
	for (const char* place : {"0 0 0 ", "1 0 0 ", "0 1 0 "}) {
		std::string line;
		std::getline(lines, line);
		text += place + line + "\n";
	}
	return text + "3 0 1 2\n";
}

TEST_F(PlyProperties, RadiusAndConfidenceAreRightInWhateverTheyAreWritten)
{
	for (const char* type : {"float", "double"})
		for (const std::string name : {"radius", "confidence", "quality"}) {
			SCOPED_TRACE(type + (" " + name));
			write(
			    "a.ply", triangleWith("property " + (type + (" " + name)) + "\n", "0.5\n0.25\n1"));
			const MeshData back = throughWmc("a.ply", {"--exact", "--keep-order"});
			ASSERT_EQ(back.attributes.size(), 1u);
			EXPECT_EQ(back.attributes[0].values, (std::vector<double> {0.5, 0.25, 1}));
			EXPECT_EQ(runWmc({"verify", path("b.ply"), path("a.wmc")}).code, 0);
		}
	for (const char* both :
	     {"property float confidence\nproperty float quality\n",
	      "property float quality\nproperty float confidence\n"}) {
		write("a.ply", triangleWith(both, "0.5 2\n0.25 4\n1 8"));
		auto of = byName(throughWmc("a.ply", {"--exact", "--keep-order"}));
		ASSERT_EQ(of.size(), 2u);
		const bool isFirst = both[15] == 'c'; // the confidence
		EXPECT_EQ(
		    of["vertex confidence"].values,
		    isFirst ? (std::vector<double> {0.5, 0.25, 1}) : (std::vector<double> {2, 4, 8}));
		EXPECT_EQ(of["vertex "].kind, AttributeKind::Quality);
		EXPECT_EQ(
		    of["vertex "].values,
		    isFirst ? (std::vector<double> {2, 4, 8}) : (std::vector<double> {0.5, 0.25, 1}));
	}
	write("a.ply", triangleWith("property float confidence\n", "0.5\n0.25\n1"));
	EXPECT_EQ(throughWmc("a.ply").attributes[0].kind, AttributeKind::Quality);
	write("a.ply", triangleWith("property double radius\n", "0.5\n0.25\n1"));
	EXPECT_EQ(throughWmc("a.ply").attributes[0].kind, AttributeKind::Radius);
	EXPECT_TRUE(throughWmc("a.ply", {"--attributes", "quality,custom"}).attributes.empty());
}

TEST_F(PlyProperties, FlagsAreNumbersAndDeleteNothing)
{
	write("a.ply", triangleWith("property int flags\n", "1\n64\n7"));
	const MeshData back = throughWmc("a.ply", {"--keep-order"});
	EXPECT_EQ(back.positions.size(), 3u);
	ASSERT_EQ(back.triangles.size(), 1u);
	EXPECT_EQ(byName(back)["vertex flags"].values, (std::vector<double> {1, 64, 7}));
	std::string ofFace = kTwoTriangles;
	ofFace.replace(ofFace.find("uchar part"), 10, "int flags");
	write("a.ply", ofFace);
	EXPECT_EQ(throughWmc("a.ply").triangles.size(), 2u);
}

TEST_F(PlyProperties, AnIntensityIsNoColour)
{
	write("a.ply", triangleWith("property float intensity\n", "0.5\n0.25\n1"));
	const MeshData back = throughWmc("a.ply", {"--keep-order"});
	ASSERT_EQ(back.attributes.size(), 1u);
	EXPECT_EQ(byName(back)["vertex intensity"].values, (std::vector<double> {0.5, 0.25, 1}));
}

TEST_F(PlyProperties, TextureCoordinatesAreReadInWhateverTheirListsAreCounted)
{
	std::string text = triangleWith("", "\n\n\n");
	text.replace(text.find("end_header"), 0, "property list int float texcoord\n");
	text.replace(text.find("3 0 1 2\n"), 8, "3 0 1 2 6 0 0 1 0 0 1\n");
	write("a.ply", text);
	const MeshData back = throughWmc("a.ply", {"--exact", "--keep-order"});
	EXPECT_EQ(whenEncoded_, "");
	ASSERT_EQ(back.attributes.size(), 1u);
	EXPECT_EQ(back.attributes[0].of, AttributeOf::Corner);
	EXPECT_EQ(back.attributes[0].values, (std::vector<double> {0, 0, 0, 1, 0, 0, 0, 1, 0}));
}

/// The file's numbers in an order of bytes and in types of its own.
void appendBytes(FileBytes& out, const void* value, std::size_t n, bool big)
{
	const auto* bytes = static_cast<const std::uint8_t*>(value);
	for (std::size_t i = 0; i < n; ++i)
		out.push_back(bytes[big ? n - 1 - i : i]);
}

TEST_F(PlyProperties, AndMeshesOfEitherOrderOfBytesAndAllTypesAreReadRight)
{
	const double places[4][3]       = {{0, 0, 0}, {1.5, 0, 0}, {0, 2.25, 0}, {0, 0, -3e100}};
	const std::uint32_t faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
	for (const bool big : {false, true})
		for (const std::size_t countBytes : {1u, 2u, 4u})
			for (const std::size_t indexBytes : {1u, 2u, 4u}) {
				SCOPED_TRACE(std::to_string(countBytes) + " " + std::to_string(indexBytes));
				const auto nameOf = [](std::size_t n) {
					return n == 1 ? "uchar" : n == 2 ? "ushort" : "uint";
				};
				const std::string head =
				    std::string("ply\nformat binary_") + (big ? "big" : "little") +
				    "_endian 1.0\ncomment TextureFile my wood.png\nelement vertex 4\n"
				    "property double x\nproperty double y\nproperty double z\n"
				    "property double quality\nproperty float texture_u\n"
				    "property float texture_v\nelement face 4\nproperty list " +
				    nameOf(countBytes) + " " + nameOf(indexBytes) + " vertex_index\nend_header\n";
				FileBytes file(head.begin(), head.end());
				for (const auto& place : places) {
					for (const double x : place)
						appendBytes(file, &x, 8, big);
					appendBytes(file, &place[1], 8, big);
					for (const float t : {0.5f, 0.25f})
						appendBytes(file, &t, 4, big);
				}
				for (const auto& face : faces) {
					const std::uint32_t three = 3;
					appendBytes(file, &three, countBytes, big);
					for (const std::uint32_t& v : face)
						appendBytes(file, &v, indexBytes, big);
				}
				writeAll(path("a.ply"), file);
				const MeshData back = throughWmc("a.ply", {"--exact", "--keep-order"});
				ASSERT_EQ(back.positions.size(), 4u);
				ASSERT_EQ(back.triangles.size(), 4u);
				for (std::size_t i = 0; i < 4; ++i)
					for (std::size_t k = 0; k < 3; ++k) {
						EXPECT_EQ(back.positions[i][k], places[i][k]);
						EXPECT_EQ(back.triangles[i][k], faces[i][k]);
					}
				EXPECT_EQ(back.textures, (std::vector<std::string> {"my wood.png"}));
				bool hasQuality = false;
				for (const Attribute& a : back.attributes)
					if (a.kind == AttributeKind::Quality) {
						hasQuality = true;
						EXPECT_EQ(a.values, (std::vector<double> {0, 0, 2.25, 0}));
					}
				EXPECT_TRUE(hasQuality);
			}
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
	    whenEncoded_.find("not kept: element 'spring', vertex list 'neighbours'"),
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
	EXPECT_EQ(tool::ply::parseHead(file).size, file.size());
}

} // namespace wavemesh::test
