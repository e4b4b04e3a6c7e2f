// SPDX-License-Identifier: GPL-3.0-or-later
// Attributes of vertices, faces, corners and of the whole, with any mesh and in any order.
#include "codec_check.h"
#include "mesh_build.h"
#include "mesh_families.h"
#include "rng.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

namespace wavemesh::test {
namespace {

double smooth(double x, double y, double z)
{
	return std::sin(3 * x) + std::cos(2 * y) * z;
}

Attribute
make(AttributeOf of, AttributeKind kind, NumberType type, int components, const char* name)
{
	Attribute a;
	a.of         = of;
	a.kind       = kind;
	a.type       = type;
	a.components = components;
	a.name       = name;
	return a;
}

/// Adds one of everything: smooth, with noise, with seams, with special numbers.
MeshData withAttributes(MeshData m, std::uint64_t seed)
{
	Rng rng(seed);
	Attribute colour = make(AttributeOf::Vertex, AttributeKind::Colour, NumberType::Integer, 4, "");
	Attribute quality = make(AttributeOf::Vertex, AttributeKind::Quality, NumberType::Float, 1, "");
	Attribute custom =
	    make(AttributeOf::Vertex, AttributeKind::Custom, NumberType::Double, 2, "weights");
	for (const auto& p : m.positions) {
		const double s = smooth(p[0], p[1], p[2]);
		for (int k = 0; k < 3; ++k)
			colour.values.push_back(std::clamp(std::floor(128 + 60 * s + 5 * k), 0.0, 255.0));
		colour.values.push_back(255);
		quality.values.push_back(double(float(s)));
		custom.values.push_back(s * 1e200);
		custom.values.push_back(rng.below(7) == 0 ? std::numeric_limits<double>::infinity() : s);
	}
	Attribute face  = make(AttributeOf::Face, AttributeKind::Normal, NumberType::Float, 3, "");
	Attribute flag  = make(AttributeOf::Face, AttributeKind::Selected, NumberType::Integer, 1, "");
	Attribute wedge = make(AttributeOf::Corner, AttributeKind::TexCoord, NumberType::Float, 3, "");
	for (std::size_t f = 0; f < m.triangles.size(); ++f) {
		const double chart = m.positions[m.triangles[f][0]][0] > 0.3 ? 1 : 0;
		for (const std::uint32_t v : m.triangles[f]) {
			wedge.values.push_back(double(float(m.positions[v][1] + chart)));
			wedge.values.push_back(double(float(m.positions[v][2])));
			wedge.values.push_back(chart);
		}
		for (int k = 0; k < 3; ++k)
			face.values.push_back(double(float(rng.below(100)) / 7.0f));
		flag.values.push_back(f % 11 == 0);
	}
	Attribute transform =
	    make(AttributeOf::Mesh, AttributeKind::Transform, NumberType::Double, 16, "");
	for (int k = 0; k < 16; ++k)
		transform.values.push_back(0.1 * k);
	m.attributes = {colour, quality, custom, face, flag, wedge, transform};
	m.textures   = {"wood.png", "a name with spaces and \xc3\xa4.jpg"};
	return m;
}

bool sameBits(const std::vector<double>& a, const std::vector<double>& b)
{
	return a.size() == b.size() &&
	       (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
}

std::string whatDiffers(const MeshData& a, const MeshData& b)
{
	if (a.triangles != b.triangles)
		return "other faces";
	if (a.textures != b.textures)
		return "other textures";
	if (a.attributes.size() != b.attributes.size())
		return "another number of attributes";
	for (std::size_t i = 0; i < a.attributes.size(); ++i) {
		const Attribute &x = a.attributes[i], &y = b.attributes[i];
		if (x.of != y.of || x.kind != y.kind || x.type != y.type || x.components != y.components ||
		    x.name != y.name)
			return "attribute " + std::to_string(i) + " is another";
		if (!sameBits(x.values, y.values))
			return "attribute " + std::to_string(i) + " has other values";
	}
	return {};
}

std::string whatFails(const MeshData& mesh, EncodeOptions o = {})
{
	o.keepOrder     = true;
	const auto file = encode(mesh, o);
	if (!file.ok())
		return file.status().what;
	if (!file->info.features.attributes)
		return "the info does not tell";
	const auto back = decode(file->bytes.data(), file->bytes.size());
	return back.ok() ? whatDiffers(mesh, back->mesh) : back.status().what;
}

TEST(Attributes, ComeBackWithEveryFamily)
{
	std::uint64_t seed = 1;
	for (const NamedMesh& family : smallFamilies(200)) {
		EncodeOptions o;
		o.lifting = int(seed % 4) - 1;
		ASSERT_EQ(whatFails(withAttributes(shuffled(family.mesh, seed), seed), o), "")
		    << family.name;
		++seed;
	}
}

TEST(Attributes, ComeBackWithMeshesThatAreNoManifold)
{
	Rng rng(4);
	for (int i = 0; i < 40; ++i) {
		MeshData mesh = makeIcosphere(2 + i % 3);
		const auto n  = std::uint32_t(mesh.positions.size());
		for (int k = 0; k < 8; ++k) {
			addFace(mesh, rng.below(n), rng.below(n), rng.below(n));
			mesh.triangles.push_back(mesh.triangles[rng.below(20)]);
			std::swap(mesh.triangles[rng.below(20)][0], mesh.triangles[rng.below(20)][1]);
			addVertex(mesh, 0.1 * k, 2, 3);
		}
		ASSERT_EQ(whatFails(withAttributes(mesh, std::uint64_t(i))), "") << i;
	}
}

TEST(Attributes, OfNothingButPointsComeBack)
{
	MeshData points;
	for (int i = 0; i < 50; ++i)
		addVertex(points, i % 7, i / 7, 0.1 * i);
	EXPECT_EQ(whatFails(withAttributes(points, 1)), "");
	MeshData nothing;
	nothing.textures = {"x"};
	EXPECT_EQ(whatFails(nothing), "");
}

TEST(Attributes, WithoutTheOrderTheyFollowTheirVerticesFacesAndCorners)
{
	// Labels that tell the element: rows must fit the decoded mesh whatever its order.
	MeshData mesh    = shuffled(makeBumpySphere(150, 3), 7);
	Attribute vertex = make(AttributeOf::Vertex, AttributeKind::Custom, NumberType::Double, 3, "p");
	Attribute corner = make(AttributeOf::Corner, AttributeKind::Custom, NumberType::Double, 3, "c");
	const auto onLattice = [](const MeshData& m, const StreamInfo& info) {
		return latticeOf(m, info);
	};
	const auto plain = encode(mesh);
	ASSERT_TRUE(plain.ok());
	for (const auto& p : onLattice(mesh, plain->info))
		for (const std::int64_t x : p)
			vertex.values.push_back(double(x));
	for (const auto& t : mesh.triangles)
		for (const std::uint32_t v : t)
			for (std::size_t k = 0; k < 3; ++k)
				corner.values.push_back(vertex.values[3 * v + k]);
	mesh.attributes = {vertex, corner};
	const auto file = encode(mesh);
	ASSERT_TRUE(file.ok());
	const auto back = decode(file->bytes.data(), file->bytes.size());
	ASSERT_TRUE(back.ok()) << back.status().what;
	const auto points = onLattice(back->mesh, back->info);
	for (std::size_t v = 0; v < points.size(); ++v)
		for (std::size_t k = 0; k < 3; ++k)
			ASSERT_EQ(back->mesh.attributes[0].values[3 * v + k], double(points[v][k]));
	for (std::size_t c = 0; c < 3 * back->mesh.triangles.size(); ++c)
		for (std::size_t k = 0; k < 3; ++k)
			ASSERT_EQ(
			    back->mesh.attributes[1].values[3 * c + k],
			    double(points[back->mesh.triangles[c / 3][c % 3]][k]));
}

TEST(Attributes, CoarseLevelsHaveThoseOfTheirVertices)
{
	MeshData mesh = withAttributes(makeBumpySphere(500, 3), 1);
	EncodeOptions o;
	o.lifting       = kLiftingOff; // vertices of all levels are the original's
	const auto file = encode(mesh, o);
	ASSERT_TRUE(file.ok());
	const auto levels = levelsOf(file->bytes);
	ASSERT_GE(levels.size(), 4u);
	std::map<std::array<double, 3>, double> qualityAt;
	const MeshData& finest = levels.back().mesh;
	for (std::size_t v = 0; v < finest.positions.size(); ++v)
		qualityAt[finest.positions[v]] = finest.attributes[1].values[v];
	for (const Level& level : levels) {
		ASSERT_TRUE(level.status.ok());
		ASSERT_GE(level.mesh.attributes.size(), 3u);
		ASSERT_EQ(level.mesh.attributes[0].values.size(), 4 * level.mesh.positions.size());
		for (std::size_t v = 0; v < level.mesh.positions.size(); ++v)
			ASSERT_EQ(level.mesh.attributes[1].values[v], qualityAt[level.mesh.positions[v]]);
	}
}

TEST(Attributes, SmoothColoursAndSeamsCostLittle)
{
	MeshData mesh     = makeBumpySphere(4000, 3);
	const auto plain  = encode(mesh);
	MeshData full     = withAttributes(mesh, 1);
	MeshData coloured = mesh, textured = mesh;
	coloured.attributes = {full.attributes[0]};
	textured.attributes = {full.attributes[5]};
	const double n      = double(mesh.positions.size());
	EXPECT_LT(8.0 * double(encode(coloured)->info.features.attributeBytes) / n, 13);
	EXPECT_LT(8.0 * double(encode(textured)->info.features.attributeBytes) / n, 82);
}

TEST(Attributes, ThatAreNoneAreRefusedByName)
{
	MeshData mesh      = withAttributes(makeIcosphere(2), 1);
	const auto refusal = [](const MeshData& m) {
		const auto file = encode(m);
		return file.ok() ? std::string() : file.status().what;
	};
	MeshData bad = mesh;
	bad.attributes[2].values.pop_back();
	EXPECT_NE(refusal(bad).find("weights"), std::string::npos);
	bad                         = mesh;
	bad.attributes[0].values[3] = 0.5;
	EXPECT_NE(refusal(bad).find("attribute 0"), std::string::npos);
	bad                         = mesh;
	bad.attributes[1].values[3] = 0.1;
	EXPECT_NE(refusal(bad).find("attribute 1"), std::string::npos);
	bad                          = mesh;
	bad.attributes[1].components = 17;
	EXPECT_NE(refusal(bad), "");
	bad = mesh;
	bad.attributes.resize(65);
	EXPECT_NE(refusal(bad), "");
}

TEST(Attributes, MoreThanTheLimitAreRefusedBeforeMemoryIsTaken)
{
	const auto file = encode(withAttributes(makeIcosphere(3), 1));
	ASSERT_TRUE(file.ok());
	DecodeOptions o;
	o.limits.maxAttributeValues = file->info.features.attributeValues;
	EXPECT_TRUE(decode(file->bytes.data(), file->bytes.size(), o).ok());
	--o.limits.maxAttributeValues;
	EXPECT_EQ(
	    decode(file->bytes.data(), file->bytes.size(), o).status().code, StatusCode::LimitExceeded);
}

} // namespace
} // namespace wavemesh::test
