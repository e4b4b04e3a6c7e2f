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
	o.mode          = Mode::Classic;
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

/// A sphere with two charts: an attribute of corners (u, v, chart), on each side of x = 0.3.
MeshData withCharts()
{
	MeshData mesh   = makeBumpySphere(500, 3);
	Attribute wedge = make(AttributeOf::Corner, AttributeKind::TexCoord, NumberType::Double, 3, "");
	for (const auto& t : mesh.triangles) {
		const double sum =
		    mesh.positions[t[0]][0] + mesh.positions[t[1]][0] + mesh.positions[t[2]][0];
		const double chart = sum > 0.9 ? 1 : 0; // two pieces
		for (const std::uint32_t v : t)
			wedge.values.insert(
			    wedge.values.end(),
			    {mesh.positions[v][1] + 10 * chart, mesh.positions[v][2], chart});
	}
	mesh.attributes = {wedge};
	return mesh;
}

TEST(Attributes, CornersOfCoarseFacesHaveRowsOfTheirVertices_AndOfOneChartWhereTheyCan)
{
	EncodeOptions o;
	o.mode          = Mode::Classic;
	o.lifting       = kLiftingOff;
	const auto file = encode(withCharts(), o);
	ASSERT_TRUE(file.ok());
	const auto levels = levelsOf(file->bytes);
	ASSERT_GE(levels.size(), 5u);
	using Row = std::array<double, 3>;
	std::map<Row, std::vector<Row>> rowsAt; // by position
	const auto rowOf = [](const MeshData& m, std::size_t corner) {
		const auto& values = m.attributes[0].values;
		return Row {values[3 * corner], values[3 * corner + 1], values[3 * corner + 2]};
	};
	const MeshData& finest = levels.back().mesh;
	for (std::size_t c = 0; c < 3 * finest.triangles.size(); ++c)
		rowsAt[finest.positions[finest.triangles[c / 3][c % 3]]].push_back(rowOf(finest, c));
	for (const Level& level : levels) {
		ASSERT_EQ(level.mesh.attributes.size(), 1u);
		ASSERT_EQ(level.mesh.attributes[0].values.size(), 9 * level.mesh.triangles.size());
		for (std::size_t f = 0; f < level.mesh.triangles.size(); ++f) {
			bool oneChart = false, could = false;
			for (const double chart : {0.0, 1.0}) {
				bool all = true, any = true;
				for (std::size_t k = 0; k < 3; ++k) {
					const auto& rows = rowsAt[level.mesh.positions[level.mesh.triangles[f][k]]];
					const Row mine   = rowOf(level.mesh, 3 * f + k);
					ASSERT_NE(std::find(rows.begin(), rows.end(), mine), rows.end());
					all = all && mine[2] == chart;
					any = any && std::any_of(rows.begin(), rows.end(), [&](const Row& r) {
						      return r[2] == chart;
					      });
				}
				oneChart = oneChart || all;
				could    = could || (any && chart == rowOf(level.mesh, 3 * f)[2]);
			}
			ASSERT_TRUE(oneChart || !could) << f;
		}
	}
}

TEST(Attributes, CoarseFacesStayOnTheirSideOfASeam)
{
	EncodeOptions o;
	for (const Optimize aim : {Optimize::Size, Optimize::Balanced, Optimize::Levels}) {
		o.optimize      = aim;
		const auto file = encode(withCharts(), o);
		ASSERT_TRUE(file.ok());
		int coarse = 0;
		for (const Level& level : levelsOf(file->bytes)) {
			if (level.mesh.positions.size() < 50)
				continue; // at last seams must go too
			coarse += level.mesh.positions.size() < 150;
			const auto& values = level.mesh.attributes[0].values;
			for (std::size_t i = 2; i < values.size(); i += 9)
				ASSERT_TRUE(values[i] == values[i + 3] && values[i] == values[i + 6])
				    << level.mesh.positions.size();
		}
		EXPECT_GE(coarse, 1);
	}
}

TEST(Attributes, SeamsAroundEachFaceDoNotKeepAMeshFromBeingCoarsened)
{
	MeshData mesh           = withCharts();
	auto& values            = mesh.attributes[0].values;
	mesh.attributes[0].bits = 0;
	for (std::size_t i = 0; i < values.size(); ++i)
		values[i] += double(i / 9); // each face is a chart of its own
	const auto seams = encode(mesh);
	mesh.attributes.clear();
	const auto plain = encode(mesh);
	ASSERT_TRUE(seams.ok() && plain.ok());
	EXPECT_EQ(seams->info.levels.size(), plain->info.levels.size());
	EXPECT_EQ(seams->info.levels[0].vertices, plain->info.levels[0].vertices);
}

TEST(Attributes, APrefixHasThoseOfItsLevel)
{
	const auto file = encode(withAttributes(makeBumpySphere(400, 3), 1));
	ASSERT_TRUE(file.ok());
	for (std::size_t i = 0; i < file->info.levels.size(); ++i) {
		DecodeOptions o;
		o.level          = int(i);
		const auto whole = decode(file->bytes.data(), file->bytes.size(), o);
		const auto part  = decode(file->bytes.data(), file->info.levels[i].prefix, o);
		ASSERT_TRUE(whole.ok() && part.ok()) << i;
		EXPECT_EQ(part->mesh.attributes.size(), i + 1 < file->info.levels.size() ? 6u : 7u);
		EXPECT_EQ(whatDiffers(whole->mesh, part->mesh), "") << i;
	}
}

TEST(Attributes, InsideALevelThoseThatDidNotArriveAreLikeTheirParents)
{
	MeshData mesh = makeBumpySphere(400, 3);
	Attribute quality =
	    make(AttributeOf::Vertex, AttributeKind::Quality, NumberType::Double, 1, "");
	for (std::size_t v = 0; v < mesh.positions.size(); ++v)
		quality.values.push_back(double(v * 7919 % 1000));
	mesh.attributes = {quality};
	EncodeOptions classic;
	classic.mode    = Mode::Classic;
	const auto file = encode(mesh, classic);
	ASSERT_TRUE(file.ok());
	const LevelInfo& last = file->info.levels.back();
	ASSERT_GT(last.attributeBytes, 60u);
	DecodeOptions o;
	o.maxBytes = file->info.levels[file->info.levels.size() - 2].prefix + last.connectivityBytes +
	             last.geometryBytes + last.attributeBytes / 2;
	const auto part = decode(file->bytes.data(), file->bytes.size(), o);
	ASSERT_EQ(part.status().code, StatusCode::Truncated);
	ASSERT_EQ(part->mesh.positions.size(), mesh.positions.size());
	ASSERT_EQ(part->mesh.attributes[0].values.size(), part->mesh.positions.size());
	for (const double x : part->mesh.attributes[0].values)
		EXPECT_TRUE(x >= 0 && x < 1000);
}

TEST(Attributes, AtStatedBitsAreOffByHalfAStep_WholeColumnsNotAtAll)
{
	for (const int bits : {1, 8, 12, 24}) {
		MeshData mesh = withAttributes(shuffled(makeBumpySphere(300, 3), 2), 1);
		for (Attribute& a : mesh.attributes)
			a.bits = bits;
		EncodeOptions o;
		o.keepOrder     = true;
		const auto file = encode(mesh, o);
		ASSERT_TRUE(file.ok()) << file.status().what;
		const auto back = decode(file->bytes.data(), file->bytes.size());
		ASSERT_TRUE(back.ok()) << back.status().what;
		const auto near = [&](std::size_t i, std::size_t column, double step) {
			const Attribute &x = mesh.attributes[i], &y = back->mesh.attributes[i];
			for (std::size_t k = column; k < x.values.size(); k += std::size_t(x.components))
				if (!(std::abs(x.values[k] - y.values[k]) <= 0.5 * step + 3e-7))
					return false;
			return true;
		};
		for (std::size_t i = 0; i < mesh.attributes.size(); ++i)
			EXPECT_EQ(back->mesh.attributes[i].bits, file->info.attributes[i].bits);
		EXPECT_TRUE(sameBits(mesh.attributes[0].values, back->mesh.attributes[0].values));
		EXPECT_EQ(file->info.attributes[1].bits, bits);
		EXPECT_TRUE(near(1, 0, file->info.attributes[1].step));
		// Infinities among them: all is kept.
		EXPECT_EQ(file->info.attributes[2].bits, 0);
		EXPECT_TRUE(sameBits(mesh.attributes[2].values, back->mesh.attributes[2].values));
		EXPECT_EQ(file->info.attributes[5].bits, bits);
		EXPECT_TRUE(near(5, 0, file->info.attributes[5].step));
		EXPECT_TRUE(near(5, 1, file->info.attributes[5].step));
		EXPECT_TRUE(near(5, 2, 0)); // numbers of textures
	}
}

TEST(Attributes, EdgesOfPolygonsStayOnTheirEdgesWithoutTheOrder)
{
	MeshData mesh  = shuffled(makeGrid(7, 6), 5);
	Attribute faux = make(AttributeOf::Face, AttributeKind::FauxEdges, NumberType::Integer, 1, "");
	const auto isInside = [](const std::array<double, 3>& a, const std::array<double, 3>& b) {
		return a[0] != b[0] && a[1] != b[1]; // the diagonals
	};
	for (const auto& t : mesh.triangles) {
		int bits = 0;
		for (std::size_t k = 0; k < 3; ++k)
			bits |= isInside(mesh.positions[t[k]], mesh.positions[t[(k + 1) % 3]]) << k;
		faux.values.push_back(bits);
	}
	mesh.attributes = {faux};
	const auto file = encode(mesh);
	ASSERT_TRUE(file.ok());
	const auto back = decode(file->bytes.data(), file->bytes.size());
	ASSERT_TRUE(back.ok());
	for (std::size_t f = 0; f < back->mesh.triangles.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k) {
			const auto& t = back->mesh.triangles[f];
			EXPECT_EQ(
			    (int(back->mesh.attributes[0].values[f]) >> k) & 1,
			    isInside(back->mesh.positions[t[k]], back->mesh.positions[t[(k + 1) % 3]]));
		}
	DecodeOptions coarse;
	coarse.level = 0;
	EXPECT_TRUE(decode(file->bytes.data(), file->bytes.size(), coarse)->mesh.attributes.empty());
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
	EXPECT_LT(8.0 * double(encode(textured)->info.features.attributeBytes) / n, 85);
}

TEST(Attributes, OfAHubOfManyFacesComeBack)
{
	// Looking through all of the hub's corners for each of them, this would not end.
	constexpr std::uint32_t kSpokes = 100'000;
	MeshData fan;
	addVertex(fan, 0, 0, 1);
	for (std::uint32_t i = 0; i < kSpokes; ++i)
		addVertex(fan, std::cos(i * 6e-5), std::sin(i * 6e-5), i % 7);
	for (std::uint32_t i = 0; i < kSpokes; ++i)
		addFace(fan, 0, 1 + i, 1 + (i + 1) % kSpokes);
	EncodeOptions o;
	o.effort    = 1;
	o.keepOrder = true;
	// At the hub two rows that take turns, and as many rows as faces: as many charts.
	for (const std::uint32_t rows : {2u, kSpokes}) {
		Attribute a = make(AttributeOf::Corner, AttributeKind::Custom, NumberType::Integer, 1, "");
		for (std::uint32_t i = 0; i < 3 * kSpokes; ++i)
			a.values.push_back(i % 3 == 0 ? (i / 3) % rows : 7);
		fan.attributes  = {a};
		const auto file = encode(fan, o);
		ASSERT_TRUE(file.ok()) << file.status().what;
		const auto back = decode(file->bytes.data(), file->bytes.size());
		ASSERT_TRUE(back.ok()) << back.status().what;
		EXPECT_EQ(back->mesh.attributes[0].values, a.values);
	}
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
