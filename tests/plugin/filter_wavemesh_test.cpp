// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// filter_wavemesh, applied by name and by filter scripts, on layers from every source.
#include "test_host.h"

#include <shared/layer_stream.h>

#include <wavemesh/codec.h>

#include <QCoreApplication>
#include <QDockWidget>
#include <QFile>
#include <QLabel>

#include <array>
#include <vector>

using namespace wavemesh;
using namespace wavemesh::test;

namespace {

constexpr const char* kDetailFilters[] = {
    "Wavemesh: Colour by Detail", "Wavemesh: Equalise Detail"};

/// What must come back bit for bit: coordinates and faces, in their order.
struct Shape
{
	std::vector<std::array<Scalarm, 3>> vertices;
	std::vector<std::array<size_t, 3>> faces;

	explicit Shape(const MeshModel& m)
	{
		for (const auto& v : m.cm.vert)
			vertices.push_back({v.cP()[0], v.cP()[1], v.cP()[2]});
		for (const auto& f : m.cm.face)
			faces.push_back(
			    {vcg::tri::Index(m.cm, f.cV(0)), vcg::tri::Index(m.cm, f.cV(1)),
			     vcg::tri::Index(m.cm, f.cV(2))});
	}
	bool operator==(const Shape& other) const
	{
		return vertices == other.vertices && faces == other.faces;
	}
};

MeshLabHost::Results browse(MeshLabHost& host, int level)
{
	return host.apply("Wavemesh: Browse Levels", {{"level", QString::number(level)}});
}

/// By a script, which asks no dialog for its parameters.
MeshLabHost::Results browseByScript(MeshLabHost& host, int level)
{
	writeFile(
	    scratch("browse.mlx"),
	    QString("<!DOCTYPE FilterScript><FilterScript><filter name=\"Wavemesh: Browse Levels\">"
	            "<Param name=\"level\" type=\"RichDynamicFloat\" value=\"%1\" min=\"0\" "
	            "max=\"100\" description=\"\" tooltip=\"\"/></filter></FilterScript>")
	        .arg(level)
	        .toUtf8());
	return host.run(scratch("browse.mlx")).front().results;
}

double rmsToLayer(MeshLabHost& host, const MeshModel& from, const MeshModel& to)
{
	const auto results = host.apply(
	    "Hausdorff Distance", {{"SampledMesh", QString::number(from.id())},
	                           {"TargetMesh", QString::number(to.id())},
	                           {"SampleFace", "true"},
	                           {"SampleNum", "20000"},
	                           {"MaxDist", QString::number(double(to.cm.bbox.Diag()))}});
	return results.at("RMS").toDouble() / results.at("diag_mesh_0").toDouble();
}

} // namespace

TEST(FilterWavemesh, EverySampleScriptRuns)
{
	for (const char* script : {"simplify.mlx", "browse.mlx", "layers.mlx"}) {
		SCOPED_TRACE(script);
		MeshLabHost& host = freshHost();
		host.open(sample("pretzel.ply"));
		const auto steps = host.run(sample(script));
		ASSERT_FALSE(steps.empty());
		for (const auto& step : steps)
			EXPECT_FALSE(step.results.empty()) << qPrintable(step.filter);
	}
}

TEST(FilterWavemesh, SimplifiesToAPercentageAndStaysCloseAndManifold)
{
	MeshLabHost& host         = freshHost();
	const MeshModel& original = *host.open(sample("blob.ply")).front();
	MeshModel& coarse         = *host.open(sample("blob.ply")).front();
	const int before          = coarse.cm.vn;
	const auto results =
	    host.apply("Simplification: Wavemesh", {{"target", "3"}, {"percentage", "25"}});
	EXPECT_LE(coarse.cm.vn, before / 4);
	EXPECT_GE(coarse.cm.vn, before / 40) << "the finest level below the ceiling, not any";
	EXPECT_EQ(results.at("vertices").toInt(), coarse.cm.vn);
	EXPECT_TRUE(results.at("target_reached").toBool());
	EXPECT_TRUE(host.apply("Compute Topological Measures").at("is_mesh_two_manifold").toBool());
	EXPECT_LT(rmsToLayer(host, original, coarse), 0.02);
}

TEST(FilterWavemesh, BrowsingReturnsTheLayerBitForBit)
{
	for (const char* name : {"pretzel.ply", "island.ply", "pieces.ply"}) {
		SCOPED_TRACE(name);
		MeshLabHost& host = freshHost();
		host.open(sample(name));
		const Shape original(host.mesh());
		const int finest = browse(host, 0).at("finest_level").toInt();
		ASSERT_GT(finest, 1);
		EXPECT_LT(host.mesh().cm.vn, int(original.vertices.size()));
		int last = host.mesh().cm.vn;
		for (int level = 1; level < finest; ++level) {
			browse(host, level);
			EXPECT_GT(host.mesh().cm.vn, last) << "level " << level;
			last = host.mesh().cm.vn;
		}
		browse(host, 1);
		browse(host, finest);
		EXPECT_TRUE(Shape(host.mesh()) == original);
	}
}

TEST(FilterWavemesh, BrowsingALayerFromAFileUsesItsLevels)
{
	MeshLabHost& host = freshHost();
	host.open(sample("pretzel.ply"));
	host.save(scratch("browse.wmc"));
	const QByteArray bytes = contents(scratch("browse.wmc"));
	const StreamInfo info  = *readInfo(
	     reinterpret_cast<const std::uint8_t*>(bytes.constData()), std::size_t(bytes.size()));
	host.clear();
	host.open(scratch("browse.wmc"), {{"level", "1"}});
	for (int level : {0, 2, info.finestLevel(), 0, info.finestLevel()}) {
		const auto results = browse(host, level);
		EXPECT_EQ(results.at("finest_level").toInt(), info.finestLevel());
		EXPECT_EQ(std::uint32_t(host.mesh().cm.vn), info.levels[std::size_t(level)].vertices);
		EXPECT_EQ(results.at("bytes").toULongLong(), info.levels[std::size_t(level)].prefix);
	}
}

TEST(FilterWavemesh, SavingABrowsedLayerAtItsFinestLevelKeepsTheMesh)
{
	MeshLabHost& host = freshHost();
	host.open(sample("pretzel.ply"));
	host.save(scratch("first.wmc"));
	host.clear();
	host.open(scratch("first.wmc"), {{"level", "0"}});
	browse(host, -1);
	const Shape shown(host.mesh());
	host.save(scratch("second.wmc"));
	host.clear();
	host.open(scratch("second.wmc"));
	EXPECT_EQ(host.mesh().cm.vn, int(shown.vertices.size()));
	EXPECT_EQ(host.mesh().cm.fn, int(shown.faces.size()));
}

TEST(FilterWavemesh, AnEditedLayerIsEncodedAnew)
{
	MeshLabHost& host = freshHost();
	host.open(sample("pretzel.ply"));
	host.save(scratch("edited.wmc"));
	host.clear();
	host.open(scratch("edited.wmc"));
	browse(host, 0);
	browse(host, -1);
	for (auto& v : host.mesh().cm.vert)
		v.P() *= Scalarm(3);
	vcg::tri::UpdateBounding<CMeshO>::Box(host.mesh().cm);
	const Shape edited(host.mesh());
	browse(host, 0);
	browse(host, -1);
	EXPECT_TRUE(Shape(host.mesh()) == edited) << "the old stream must not come back";
}

TEST(FilterWavemesh, NoEditOfALayerFromAFileIsUndoneByBrowsing)
{
	struct Edit
	{
		const char* name;
		void (*make)(MeshLabHost&);
	};
	const Edit edits[] = {
	    {"a vertex moved a little",
	     [](MeshLabHost& host) { host.mesh().cm.vert[17].P()[1] *= Scalarm(1.0001); }},
	    {"a face deleted",
	     [](MeshLabHost& host) {
		     vcg::tri::Allocator<CMeshO>::DeleteFace(host.mesh().cm, host.mesh().cm.face[5]);
		     vcg::tri::Allocator<CMeshO>::CompactEveryVector(host.mesh().cm);
	     }},
	    {"a face turned over",
	     [](MeshLabHost& host) {
		     CFaceO& f = host.mesh().cm.face[5];
		     std::swap(f.V(1), f.V(2));
	     }},
	    {"a transformation, frozen", [](MeshLabHost& host) {
		     Matrix44m turn;
		     turn.SetRotateDeg(30, Point3m(0, 1, 0));
		     vcg::tri::UpdatePosition<CMeshO>::Matrix(host.mesh().cm, turn);
	     }}};
	MeshLabHost& first = freshHost();
	first.open(sample("pretzel.ply"));
	first.save(scratch("edits.wmc"));
	for (const char* level : {"-1", "3"}) // of the finest and of a coarse level
		for (const Edit& edit : edits) {
			SCOPED_TRACE(edit.name);
			SCOPED_TRACE(level);
			MeshLabHost& host = freshHost();
			host.open(scratch("edits.wmc"), {{"level", level}});
			const Shape before(host.mesh());
			edit.make(host);
			const Shape edited(host.mesh());
			ASSERT_FALSE(edited == before);
			browse(host, 1);
			browse(host, -1);
			EXPECT_TRUE(Shape(host.mesh()) == edited) << "the old stream must not come back";
		}
}

TEST(FilterWavemesh, WhatTheDialogDecodesAheadIsForTheMeshThatItFoundOnly)
{
	MeshLabHost& host = freshHost();
	for (const char* name : {"pretzel", "blob"}) {
		host.open(sample(name + QString(".ply")));
		host.save(scratch(name + QString(".wmc")));
	}
	const auto dialogOn = [&](const char* name) {
		host.clear();
		host.open(scratch(name + QString(".wmc")));
		host.openDialog("Wavemesh: Browse Levels");
	};
	const auto verticesOfLevelTwo = [&] { return browseByScript(host, 2).at("vertices").toInt(); };
	dialogOn("pretzel");
	const int ofPretzel = verticesOfLevelTwo();

	dialogOn("blob"); // and the layer goes away meanwhile
	host.clear();
	host.open(scratch("pretzel.wmc"));
	EXPECT_EQ(verticesOfLevelTwo(), ofPretzel);

	dialogOn("blob");
	host.open(scratch("pretzel.wmc")); // another becomes the current one
	EXPECT_EQ(verticesOfLevelTwo(), ofPretzel);

	dialogOn("blob");
	for (auto& v : host.mesh().cm.vert)
		v.P() *= Scalarm(3);
	const Shape edited(host.mesh());
	browseByScript(host, 0);
	browseByScript(host, -1);
	EXPECT_TRUE(Shape(host.mesh()) == edited);
}

TEST(FilterWavemesh, WhatTheDialogDecodesAheadGoesWithIt)
{
	MeshLabHost& host      = freshHost();
	const MeshModel& layer = *host.open(sample("pretzel.wmc")).front();
	const auto stream =
	    vcg::tri::Allocator<CMeshO>::FindPerMeshAttribute<LayerStream>(layer.cm, "wavemesh.stream");
	const auto users = [&] { return stream().bytes.use_count(); };
	const auto alone = users();
	for (const bool used : {false, true}) {
		const RichParameterList list = host.openDialog("Wavemesh: Browse Levels");
		QDockWidget dialog; // as MeshLab makes it
		dialog.setWidget(new QLabel(list.at(0).fieldDescription()));
		dialog.show();
		QCoreApplication::processEvents();
		EXPECT_EQ(users(), alone + 1) << "is decoded";
		if (used)
			host.apply("Wavemesh: Browse Levels", {{"level", "3"}});
		dialog.close();
		EXPECT_EQ(users() == alone, !used) << "levels that the layer was shown at stay with it";
	}
	host.apply("Wavemesh: Browse Levels", {{"level", "5"}});
}

TEST(FilterWavemesh, ATransformationOfALayerStaysWithEveryLevel)
{
	MeshLabHost& first = freshHost();
	first.open(sample("pretzel.ply"));
	first.save(scratch("moved.wmc"));
	MeshLabHost& host = freshHost();
	host.open(scratch("moved.wmc"));
	host.mesh().cm.Tr.SetTranslate(2, 0, -1);
	const Matrix44m there = host.mesh().cm.Tr;
	ASSERT_NE(there, Matrix44m::Identity());
	for (const int level : {0, 2, -1}) {
		browse(host, level);
		EXPECT_EQ(host.mesh().cm.Tr, there) << level;
	}
}

TEST(FilterWavemesh, LayersFromLevelsAreWhatTheLayerShowsThere)
{
	MeshLabHost& host = freshHost();
	MeshModel& layer  = *host.open(sample("blob.ply")).front();
	const int finest  = browse(host, 2).at("finest_level").toInt();
	layer.updateDataMask(MeshModel::MM_VERTCOLOR);
	for (auto& v : layer.cm.vert)
		v.C() = vcg::Color4b(10, 20, 30, 255);
	for (const int shown : {2, 3, finest}) {
		SCOPED_TRACE(shown);
		browse(host, shown);
		host.apply("Wavemesh: Layers from Levels", {{"levels", "2, 3"}});
		std::vector<MeshModel*> made;
		for (MeshModel& m : host.document().meshIterator())
			if (&m != &layer)
				made.push_back(&m);
		ASSERT_EQ(made.size(), 2u);
		EXPECT_TRUE(made[0]->hasDataMask(MeshModel::MM_VERTCOLOR));
		EXPECT_EQ(made[0]->cm.vert[1].cC(), vcg::Color4b(10, 20, 30, 255));
		EXPECT_FALSE(made[1]->hasDataMask(MeshModel::MM_VERTCOLOR));
		const Shape third(*made[1]);
		for (MeshModel* m : made)
			host.document().delMesh(m->id());
		host.document().setCurrentMesh(layer.id());
		browse(host, 3);
		EXPECT_TRUE(Shape(layer) == third);
	}
}

TEST(FilterWavemesh, LayersFromLevelsLeaveTheLayerAsItWas)
{
	MeshLabHost& host = freshHost();
	MeshModel& layer  = *host.open(sample("vase.ply")).front();
	const Shape original(layer);
	const auto results =
	    host.apply("Wavemesh: Layers from Levels", {{"first", "0"}, {"last", "-1"}, {"step", "1"}});
	const int finest = results.at("finest_level").toInt();
	EXPECT_EQ(results.at("layers").toInt(), finest + 1);
	EXPECT_EQ(int(host.document().meshNumber()), finest + 2);
	EXPECT_TRUE(Shape(layer) == original);
	double coarser = 1;
	int count      = 0;
	for (MeshModel& m : host.document().meshIterator()) {
		if (&m == &layer)
			continue;
		if (++count % 3 == 0) {
			const double rms = rmsToLayer(host, layer, m);
			EXPECT_LT(rms, coarser) << "finer levels are closer";
			coarser = rms;
		}
	}
}

TEST(FilterWavemesh, AScriptMayLeaveOutEveryParameter)
{
	for (const char* filter :
	     {"Simplification: Wavemesh", "Wavemesh: Browse Levels", "Wavemesh: Layers from Levels"}) {
		SCOPED_TRACE(filter);
		writeFile(
		    scratch("bare.mlx"),
		    QByteArray("<!DOCTYPE FilterScript><FilterScript><filter name=\"") + filter +
		        "\"/></FilterScript>");
		MeshLabHost& host = freshHost();
		host.open(sample("pebble.ply"));
		EXPECT_EQ(host.run(scratch("bare.mlx")).size(), 1u);
	}
}

TEST(FilterWavemesh, AMeshThatIsNoManifoldIsBrowsedAndSavedAndHasNoDetails)
{
	// Three faces on one edge.
	writeFile(
	    scratch("fin.off"), "OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n"
	                        "3 0 1 2\n3 1 0 3\n3 0 1 4\n");
	MeshLabHost& host = freshHost();
	host.open(scratch("fin.off"));
	const Shape before(host.mesh());
	for (const char* filter : kDetailFilters) {
		EXPECT_NE(messageOf([&] { host.apply(filter); }), QString()) << filter;
		EXPECT_TRUE(Shape(host.mesh()) == before);
	}
	browse(host, 0);
	browse(host, -1);
	EXPECT_TRUE(Shape(host.mesh()) == before);
	host.save(scratch("fin.wmc"));
	const MeshModel& back = *host.open(scratch("fin.wmc")).front();
	EXPECT_EQ(back.cm.vn, 5);
	EXPECT_EQ(back.cm.fn, 3);
}

TEST(FilterWavemesh, DetailsOfAMeshThatIsNoManifoldNameWhatIsWrongAndTheFilterAgainstIt)
{
	struct Case
	{
		const char *mesh, *says, *helps;
	};
	const Case cases[] = {
	    {"OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 1 0 3\n3 0 1 4\n",
	     "edge 0-1 is non-manifold", "Repair non Manifold Edges"},
	    {"OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n3 0 1 2\n3 0 1 3\n", "oriented inconsistently",
	     "Re-Orient all faces coherently"},
	    {"OFF\n5 2 0\n0 0 0\n1 0 0\n0 1 0\n-1 0 0\n0 -1 0\n3 0 1 2\n3 0 3 4\n",
	     "vertex 0 is non-manifold", "Repair non Manifold Vertices by splitting"},
	    {"OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\n7 7 7\n3 0 1 2\n", "vertex 3 belongs to no face",
	     "Remove Unreferenced Vertices"}};
	for (const Case& wrong : cases) {
		SCOPED_TRACE(wrong.says);
		writeFile(scratch("wrong.off"), wrong.mesh);
		for (const char* filter : kDetailFilters) {
			MeshLabHost& host = freshHost();
			host.open(scratch("wrong.off"));
			const QString message = messageOf([&] { host.apply(filter); });
			EXPECT_TRUE(message.contains(wrong.says)) << qPrintable(message);
			EXPECT_TRUE(message.contains(wrong.helps)) << qPrintable(message);
		}
	}
}

TEST(FilterWavemesh, ALayerWithoutFacesGivesAnErrorAndStaysAsItWas)
{
	writeFile(scratch("points.off"), "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n");
	for (const char* filter :
	     {"Simplification: Wavemesh", "Wavemesh: Browse Levels", "Wavemesh: Layers from Levels",
	      "Wavemesh: Rate-Distortion Report", "Wavemesh: Colour by Detail",
	      "Wavemesh: Equalise Detail"}) {
		SCOPED_TRACE(filter);
		MeshLabHost& host = freshHost();
		host.openDialog(filter); // without any layer
		EXPECT_TRUE(messageOf([&] { host.applyUnchecked(filter); }).contains("open a mesh"));
		host.open(scratch("points.off"));
		host.openDialog(filter);
		EXPECT_TRUE(messageOf([&] { host.apply(filter); }).contains("Any Faces")) << "MeshLab's";
		EXPECT_TRUE(messageOf([&] { host.applyUnchecked(filter); }).contains("is a point cloud"));
		EXPECT_EQ(host.document().meshNumber(), 1u);
		EXPECT_EQ(host.mesh().cm.vn, 3);
		host.document().addNewMesh(QString(), "nothing");
		host.openDialog(filter);
		EXPECT_TRUE(messageOf([&] { host.applyUnchecked(filter); }).contains("is empty"));
	}
}

TEST(FilterWavemesh, TheSliderSnapsByBytesAndByError)
{
	MeshLabHost& host = freshHost();
	host.open(sample("pretzel.ply"));
	const auto all = [&](const MeshLabHost::Settings& settings) {
		return host.apply("Wavemesh: Browse Levels", settings);
	};
	const auto base  = all({{"level", "0"}, {"snap", "1"}});
	const int finest = base.at("finest_level").toInt();
	EXPECT_EQ(base.at("level").toInt(), 0);
	for (const char* snap : {"0", "1", "2"}) {
		SCOPED_TRACE(snap);
		int last = -1;
		for (int step = 0; step <= 4 * finest; ++step) {
			const auto shown = all({{"level", QString::number(step / 4.)}, {"snap", snap}});
			EXPECT_GE(shown.at("level").toInt(), last) << "to the right is finer";
			last = shown.at("level").toInt();
		}
		EXPECT_EQ(last, finest);
	}
	const auto small = all({{"snap", "1"}, {"max_bytes", "3000"}});
	EXPECT_LE(small.at("bytes").toInt(), 3000);
	const double error = small.at("error").toDouble();
	const auto close   = all({{"snap", "2"}, {"max_error", QString::number(error * 1.001)}});
	EXPECT_LE(close.at("error").toDouble(), error * 1.001);
	EXPECT_LE(close.at("level").toInt(), small.at("level").toInt()) << "the coarsest that does";
}

TEST(FilterWavemesh, ColoursAndSelectionsStayWithTheLevelTheyWereMadeOn)
{
	MeshLabHost& host = freshHost();
	MeshModel& layer  = *host.open(sample("blob.ply")).front();
	browse(host, 2);
	layer.updateDataMask(MeshModel::MM_VERTCOLOR);
	for (auto& v : layer.cm.vert)
		v.C() = vcg::Color4b(10, 20, 30, 255);
	layer.cm.vert[0].SetS();
	browse(host, -1);
	EXPECT_FALSE(layer.cm.vert[0].IsS());
	EXPECT_FALSE(layer.hasDataMask(MeshModel::MM_VERTCOLOR));
	browse(host, 2);
	EXPECT_TRUE(layer.cm.vert[0].IsS());
	EXPECT_TRUE(layer.hasDataMask(MeshModel::MM_VERTCOLOR));
	EXPECT_EQ(layer.cm.vert[1].cC(), vcg::Color4b(10, 20, 30, 255));
}
