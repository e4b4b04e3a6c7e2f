// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Colours, texture coordinates and the like through io_wavemesh, and on the levels.
#include "test_host.h"

#include <wavemesh/codec.h>

#include <wrap/io_trimesh/io_mask.h>

#include <QImage>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

using namespace wavemesh;
using namespace wavemesh::test;

namespace {

using Mask   = vcg::tri::io::Mask;
using Custom = vcg::tri::Allocator<CMeshO>;

/// What makes a decoded mesh comparable with its original, element by element.
const MeshLabHost::Settings kInOrder = {{"exact", "true"}, {"keep_order", "true"}};

MeshModel& openIsland(MeshLabHost& host)
{
	return *host.open(sample("island.ply")).front();
}

/// Saves the current layer and opens the file as another.
MeshModel& reopened(
    MeshLabHost& host,
    MeshLabHost::Settings save        = kInOrder,
    const MeshLabHost::Settings& open = {},
    std::optional<int> mask           = {})
{
	host.save(scratch("attributes.wmc"), save, mask);
	return *host.open(scratch("attributes.wmc"), open).front();
}

void colourVertices(MeshModel& layer, int shift)
{
	layer.updateDataMask(MeshModel::MM_VERTCOLOR);
	for (auto& v : layer.cm.vert) {
		const int wave = int(40 * std::sin(double(v.cP()[0])));
		v.C()          = vcg::Color4b(
		             (unsigned char)(shift + wave), (unsigned char)(shift + 10),
		             (unsigned char)(shift - wave), 255);
	}
}

/// Are all colours within what colourVertices() gives?
bool hasColours(const MeshModel& layer, int shift)
{
	return layer.hasDataMask(MeshModel::MM_VERTCOLOR) && layer.cm.vn > 0 &&
	       std::all_of(layer.cm.vert.begin(), layer.cm.vert.end(), [&](const CVertexO& v) {
		       return std::abs(v.cC()[0] - shift) <= 40 && v.cC()[1] == shift + 10;
	       });
}

void texture(MeshModel& layer)
{
	QImage image(4, 3, QImage::Format_RGB32);
	image.fill(Qt::darkGreen);
	ASSERT_TRUE(image.save(scratch("wood.png")));
	layer.addTexture("wood.png", image);
	layer.updateDataMask(MeshModel::MM_WEDGTEXCOORD);
	for (auto& f : layer.cm.face)
		for (int k = 0; k < 3; ++k) { // two charts, with a seam between
			const float chart = f.cP(0)[0] > 0 ? 0.5f : 0;
			f.WT(k).U()       = chart + float(f.cP(k)[1]) / 3;
			f.WT(k).V()       = float(f.cP(k)[2]) / 7;
			f.WT(k).N()       = 0;
		}
}

void textureVertices(MeshModel& layer)
{
	texture(layer);
	layer.clearDataMask(MeshModel::MM_WEDGTEXCOORD);
	layer.updateDataMask(MeshModel::MM_VERTTEXCOORD);
	for (auto& v : layer.cm.vert) {
		v.T().U() = float(v.cP()[1]) / 3;
		v.T().V() = float(v.cP()[2]) / 7;
		v.T().N() = 0;
	}
}

Attribute attributeOf(AttributeOf of, AttributeKind kind, NumberType type, int components)
{
	Attribute a;
	a.of         = of;
	a.kind       = kind;
	a.type       = type;
	a.components = components;
	return a;
}

int countIf(const CMeshO& m, const std::function<bool(const CFaceO&)>& is)
{
	return int(std::count_if(m.face.begin(), m.face.end(), is));
}

} // namespace

TEST(IoAttributes, VertexColoursQualityAndRadiusComeBackEqual)
{
	MeshLabHost& host = freshHost();
	MeshModel& from   = openIsland(host);
	colourVertices(from, 100);
	from.updateDataMask(MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTRADIUS);
	for (auto& v : from.cm.vert) {
		v.Q() = v.cP()[0] / 3;
		v.R() = 1 + v.cP()[1] * v.cP()[1];
	}
	const MeshModel& back = reopened(host);
	ASSERT_EQ(back.cm.vn, from.cm.vn);
	ASSERT_TRUE(back.hasDataMask(MeshModel::MM_VERTCOLOR));
	ASSERT_TRUE(back.hasDataMask(MeshModel::MM_VERTQUALITY));
	ASSERT_TRUE(back.hasDataMask(MeshModel::MM_VERTRADIUS));
	for (std::size_t v = 0; v < from.cm.vert.size(); ++v) {
		ASSERT_EQ(back.cm.vert[v].cC(), from.cm.vert[v].cC()) << v;
		ASSERT_EQ(back.cm.vert[v].cQ(), from.cm.vert[v].cQ()) << v;
		ASSERT_EQ(back.cm.vert[v].cR(), from.cm.vert[v].cR()) << v;
	}
}

TEST(IoAttributes, SeamsAndTexturesComeBackEqual)
{
	MeshLabHost& host = freshHost();
	MeshModel& from   = openIsland(host);
	texture(from);
	const MeshModel& back = reopened(host);
	ASSERT_EQ(back.cm.fn, from.cm.fn);
	ASSERT_TRUE(back.hasDataMask(MeshModel::MM_WEDGTEXCOORD));
	ASSERT_EQ(back.cm.textures, std::vector<std::string> {"wood.png"});
	EXPECT_EQ(back.getTexture("wood.png").size(), QSize(4, 3)) << "found beside the .wmc";
	for (std::size_t f = 0; f < from.cm.face.size(); ++f)
		for (int k = 0; k < 3; ++k)
			ASSERT_TRUE(back.cm.face[f].cWT(k) == from.cm.face[f].cWT(k)) << f;
}

TEST(IoAttributes, FaceColoursQualityAndPolygonsComeBackEqual)
{
	MeshLabHost& host = freshHost();
	MeshModel& from   = openIsland(host);
	from.updateDataMask(MeshModel::MM_FACECOLOR | MeshModel::MM_FACEQUALITY);
	for (std::size_t f = 0; f < from.cm.face.size(); ++f) {
		from.cm.face[f].C() = vcg::Color4b(
		    (unsigned char)(f % 256), (unsigned char)(f / 256), 3, (unsigned char)(255 - f % 5));
		from.cm.face[f].Q() = Scalarm(f) / 3;
		if (f % 4 == 1)
			from.cm.face[f].SetF(int(f) % 3);
	}
	const MeshModel& back = reopened(host);
	ASSERT_EQ(back.cm.fn, from.cm.fn);
	EXPECT_TRUE(back.hasDataMask(MeshModel::MM_POLYGONAL));
	for (std::size_t f = 0; f < from.cm.face.size(); ++f) {
		ASSERT_EQ(back.cm.face[f].cC(), from.cm.face[f].cC()) << f;
		ASSERT_EQ(back.cm.face[f].cQ(), from.cm.face[f].cQ()) << f;
		for (int k = 0; k < 3; ++k)
			ASSERT_EQ(back.cm.face[f].IsF(k), from.cm.face[f].IsF(k)) << f;
	}
}

TEST(IoAttributes, FlagsKeepTheSelectionAndTheDefaultDoesNot)
{
	MeshLabHost& host = freshHost();
	MeshModel& from   = openIsland(host);
	for (std::size_t v = 0; v < from.cm.vert.size(); v += 3)
		from.cm.vert[v].SetS();
	for (std::size_t f = 0; f < from.cm.face.size(); f += 5)
		from.cm.face[f].SetS();
	const MeshModel& back = reopened(host, kInOrder, {}, Mask::IOM_FLAGS);
	EXPECT_EQ(back.cm.svn, (from.cm.vn + 2) / 3);
	EXPECT_EQ(back.cm.sfn, (from.cm.fn + 4) / 5);
	for (std::size_t v = 0; v < from.cm.vert.size(); ++v)
		ASSERT_EQ(back.cm.vert[v].IsS(), v % 3 == 0) << v;
	for (std::size_t f = 0; f < from.cm.face.size(); ++f)
		ASSERT_EQ(back.cm.face[f].IsS(), f % 5 == 0) << f;

	const MeshModel& plain = reopened(host);
	EXPECT_EQ(countIf(plain.cm, [](const CFaceO& f) { return f.IsS(); }), 0);
}

TEST(IoAttributes, NormalsThatAreChosenComeBackEqual)
{
	MeshLabHost& host = freshHost();
	MeshModel& from   = openIsland(host);
	for (auto& v : from.cm.vert)
		v.N() = Point3m(0, 0.6f, -0.8f);
	const MeshModel& back = reopened(host, kInOrder, {}, Mask::IOM_VERTNORMAL);
	for (const auto& v : back.cm.vert)
		ASSERT_EQ(v.cN(), Point3m(0, 0.6f, -0.8f));
}

TEST(IoAttributes, TheTransformationComesBackWithTheWholeMeshAndWithAllLevels)
{
	MeshLabHost& host = freshHost();
	MeshModel& from   = openIsland(host);
	from.cm.Tr.SetTranslate(1, 2, 3);
	const Matrix44m placed = from.cm.Tr;
	EXPECT_TRUE(reopened(host).cm.Tr == placed);
	for (const MeshModel* layer :
	     freshHost().open(scratch("attributes.wmc"), {{"all_levels", "true"}}))
		EXPECT_TRUE(layer->cm.Tr == placed) << qPrintable(layer->label());
}

TEST(IoAttributes, UserDefinedAttributesComeBackIfAsked)
{
	MeshLabHost& host = freshHost();
	MeshModel& from   = openIsland(host);
	auto weight       = Custom::AddPerVertexAttribute<float>(from.cm, "weight");
	for (std::size_t v = 0; v < from.cm.vert.size(); ++v)
		weight[v] = float(v) / 3;
	MeshLabHost::Settings settings = kInOrder;
	settings["custom"]             = "true";
	const MeshModel& back          = reopened(host, settings);
	const auto kept                = Custom::FindPerVertexAttribute<float>(back.cm, "weight");
	ASSERT_TRUE(Custom::IsValidHandle(back.cm, kept));
	for (std::size_t v = 0; v < back.cm.vert.size(); ++v)
		ASSERT_EQ(kept[v], float(v) / 3);
}

TEST(IoAttributes, WhatIsNotChosenOrNotThereIsNotSaved)
{
	MeshLabHost& host = freshHost();
	MeshModel& from   = openIsland(host);
	host.save(scratch("plain.wmc"), kInOrder);
	colourVertices(from, 100);
	texture(from);
	Custom::AddPerVertexAttribute<float>(from.cm, "weight");
	const MeshModel& back = reopened(host, kInOrder, {}, Mask::IOM_VERTQUALITY);
	EXPECT_FALSE(back.hasDataMask(MeshModel::MM_VERTCOLOR | MeshModel::MM_WEDGTEXCOORD));
	EXPECT_TRUE(back.cm.textures.empty());
	EXPECT_EQ(contents(scratch("attributes.wmc")), contents(scratch("plain.wmc")));
}

TEST(IoAttributes, TheLogNamesWhatTheLayerHasAndTheFileDoesNot)
{
	MeshLabHost& host  = freshHost();
	const auto warning = [&](std::optional<int> mask, const MeshLabHost::Settings& settings = {}) {
		host.document().Log.clear();
		host.save(scratch("logged.wmc"), settings, mask);
		QStringList lines;
		host.document().Log.print(lines);
		const QStringList found = lines.filter("Not saved");
		return found.isEmpty() ? QString() : found.front();
	};
	MeshModel& layer = openIsland(host);
	EXPECT_EQ(warning({}), QString());
	colourVertices(layer, 100);
	texture(layer);
	EXPECT_EQ(warning({}), QString());
	EXPECT_TRUE(warning(Mask::IOM_VERTCOLOR).contains("wedge texture coordinates"));
	EXPECT_FALSE(warning(Mask::IOM_VERTCOLOR).contains("colours"));

	Custom::AddPerVertexAttribute<float>(layer.cm, "weight");
	Custom::AddPerFaceAttribute<vcg::Point3f>(layer.cm, "pull");
	Custom::AddPerFaceAttribute<int>(layer.cm, "part");
	EXPECT_TRUE(warning({}).contains("user-defined attributes of vertices (weight), "
	                                 "user-defined attributes of faces (part, pull)"))
	    << qPrintable(warning({}));
	EXPECT_TRUE(warning({}, {{"custom", "true"}})
	                .contains("Not saved: user-defined attributes of faces (part)."))
	    << qPrintable(warning({}, {{"custom", "true"}}));
}

TEST(IoAttributes, EveryLevelHasTheColoursOfItsVertices)
{
	MeshLabHost& host = freshHost();
	colourVertices(openIsland(host), 100);
	const MeshModel& coarse = reopened(host, {}, {{"level", "1"}});
	EXPECT_LT(coarse.cm.vn, openIsland(host).cm.vn);
	EXPECT_TRUE(hasColours(coarse, 100));
	for (const MeshModel* layer :
	     freshHost().open(scratch("attributes.wmc"), {{"all_levels", "true"}}))
		EXPECT_TRUE(hasColours(*layer, 100)) << qPrintable(layer->label());
}

TEST(IoAttributes, BrowsingShowsTheColoursOfTheFileAndThoseThatTheFinestWasGivenSince)
{
	MeshLabHost& host = freshHost();
	colourVertices(openIsland(host), 100);
	MeshModel& layer   = reopened(host);
	const int vertices = layer.cm.vn;
	const auto browse  = [&](const char* level) {
        host.apply("Wavemesh: Browse Levels", {{"level", level}});
	};
	browse("1");
	EXPECT_TRUE(hasColours(layer, 100));
	EXPECT_LT(layer.cm.vn, vertices);
	browse("-1");
	EXPECT_TRUE(hasColours(layer, 100));

	colourVertices(layer, 170);
	browse("1");
	EXPECT_LT(layer.cm.vn, vertices);
	EXPECT_TRUE(hasColours(layer, 170));
	browse("-1");
	EXPECT_TRUE(hasColours(layer, 170));
}

TEST(IoAttributes, ASimplifiedMeshKeepsItsColours)
{
	MeshLabHost& host = freshHost();
	MeshModel& layer  = openIsland(host);
	const int before  = layer.cm.vn;
	colourVertices(layer, 100);
	host.apply("Simplification: Wavemesh", {{"target", "0"}, {"levels_removed", "3"}});
	EXPECT_LT(layer.cm.vn, before);
	EXPECT_TRUE(hasColours(layer, 100));
}

TEST(IoAttributes, LevelsWithTextureCoordinatesOfVerticesHaveTheirTexture)
{
	MeshLabHost& host = freshHost();
	textureVertices(openIsland(host));
	const auto check = [](const MeshModel& layer) {
		EXPECT_TRUE(layer.hasDataMask(MeshModel::MM_VERTTEXCOORD));
		ASSERT_EQ(layer.cm.textures, std::vector<std::string> {"wood.png"});
		EXPECT_EQ(layer.getTexture("wood.png").size(), QSize(4, 3));
	};
	MeshModel& layer = reopened(host);
	check(layer);
	host.apply("Wavemesh: Browse Levels", {{"level", "1"}});
	check(layer);
	host.apply("Wavemesh: Layers from Levels");
	for (const MeshModel& m : host.document().meshIterator())
		check(m);
	host.clear();
	MeshModel& coarse = *host.open(scratch("attributes.wmc"), {{"level", "1"}}).front();
	check(coarse);
	host.apply("Wavemesh: Browse Levels", {{"level", "-1"}});
	check(coarse);
	host.clear();
	for (const MeshModel* m : host.open(scratch("attributes.wmc"), {{"all_levels", "true"}}))
		check(*m);
}

TEST(IoAttributes, EveryLevelHasTextureCoordinatesOfWedgesAndColoursOfFaces)
{
	MeshLabHost& host = freshHost();
	MeshModel& from   = openIsland(host);
	texture(from);
	from.updateDataMask(MeshModel::MM_FACECOLOR);
	for (CFaceO& f : from.cm.face)
		f.C() = f.cP(0)[0] > 0 ? vcg::Color4b(200, 0, 0, 255) : vcg::Color4b(0, 200, 0, 255);
	const auto check = [](const MeshModel& layer) {
		ASSERT_TRUE(layer.hasDataMask(MeshModel::MM_WEDGTEXCOORD));
		ASSERT_TRUE(layer.hasDataMask(MeshModel::MM_FACECOLOR));
		EXPECT_EQ(layer.getTexture("wood.png").size(), QSize(4, 3));
		for (const CFaceO& f : layer.cm.face) {
			EXPECT_TRUE(f.cC()[0] + f.cC()[1] == 200) << "a colour of the original";
			for (int k = 0; k < 3; ++k) { // coarse positions are rounded
				const double off = f.cWT(k).U() - f.cP(k)[1] / 3;
				EXPECT_LT(std::min(std::abs(off), std::abs(off - 0.5)), 0.15);
			}
		}
	};
	MeshModel& layer = reopened(host, {}, {{"level", "1"}});
	check(layer);
	for (const char* level : {"0", "3", "-1"}) {
		host.apply("Wavemesh: Browse Levels", {{"level", level}});
		check(layer);
	}
	for (const MeshModel* m : freshHost().open(scratch("attributes.wmc"), {{"all_levels", "true"}}))
		check(*m);
}

TEST(IoAttributes, TextureCoordinatesAreRoundedAsTheLogSays)
{
	MeshLabHost& host = freshHost();
	MeshModel& from   = openIsland(host);
	texture(from);
	from.updateDataMask(MeshModel::MM_VERTQUALITY);
	for (auto& v : from.cm.vert)
		v.Q() = v.cP()[0] / 3;
	host.document().Log.clear();
	const MeshModel& back = reopened(host, {{"keep_order", "true"}, {"quality_bits", "0"}});
	QStringList lines;
	host.document().Log.print(lines);
	const QStringList found = lines.filter("Rounded: wedge texture coordinates");
	ASSERT_EQ(found.size(), 1);
	EXPECT_TRUE(found.front().contains("12 bits")) << qPrintable(found.front());
	EXPECT_FALSE(found.front().contains("quality")) << qPrintable(found.front());
	for (std::size_t f = 0; f < from.cm.face.size(); ++f)
		for (int k = 0; k < 3; ++k)
			ASSERT_NEAR(back.cm.face[f].cWT(k).U(), from.cm.face[f].cWT(k).U(), 0.001);
	for (std::size_t v = 0; v < from.cm.vert.size(); ++v)
		ASSERT_EQ(back.cm.vert[v].cQ(), from.cm.vert[v].cQ());
	EXPECT_THROW(host.save(scratch("no.wmc"), {{"texcoord_bits", "25"}}), MLException);
}

TEST(IoAttributes, NumbersThatMeshLabCannotHoldBecomeTheNearestThatItCan)
{
	const double huge = 1e300, nan = std::numeric_limits<double>::quiet_NaN();
	MeshData data;
	data.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
	data.triangles = {{0, 1, 2}};
	Attribute colour =
	    attributeOf(AttributeOf::Vertex, AttributeKind::Colour, NumberType::Double, 4);
	colour.values = {huge, -huge, nan, 7, 256, 255, 0, -1, 1, 2, 3, 4};
	Attribute wedge =
	    attributeOf(AttributeOf::Corner, AttributeKind::TexCoord, NumberType::Double, 3);
	wedge.values = {0, 0, huge, 0, 1, nan, 1, 1, -huge};
	Attribute faux =
	    attributeOf(AttributeOf::Face, AttributeKind::FauxEdges, NumberType::Double, 1);
	faux.values = {nan};
	// Two of the same name and not of the same size.
	Attribute narrow =
	    attributeOf(AttributeOf::Vertex, AttributeKind::Custom, NumberType::Float, 1);
	Attribute wide = attributeOf(AttributeOf::Vertex, AttributeKind::Custom, NumberType::Double, 1);
	narrow.name = wide.name = "twice";
	narrow.values           = {1, 2, 3};
	wide.values             = {4, 5, 6};
	data.attributes         = {colour, wedge, faux, narrow, wide};
	EncodeOptions options;
	options.keepOrder  = true;
	const auto encoded = encode(data, options);
	ASSERT_TRUE(encoded.ok()) << encoded.status().what;
	writeFile(
	    scratch("odd.wmc"),
	    QByteArray(
	        reinterpret_cast<const char*>(encoded->bytes.data()), int(encoded->bytes.size())));
	const MeshModel& m = *freshHost().open(scratch("odd.wmc")).front();
	EXPECT_EQ(m.cm.vert[0].cC(), vcg::Color4b(255, 0, 0, 7));
	EXPECT_EQ(m.cm.vert[1].cC(), vcg::Color4b(255, 255, 0, 0));
	EXPECT_EQ(m.cm.face[0].cWT(0).N(), 32767);
	EXPECT_EQ(m.cm.face[0].cWT(1).N(), 0);
	EXPECT_EQ(m.cm.face[0].cWT(2).N(), -32768);
	const auto kept = Custom::FindPerVertexAttribute<float>(m.cm, "twice");
	ASSERT_TRUE(Custom::IsValidHandle(m.cm, kept));
	EXPECT_EQ(kept[2], 3);
}
