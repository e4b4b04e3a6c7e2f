// SPDX-License-Identifier: GPL-3.0-or-later
// The readers of PLY, OBJ, OFF and STL beside VCGLib's importers, on files that these read right.
#include "full_mesh.h"
#include "mesh_files.h"
#include "run_wmc.h"

#include <wavemesh/vcg_attributes.h>
#include <wavemesh/vcg_wmc.h>

#include <vcg/complex/algorithms/clean.h>

#include <wrap/io_trimesh/import_obj.h>
#include <wrap/io_trimesh/import_off.h>
#include <wrap/io_trimesh/import_ply.h>
#include <wrap/io_trimesh/import_stl.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <sstream>

namespace wavemesh::test {

namespace {

namespace io = vcg::tri::io;
using tool::FullMesh;

constexpr unsigned kAll = kAllChannels & ~unsigned(kCustom);

MeshData byVcg(const std::string& path)
{
	FullMesh m;
	int mask                  = 0;
	const tool::Format format = tool::formatOf(path);
	if (format == tool::Format::Ply)
		EXPECT_EQ(io::ImporterPLY<FullMesh>::Open(m, path.c_str(), mask), 0);
	else if (format == tool::Format::Off)
		EXPECT_EQ(io::ImporterOFF<FullMesh>::Open(m, path.c_str(), mask), 0);
	else if (format == tool::Format::Obj) {
		const auto before = std::filesystem::current_path(); // it looks for materials there
		std::filesystem::current_path(std::filesystem::path(path).parent_path());
		EXPECT_FALSE(io::ImporterOBJ<FullMesh>::ErrorCritical(
		    io::ImporterOBJ<FullMesh>::Open(m, path.c_str(), mask)));
		std::filesystem::current_path(before);
	}
	else {
		EXPECT_EQ(io::ImporterSTL<FullMesh>::Open(m, path.c_str(), mask), 0);
		vcg::tri::Clean<FullMesh>::RemoveDuplicateVertex(m, false);
	}
	using Mask        = io::Mask;
	unsigned channels = 0;
	for (const auto& [bit, channel] : std::vector<std::pair<int, unsigned>> {
	         {Mask::IOM_VERTCOLOR, kVertexColour},
	         {Mask::IOM_VERTNORMAL, kVertexNormal},
	         {Mask::IOM_VERTQUALITY, kVertexQuality},
	         {Mask::IOM_VERTRADIUS, kVertexRadius},
	         {Mask::IOM_VERTTEXCOORD, kVertexTexCoord | kTextures},
	         {Mask::IOM_FACECOLOR, kFaceColour},
	         {Mask::IOM_FACENORMAL, kFaceNormal},
	         {Mask::IOM_FACEQUALITY, kFaceQuality},
	         {Mask::IOM_WEDGTEXCOORD, kWedgeTexCoord | kTextures},
	         {Mask::IOM_BITPOLYGONAL, kFauxEdges}})
		channels |= mask & bit ? channel : 0u;
	if (channels & kWedgeTexCoord) // said to have both: the same ones
		channels &= ~unsigned(kVertexTexCoord);
	// With materials an OBJ is said to have colours even if none of them has one.
	const auto isFirst = [&](const tool::FullFace& f) { return f.cC() == m.face[0].cC(); };
	if (format == tool::Format::Obj && std::all_of(m.face.begin(), m.face.end(), isFirst))
		channels &= ~unsigned(kFaceColour);
	for (auto& v : m.vert) // VCGLib leaves it as it finds it
		v.T().N() = 0;
	MeshData mesh = toMeshData(m);
	addAttributes(m, channels, mesh);
	return mesh;
}

void expectFileAsByVcg(const std::string& path)
{
	const MeshData mine = tool::loadMesh(path, kAll), theirs = byVcg(path);
	EXPECT_EQ(mine.positions, theirs.positions);
	EXPECT_EQ(mine.triangles, theirs.triangles);
	EXPECT_EQ(mine.textures, theirs.textures);
	ASSERT_EQ(mine.attributes.size(), theirs.attributes.size());
	for (std::size_t i = 0; i < mine.attributes.size(); ++i) {
		SCOPED_TRACE("attribute " + std::to_string(i));
		const Attribute &a = mine.attributes[i], &b = theirs.attributes[i];
		EXPECT_EQ(a.of, b.of);
		EXPECT_EQ(a.kind, b.kind);
		EXPECT_EQ(a.type, b.type);
		EXPECT_EQ(a.components, b.components);
		EXPECT_EQ(a.values, b.values);
	}
}

/// A PLY in words, as the encoding asked for.
class PlyFile
{
public:
	PlyFile& line(const std::string& text)
	{
		head_ += text + "\n";
		return *this;
	}
	/// Rows of numbers, each of a type: 'b' uchar, 'h' short, 'i' int, 'f' float, 'd' double.
	PlyFile& row(const std::string& types, const std::vector<double>& numbers)
	{
		rows_.push_back({types, numbers});
		return *this;
	}
	FileBytes bytes(const std::string& encoding) const
	{
		std::string out = "ply\nformat " + encoding + " 1.0\n" + head_ + "end_header\n";
		for (const auto& [types, numbers] : rows_) {
			for (std::size_t i = 0; i < numbers.size(); ++i)
				append(out, types[std::min(i, types.size() - 1)], numbers[i], encoding);
			out += encoding == "ascii" ? "\n" : "";
		}
		return {out.begin(), out.end()};
	}

private:
	template <class T>
	static void appendRaw(std::string& out, T value, bool isBig)
	{
		char raw[sizeof value];
		std::memcpy(raw, &value, sizeof value);
		if (isBig)
			std::reverse(raw, raw + sizeof value);
		out.append(raw, sizeof value);
	}
	static void append(std::string& out, char type, double x, const std::string& encoding)
	{
		const bool isBig = encoding == "binary_big_endian";
		if (encoding == "ascii") {
			std::ostringstream text;
			text.precision(17);
			text << x << " ";
			out += text.str();
		}
		else if (type == 'b')
			appendRaw(out, std::uint8_t(x), isBig);
		else if (type == 'h')
			appendRaw(out, std::int16_t(x), isBig);
		else if (type == 'i')
			appendRaw(out, std::int32_t(x), isBig);
		else if (type == 'f')
			appendRaw(out, float(x), isBig);
		else
			appendRaw(out, x, isBig);
	}

	std::string head_;
	std::vector<std::pair<std::string, std::vector<double>>> rows_;
};

class MeshReaders : public WmcTest
{
protected:
	/// VCGLib does not read doubles in big-endian.
	void expectAsByVcg(const PlyFile& file, bool hasDoubles = false)
	{
		for (const std::string encoding : {"ascii", "binary_little_endian", "binary_big_endian"}) {
			SCOPED_TRACE(encoding);
			if (hasDoubles && encoding == "binary_big_endian")
				continue;
			writeAll(path("a.ply"), file.bytes(encoding));
			expectFileAsByVcg(path("a.ply"));
		}
	}
};

PlyFile fivePoints(const std::string& type = "float", const std::string& more = "")
{
	PlyFile f;
	f.line("comment made by a test").line("element vertex 5");
	for (const char* name : {"x", "y", "z"})
		f.line("property " + type + " " + name);
	std::istringstream lines(more);
	for (std::string l; std::getline(lines, l);)
		f.line(l);
	return f;
}

const double kPoints[5][3] = {{0, 0, 0.1}, {1.1, 0, 0}, {1, 1, 0}, {0, 1, -0.0}, {-1e-5, 0.7, 1e7}};

/// @param more  of point i, after its coordinates
template <class More>
PlyFile& addPoints(PlyFile& f, const std::string& types, More more)
{
	for (int i = 0; i < 5; ++i) {
		std::vector<double> row(kPoints[i], kPoints[i] + 3);
		for (const double x : more(i))
			row.push_back(x);
		f.row(types, row);
	}
	return f;
}

std::vector<double> nothing(int)
{
	return {};
}

} // namespace

TEST_F(MeshReaders, PlyWithTrianglesIsReadAsByVcgInFloatsAndDoubles)
{
	for (const std::string type : {"float", "double", "float32", "float64"}) {
		const bool isDouble = type[0] == 'd' || type == "float64";
		PlyFile f           = fivePoints(type);
		f.line("element face 3").line("property list uchar int vertex_indices");
		addPoints(f, isDouble ? "d" : "f", nothing);
		f.row("bi", {3, 0, 1, 2}).row("bi", {3, 2, 3, 0}).row("bi", {3, 4, 4, 1});
		expectAsByVcg(f, isDouble);
	}
}

TEST_F(MeshReaders, PlyWithPolygonsIsCutAsByVcg)
{
	for (const std::string name : {"vertex_indices", "vertex_index"}) {
		PlyFile f = fivePoints();
		f.line("element face 4").line("property list uchar int " + name);
		f.line("property float quality").line("property uchar red").line("property uchar green");
		f.line("property uchar blue");
		addPoints(f, "f", nothing);
		f.row("biiiiifbbb", {5, 0, 1, 2, 3, 4, 0.1, 1, 2, 3});
		f.row("biiifbbb", {3, 2, 1, 0, 0.25, 255, 0, 7});
		f.row("biiiifbbb", {4, 3, 2, 1, 0, -0.5, 4, 5, 6});
		f.row("biiiiiiifbbb", {7, 0, 1, 0, 2, 0, 3, 4, 1e9, 9, 8, 7});
		expectAsByVcg(f);
	}
}

TEST_F(MeshReaders, AttributesOfAPlysVerticesAreThoseOfVcg)
{
	const auto colour = [](int i) {
		return std::vector<double> {i * 50.0, 255, i + 1.0, 200.0 + i};
	};
	for (const std::string prefix : {"", "diffuse_"})
		for (const bool hasAlpha : {false, true}) {
			PlyFile f = fivePoints(
			    "float", "property uchar " + prefix + "red\nproperty uchar " + prefix +
			                 "green\nproperty uchar " + prefix + "blue\n" +
			                 (hasAlpha ? "property uchar " + prefix + "alpha\n" : ""));
			f.line("element face 1").line("property list uchar int vertex_indices");
			addPoints(f, "fffb", [&](int i) {
				auto c = colour(i);
				c.resize(hasAlpha ? 4 : 3);
				return c;
			});
			expectAsByVcg(f.row("bi", {3, 0, 1, 2}));
		}
	PlyFile all = fivePoints(
	    "float", "property float nx\nproperty float ny\nproperty float nz\n"
	             "property float quality\nproperty float texture_u\nproperty float texture_v\n"
	             "property float radius\n");
	all.line("element face 1").line("property list uchar int vertex_indices");
	addPoints(all, "f", [](int i) {
		return std::vector<double> {0.1 * i, 1, -2, i / 7.0, 0.1 + i, 3, 0.7};
	});
	all.row("bi", {3, 0, 1, 2});
	writeAll(path("a.ply"), all.bytes("ascii"));
	// A radius in floats is where VCGLib's importer wants its mesh to have floats.
	const MeshData mesh = tool::loadMesh(path("a.ply"), kAll);
	ASSERT_EQ(mesh.attributes.size(), 4u);
	EXPECT_EQ(mesh.attributes[3].kind, AttributeKind::Radius);
	EXPECT_EQ(mesh.attributes[3].values, std::vector<double>(5, double(0.7f)));
	PlyFile f = fivePoints("float", "property float s\nproperty float t\n");
	f.line("element face 1").line("property list uchar int vertex_indices");
	addPoints(f, "f", [](int i) { return std::vector<double> {i / 3.0, -i / 7.0}; });
	expectAsByVcg(f.row("bi", {3, 0, 1, 2}));
}

TEST_F(MeshReaders, DoublesOfAPlyAreThoseOfVcg)
{
	PlyFile f = fivePoints(
	    "double",
	    "property double nx\nproperty double ny\nproperty double nz\n"
	    "property double quality\nproperty double texture_u\nproperty double texture_v\n");
	f.line("element face 1").line("property list uchar int vertex_indices");
	f.line("property double nx").line("property double ny").line("property double nz");
	f.line("property double quality");
	addPoints(
	    f, "d", [](int i) { return std::vector<double> {0.1 * i, 1, -2, i / 7.0, 0.1 + i, 3}; });
	expectAsByVcg(f.row("biiid", {3, 0, 1, 2, 0.1, 0.2, 0.3, 1e-300}), true);
}

TEST_F(MeshReaders, TextureCoordinatesOfCornersAreThoseOfVcg)
{
	for (const bool hasNumber : {false, true}) {
		PlyFile f = fivePoints();
		f.line("comment TextureFile wood.png").line("comment TextureFile stone.jpg");
		f.line("element face 2").line("property list uchar int vertex_indices");
		f.line("property list uchar float texcoord");
		if (hasNumber)
			f.line("property int texnumber");
		f.line("property float nx").line("property float ny").line("property float nz");
		addPoints(f, "f", nothing);
		for (const int first : {0, 2}) {
			std::vector<double> row {3, first + 0.0, first + 1.0, first + 2.0, 6};
			for (int k = 0; k < 6; ++k)
				row.push_back(0.1 * k + first);
			if (hasNumber)
				row.push_back(first / 2);
			row.insert(row.end(), {0.3, 0.4, 0.5});
			f.row(hasNumber ? "biiibffffffifff" : "biiibfffffffff", row);
		}
		expectAsByVcg(f);
	}
}

TEST_F(MeshReaders, TriangleStripsAreCutAsByVcg)
{
	PlyFile f = fivePoints();
	f.line("element tristrips 2").line("property list int int vertex_indices");
	addPoints(f, "f", nothing);
	f.row("i", {14, 0, 1, 2, 3, 4, -1, 2, 1, 0, 4, -1, 4, 3, 2});
	f.row("i", {4, 3, 1, 2, 0});
	expectAsByVcg(f);
	PlyFile odd = fivePoints();
	odd.line("element tristrips 1").line("property list int int vertex_indices");
	addPoints(odd, "f", nothing);
	expectAsByVcg(odd.row("i", {9, 0, 1, 2, 3, -1, 4, 2, 1, 0}));
}

TEST_F(MeshReaders, StripsBesideFacesAreNamedAndBesideNoneAreRead)
{
	for (const int faces : {0, 1}) {
		PlyFile f = fivePoints();
		f.line("element face " + std::to_string(faces));
		f.line("property list uchar int vertex_indices").line("property uchar red");
		f.line("property uchar green").line("property uchar blue").line("property int part");
		f.line("element tristrips 1").line("property list int int vertex_indices");
		addPoints(f, "f", nothing);
		if (faces > 0)
			f.row("biiibbbi", {3, 0, 1, 2, 7, 8, 9, 4});
		f.row("i", {4, 0, 1, 2, 3});
		writeAll(path("a.ply"), f.bytes("ascii"));
		std::vector<std::string> notRead;
		const MeshData mesh = tool::loadMesh(path("a.ply"), kAllChannels, &notRead);
		EXPECT_EQ(mesh.triangles.size(), faces > 0 ? 1u : 2u);
		EXPECT_EQ(mesh.attributes.size(), faces > 0 ? 2u : 0u);
		EXPECT_EQ(notRead.size(), faces > 0 ? 1u : 0u);
		EXPECT_EQ(runWmc({"encode", path("a.ply"), path("a.wmc")}).code, 0);
	}
}

TEST_F(MeshReaders, MoreAttributesThanAFileMayHaveAreNamed)
{
	std::string more;
	for (int i = 0; i < 70; ++i)
		more += "property float p" + std::to_string(i) + "\n";
	PlyFile f = fivePoints("float", more + "property float quality\n");
	f.line("element face 1").line("property list uchar int vertex_indices");
	f.line("property int part");
	addPoints(f, "f", [](int i) { return std::vector<double>(71, i); });
	f.row("biiiiii", {5, 0, 1, 2, 3, 4, 1});
	writeAll(path("a.ply"), f.bytes("binary_little_endian"));
	std::vector<std::string> notRead;
	const MeshData mesh = tool::loadMesh(path("a.ply"), kAllChannels, &notRead);
	ASSERT_EQ(mesh.attributes.size(), 64u);
	EXPECT_EQ(mesh.attributes[0].kind, AttributeKind::Quality);
	EXPECT_EQ(mesh.attributes[1].kind, AttributeKind::FauxEdges);
	EXPECT_EQ(notRead.size(), 9u);
	EXPECT_EQ(runWmc({"encode", path("a.ply"), path("a.wmc")}).code, 0);
}

TEST_F(MeshReaders, RangeGridsAreCutAsByVcg)
{
	PlyFile f = fivePoints();
	f.line("obj_info num_cols 4").line("obj_info num_rows 3");
	f.line("element range_grid 12").line("property list uchar int vertex_indices");
	addPoints(f, "f", nothing);
	for (const int v : {0, 1, -1, 2, 3, 4, 0, -1, 1, -1, 2, 3})
		f.row("bi", v < 0 ? std::vector<double> {0} : std::vector<double> {1, double(v)});
	expectAsByVcg(f);
	const MeshData mesh = tool::loadMesh(path("a.ply"));
	EXPECT_GT(mesh.triangles.size(), 3u);
}

TEST_F(MeshReaders, WhatAPlyHasBesidesDoesNotChangeTheMesh)
{
	PlyFile f;
	f.line("element note 2").line("property list uchar short words").line("property char tone");
	f.line("element vertex 5").line("property short before").line("property float x");
	f.line("property float y").line("property list uchar uint near").line("property float z");
	f.line("element edge 1").line("property int vertex1").line("property int vertex2");
	f.line("element face 1").line("property ushort part");
	f.line("property list uchar int vertex_indices");
	f.row("bhhb", {2, -1, 300, 7}).row("bhb", {1, 4, 9});
	for (const auto& p : kPoints)
		f.row("hffbif", {-3, p[0], p[1], 1, 4, p[2]});
	expectAsByVcg(f.row("i", {0, 1}).row("hbi", {40, 3, 0, 1, 2}));
}

TEST_F(MeshReaders, OffIsReadAsByVcg)
{
	const std::string points = "0 0 0\n1 0 0\n1 1 0.1\n0 1 0\n2 0.5 1\n";
	for (const std::string& text : std::vector<std::string> {
	         "OFF\n5 2 0\n" + points + "3 0 1 2\n3 0 2 4\n", "OFF 5 0 0\n" + points,
	         "OFF\n# a comment\n5 3 0\n\n" + points + "4 0 1 2 3\n4 1 2 3 0\n3 0 1 4\n",
	         "OFF\n5 2 0\n0 0 0 1 0\n0 1 1 0.1 0 1 0\n2 0.5\n1\n3 0 1 2\n3 0 2 4\n",
	         "OFF\n5 3 0\n" + points + "3 0 1 2 255 0 7\n4 0 1 2 3 1 2 3 4\n3 1 2 4 0.5 0.1 1\n",
	         "COFF\n5 1 0\n0 0 0 1 2 3\n1 0 0 4 5 6 7\n1 1 0 0.1 0.2 1\n0 1 0\n0 2 0 17\n3 0 1 2\n",
	         std::string("NOFF\n3 1 0\n0 0 0 0.1 0 1\n1 0 0 0 1 0\n0 1 0 1 0 0\n3 0 1 2\n"),
	         std::string("CNOFF\n3 1 0\n0 0 0 0.1 0 1 9 8 7\n1 0 0 0 1 0 6 5 4\n0 1 0 1 0 0 3 2 1\n"
	                     "3 0 1 2\n")}) {
		SCOPED_TRACE(text);
		writeAll(path("a.off"), text);
		expectFileAsByVcg(path("a.off"));
	}
}

TEST_F(MeshReaders, SquaresOfAnOffAreCutAsByVcg)
{
	// Squares of which the one or the other diagonal is the better, and one that has none left.
	std::string text = "OFF\n30 24 0\n", faces;
	for (int i = 0; i < 30; ++i)
		text += std::to_string(i % 6 + 0.13 * (i * 7 % 5)) + " " + std::to_string(i / 6) + " " +
		        std::to_string(0.2 * (i * 3 % 4)) + "\n";
	for (int i = 0; i < 24; ++i) {
		const int v = i / 6 * 6 + std::min(i % 6, 4);
		for (const int k : {4, v, v + 1, v + 7, v + 6})
			text += std::to_string(k) + " ";
		text += "\n";
	}
	writeAll(path("a.off"), text);
	expectFileAsByVcg(path("a.off"));
}

TEST_F(MeshReaders, ObjIsReadAsByVcg)
{
	const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0.1\nv 0 1 0\nv 2 0.5 1\n";
	const std::string places = "vt 0 0\nvt 1 0\nvt 0.1 1 0\n";
	std::string normals, colours;
	for (int i = 0; i < 5; ++i) {
		normals += "vn 0.1 " + std::to_string(i) + " 1\n";
		colours += "v " + std::to_string(i) + " 0 0.5 0.1 " + std::to_string(0.2 * i) + " 1\n";
	}
	writeAll(
	    path("b.mtl"), std::string("# none\nnewmtl wood\nKd 1 0.5 0.1\nmap_Kd wood.png\n"
	                               "newmtl plain\nKd 0 0 1\nNs 10\nnewmtl two words\n"
	                               "map_Kd stone.jpg\nnewmtl again\nmap_Kd wood.png\n"));
	for (const std::string& text : std::vector<std::string> {
	         points + "f 1 2 3\nf -1 -2 -3\ng a\nf 1 2 3 4\n\nf 5 4 3 2 1\n# end",
	         points + "f 1 2 \\\n3\nq 0 1 2 3\nl 1 2\r\nf 1 2 3\r\n", colours + "f 1 2 3\n",
	         "v 0 0 0 255 7 9\nv 1 0 0 1 2 3\nv 0 1 0\nv 0 1 1 0.5 0.5 1 0.25\nf 1 2 3\nf 2 3 4\n",
	         points + normals + "f 1//2 2//1 3//5\nf 3//-1 4//-2 5//-3\nf 1 2 4\n",
	         points + "vn 0 0 1\nf 1//1 2//1 3//1\n",
	         points + places + "f 1/1 2/2 3/3\nf 1/-1 2/-2 3/-3 4/1\nf 3 4 5\n",
	         points + places + normals + "f 1/1/1 2/2/3 3/3/2 5/1/5\nf 1//1 2//2 3//3\n",
	         "mtllib b.mtl\n" + points + places +
	             "f 1/1 2/2 3/3\nusemtl wood\nf 2/1 3/2 4/3\nusemtl two words\nf 1/1 3/2 4/3\n"
	             "usemtl again\nf 5/1 3/2 4/3 2/3\nusemtl nowhere\nf 1/1 4/2 5/3\nusemtl plain\n"
	             "f 2/1 4/2 5/3\n",
	         "mtllib b.mtl\n" + points + "usemtl wood\nf 1 2 3\nusemtl plain\nf 2 3 4\n",
	         "mtllib b.mtl\nusemtl wood\n" + points + "f 1 2 3\nf 2 3 4\n",
	         "mtllib none.mtl\n" + points + places + "usemtl wood\nf 1/1 2/2 3/3\n"}) {
		SCOPED_TRACE(text);
		for (const std::string name : {"a.obj", "b.obj"}) { // with b.mtl of the same name
			writeAll(path(name), text);
			expectFileAsByVcg(path(name));
		}
	}
}

TEST_F(MeshReaders, MaterialsThatAreCutOffDoNotCrash)
{
	for (const std::string text :
	     {"newmtl", "newmtl a\nd\nTr\nNs\nillum\nKd\nmap_Kd", "newmtl a\\", "\\\n", ""}) {
		writeAll(path("a.mtl"), text);
		writeAll(
		    path("a.obj"), std::string("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n"
		                               "#MRGB ffffffff\nusemtl a\nf 1/1 2/1 3/1 # of three\n"));
		EXPECT_EQ(tool::loadMesh(path("a.obj"), kAll).triangles.size(), 1u);
	}
}

TEST_F(MeshReaders, StlIsReadAsByVcg)
{
	const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0.1 0 0\n"
	                          "vertex 0 1e-3 0\nendloop\nendfacet\n";
	std::string other       = facet;
	other.replace(other.find("0.1 0 0"), 7, "0 0 5.5");
	writeAll(path("a.stl"), "solid a vertex\n" + facet + other + facet + "endsolid a vertex\n");
	expectFileAsByVcg(path("a.stl"));
	writeAll(path("b.stl"), "solid a\n" + facet + "endsolid a\nsolid b\n" + other + "endsolid b\n");
	expectFileAsByVcg(path("b.stl"));
	ASSERT_EQ(tool::loadMesh(path("b.stl")).triangles.size(), 2u);
	tool::saveMesh(tool::loadMesh(path("a.stl")), path("c.stl"));
	EXPECT_EQ(tool::loadMesh(path("c.stl")).triangles, tool::loadMesh(path("a.stl")).triangles);
	EXPECT_EQ(tool::loadMesh(path("c.stl")).positions, tool::loadMesh(path("a.stl")).positions);
}

} // namespace wavemesh::test
