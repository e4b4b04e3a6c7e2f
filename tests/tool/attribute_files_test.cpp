// SPDX-License-Identifier: GPL-3.0-or-later
// Attributes from mesh files into .wmc and back.
#include "mesh_families.h"
#include "mesh_files.h"
#include "run_wmc.h"

#include <wavemesh/codec.h>
#include <wavemesh/vcg_attributes.h>

#include <cmath>
#include <filesystem>
#include <sstream>

namespace wavemesh::test {

namespace {

constexpr unsigned kEverything = kAllChannels;

Attribute& add(MeshData& m, AttributeOf of, AttributeKind kind, NumberType type, int columns)
{
	Attribute a;
	a.of         = of;
	a.kind       = kind;
	a.type       = type;
	a.components = columns;
	m.attributes.push_back(a);
	return m.attributes.back();
}

void addColours(MeshData& m)
{
	Attribute& a = add(m, AttributeOf::Vertex, AttributeKind::Colour, NumberType::Integer, 4);
	for (const auto& p : m.positions)
		for (int k = 0; k < 4; ++k)
			a.values.push_back(k == 3 ? 255 : std::floor(128 + 100 * std::sin(p[0] + k)));
}

void addTexture(MeshData& m)
{
	Attribute& a = add(m, AttributeOf::Corner, AttributeKind::TexCoord, NumberType::Double, 3);
	for (const auto& t : m.triangles) {
		const int chart = m.positions[t[0]][2] > 0;
		for (const std::uint32_t v : t)
			for (const double x :
			     {double(float(m.positions[v][0] / 4)), double(float(m.positions[v][1])),
			      double(chart)})
				a.values.push_back(x);
	}
	m.textures = {"wood.png", "stone.jpg"};
}

class AttributeFiles : public WmcTest
{
protected:
	/// Writes `mesh` as name, encodes it to a.wmc, verifies that, decodes it to other, reads that.
	MeshData throughWmc(
	    const MeshData& mesh,
	    const std::string& name,
	    const std::string& other,
	    std::vector<std::string> options = {})
	{
		tool::saveMesh(mesh, path(name));
		options.insert(options.begin(), {"encode", path(name), path("a.wmc")});
		const RunResult encoded = runWmc(options);
		EXPECT_EQ(encoded.code, 0) << encoded.err;
		const RunResult verified = runWmc({"verify", path(name), path("a.wmc")});
		EXPECT_EQ(verified.code, 0) << verified.err;
		const RunResult decoded = runWmc({"decode", path("a.wmc"), path(other)});
		EXPECT_EQ(decoded.code, 0) << decoded.err;
		warning_ = decoded.err;
		return tool::loadMesh(path(other), kEverything);
	}
	nlohmann::json info() const { return runWmc({"info", path("a.wmc"), "--json"}).json(); }

	std::string warning_;
};

const Attribute* find(const MeshData& m, AttributeOf of, AttributeKind kind)
{
	for (const Attribute& a : m.attributes)
		if (a.of == of && a.kind == kind)
			return &a;
	return nullptr;
}

const std::vector<std::string> kExactInOrder = {"--exact", "--keep-order"};

} // namespace

TEST_F(AttributeFiles, ColoursAndQualityOfAPlyComeBack)
{
	MeshData mesh = makeBumpySphere(300, 1);
	addColours(mesh);
	Attribute& q = add(mesh, AttributeOf::Vertex, AttributeKind::Quality, NumberType::Double, 1);
	for (const auto& p : mesh.positions)
		q.values.push_back(p[0] * p[1]);
	Attribute& f = add(mesh, AttributeOf::Face, AttributeKind::Colour, NumberType::Integer, 4);
	for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
		f.values.insert(f.values.end(), {double(i % 256), 3, double(i / 256), 255});
	const MeshData back = throughWmc(mesh, "a.ply", "b.ply", kExactInOrder);
	ASSERT_EQ(back.attributes.size(), 3u);
	EXPECT_EQ(warning_, "");
	for (std::size_t i = 0; i < 3; ++i) {
		const Attribute* found = find(back, mesh.attributes[i].of, mesh.attributes[i].kind);
		ASSERT_NE(found, nullptr);
		EXPECT_EQ(found->values, mesh.attributes[i].values);
	}
}

TEST_F(AttributeFiles, TexturesOfAnObjComeBackWithTheirNames)
{
	MeshData mesh = makeBumpySphere(300, 1);
	addTexture(mesh);
	addColours(mesh);
	const MeshData back = throughWmc(mesh, "a.obj", "b.obj", kExactInOrder);
	EXPECT_TRUE(std::filesystem::exists(path("b.mtl")));
	EXPECT_EQ(back.textures, mesh.textures);
	const Attribute* wedges = find(back, AttributeOf::Corner, AttributeKind::TexCoord);
	ASSERT_NE(wedges, nullptr);
	EXPECT_EQ(wedges->values, mesh.attributes[0].values);
	const Attribute* colours = find(back, AttributeOf::Vertex, AttributeKind::Colour);
	ASSERT_NE(colours, nullptr);
	EXPECT_EQ(colours->values, mesh.attributes[1].values);
	EXPECT_EQ(info()["textures"], mesh.textures);
}

TEST_F(AttributeFiles, NamesOfTexturesWithLineEndsDoNotBreakAFileOfLines)
{
	MeshData mesh = makeBumpySphere(200, 1);
	addTexture(mesh);
	mesh.textures = {"wood\nend_header\n", "a\x1b[31m.png"};
	writeAll(path("a.wmc"), encode(mesh).value().bytes);
	const RunResult shown = runWmc({"info", path("a.wmc")});
	EXPECT_NE(shown.out.find("texture wood?end_header?\ntexture a?[31m.png\n"), std::string::npos)
	    << shown.out;
	for (const std::string name : {"b.ply", "b.obj"}) {
		const RunResult decoded = runWmc({"decode", path("a.wmc"), path(name)});
		EXPECT_EQ(decoded.code, 0) << decoded.err;
		EXPECT_NE(decoded.err.find("the name of texture 'a?[31m.png'"), std::string::npos)
		    << decoded.err;
		const MeshData back = tool::loadMesh(path(name), kEverything);
		EXPECT_EQ(back.triangles.size(), mesh.triangles.size()) << name;
		EXPECT_EQ(back.textures.size(), 2u) << name;
	}
}

TEST_F(AttributeFiles, ColoursOfAnOffComeBack)
{
	MeshData mesh = makeBumpySphere(200, 1);
	addColours(mesh);
	const MeshData back = throughWmc(mesh, "a.off", "b.off", kExactInOrder);
	ASSERT_EQ(back.attributes.size(), 1u);
	EXPECT_EQ(back.attributes[0].values, mesh.attributes[0].values);
}

TEST_F(AttributeFiles, WhatAFormatCannotHoldIsNamed)
{
	MeshData mesh = makeBumpySphere(200, 1);
	addColours(mesh);
	addTexture(mesh);
	throughWmc(mesh, "a.ply", "b.stl");
	EXPECT_NE(warning_.find("vertex colour"), std::string::npos) << warning_;
	EXPECT_NE(warning_.find("corner texcoord"), std::string::npos) << warning_;
	throughWmc(mesh, "a.ply", "b.off");
	EXPECT_EQ(warning_.find("vertex colour"), std::string::npos) << warning_;
	EXPECT_NE(warning_.find("corner texcoord"), std::string::npos) << warning_;
}

TEST_F(AttributeFiles, InfoListsThem)
{
	MeshData mesh = makeBumpySphere(300, 1);
	addTexture(mesh);
	throughWmc(mesh, "a.ply", "b.ply");
	const auto all = info()["attributes"];
	ASSERT_EQ(all.size(), 1u);
	EXPECT_EQ(all[0]["of"], "corner");
	EXPECT_EQ(all[0]["kind"], "texcoord");
	EXPECT_EQ(all[0]["columns"], 3);
	EXPECT_EQ(all[0]["bits"], 12);
	EXPECT_GT(all[0]["step"], 0);
	EXPECT_GT(all[0]["bytes"], 100);
	EXPECT_NE(runWmc({"info", path("a.wmc")}).out.find("corner texcoord"), std::string::npos);
}

TEST_F(AttributeFiles, BitsAreThoseAskedFor)
{
	MeshData mesh = makeBumpySphere(300, 1);
	addTexture(mesh);
	throughWmc(mesh, "a.ply", "b.ply", {"--attribute-bits", "texcoord=9"});
	EXPECT_EQ(info()["attributes"][0]["bits"], 9);
	throughWmc(mesh, "a.ply", "b.ply", {"--attribute-bits", "texcoord=exact"});
	EXPECT_EQ(info()["attributes"][0]["bits"], 0);
	throughWmc(mesh, "a.ply", "b.ply", {"--exact"});
	EXPECT_EQ(info()["attributes"][0]["bits"], 0);
	for (const std::string wrong : {"texcoord=25", "colour=8", "wood=3", "texcoord", "texcoord=0"})
		EXPECT_EQ(
		    runWmc({"encode", path("a.ply"), path("c.wmc"), "--attribute-bits", wrong}).code, 2)
		    << wrong;
}

TEST_F(AttributeFiles, OnlyThoseAskedForAreKept_NormalsNotByDefault)
{
	MeshData mesh = makeBumpySphere(200, 1);
	tool::saveMesh(mesh, path("plain.ply"));
	addColours(mesh);
	Attribute& n = add(mesh, AttributeOf::Vertex, AttributeKind::Normal, NumberType::Double, 3);
	for (std::size_t v = 0; v < mesh.positions.size(); ++v)
		n.values.insert(n.values.end(), {0, 0.6, 0.8});
	throughWmc(mesh, "a.ply", "b.ply");
	EXPECT_EQ(info()["attributes"].size(), 1u);
	throughWmc(mesh, "a.ply", "b.ply", {"--attributes", "normal"});
	EXPECT_EQ(info()["attributes"][0]["kind"], "normal");
	throughWmc(mesh, "a.ply", "b.ply", {"--attributes", "all"});
	EXPECT_EQ(info()["attributes"].size(), 2u);
	throughWmc(mesh, "a.ply", "b.ply", {"--attributes", "none"});
	runWmc({"encode", path("plain.ply"), path("plain.wmc")});
	EXPECT_EQ(readAll(path("a.wmc")), readAll(path("plain.wmc")));
	EXPECT_EQ(runWmc({"encode", path("a.ply"), path("c.wmc"), "--attributes", "wood"}).code, 2);
}

TEST_F(AttributeFiles, VerifyFailsForOneOtherColourAndForCoordinatesBeyondHalfAStep)
{
	MeshData mesh = makeBumpySphere(300, 1);
	addColours(mesh);
	addTexture(mesh);
	throughWmc(mesh, "a.ply", "b.ply");
	const auto verify = [&](const MeshData& other) {
		tool::saveMesh(other, path("other.ply"));
		return runWmc({"verify", path("other.ply"), path("a.wmc")});
	};
	EXPECT_EQ(verify(mesh).code, 0);
	MeshData other = mesh;
	other.attributes[0].values[400] += 1;
	EXPECT_EQ(verify(other).code, 1);
	EXPECT_NE(verify(other).err.find("vertex colour"), std::string::npos);
	other = mesh;
	other.attributes[1].values[300] += 0.01;
	EXPECT_EQ(verify(other).code, 1);
	other.attributes.pop_back();
	EXPECT_EQ(verify(other).code, 1);
}

TEST_F(AttributeFiles, PolygonsAreKeptAndVerified)
{
	std::string obj;
	for (int i = 0; i < 64; ++i)
		obj += "v " + std::to_string(i % 8) + " " + std::to_string(i / 8) + " " +
		       std::to_string(i % 5) + "\n";
	for (int i = 0; i < 49; ++i) {
		const int v = i / 7 * 8 + i % 7 + 1;
		obj += "f";
		for (const int corner : {v, v + 1, v + 9, v + 8})
			obj += " " + std::to_string(corner);
		obj += "\n";
	}
	writeAll(path("a.obj"), obj);
	ASSERT_EQ(runWmc({"encode", path("a.obj"), path("a.wmc")}).code, 0);
	EXPECT_EQ(info()["attributes"][0]["kind"], "polygons");
	for (const char* name : {"b.obj", "b.off"}) {
		const RunResult r = runWmc({"decode", path("a.wmc"), path(name)});
		EXPECT_EQ(r.err, "") << "nothing is missing";
	}
	const auto lines = [&](const char* name, const char* begin) {
		const FileBytes bytes = readAll(path(name));
		std::istringstream file(std::string(bytes.begin(), bytes.end()));
		int count = 0;
		for (std::string line; std::getline(file, line);)
			count += line.rfind(begin, 0) == 0;
		return count;
	};
	EXPECT_EQ(lines("b.obj", "f "), 49);
	EXPECT_EQ(lines("b.off", "64 49 "), 1);
	for (const char* name : {"a.obj", "b.obj"}) {
		const RunResult r = runWmc({"verify", path(name), path("a.wmc")});
		EXPECT_EQ(r.code, 0) << name << r.err;
	}
	// Polygons of an OFF are cut into triangles in another way than those of an OBJ.
	ASSERT_EQ(runWmc({"encode", path("b.off"), path("c.wmc")}).code, 0);
	ASSERT_EQ(runWmc({"decode", path("c.wmc"), path("c.off")}).code, 0);
	EXPECT_EQ(lines("c.off", "64 49 "), 1);
	EXPECT_EQ(runWmc({"verify", path("c.off"), path("c.wmc")}).code, 0);
	const RunResult r = runWmc({"decode", path("a.wmc"), path("b.ply")});
	EXPECT_NE(r.err.find("polygons"), std::string::npos) << r.err;
}

TEST_F(AttributeFiles, ACutFileHasTheColoursOfItsLevel)
{
	MeshData mesh = makeBumpySphere(900, 3);
	addColours(mesh);
	throughWmc(mesh, "a.ply", "b.ply");
	const auto levels = info()["levels"];
	const auto n      = levels[levels.size() - 2]["prefix"].get<std::size_t>();
	ASSERT_EQ(
	    runWmc({"decode", path("a.wmc"), path("c.ply"), "--max-bytes", std::to_string(n)}).code, 0);
	const MeshData cut = tool::loadMesh(path("c.ply"), kEverything);
	EXPECT_EQ(cut.positions.size(), levels[levels.size() - 2]["vertices"]);
	ASSERT_NE(find(cut, AttributeOf::Vertex, AttributeKind::Colour), nullptr);
}

} // namespace wavemesh::test
